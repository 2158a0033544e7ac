# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The gestures of the webcam clips performed by drawn people, with face and sleeves: synthetic pictures, no people.

No choice is made: the recognisers have their defaults. Those trained on webcam clips are tested on every signer; those
trained on drawn hands on the signers that they were not trained on, one at a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.media import read_frames
from hri.recognition import GestureRecognizer
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.tables import Row, statistics
from hri.studies.webcam import FOLDER, PATTERN
from hri.synthetic.gestures import GESTURES, draw_gesture
from hri.synthetic.signer import SignerOptions, make_signer

PICTURES: dict[str, tuple[str, str]] = {
    "hand alone": ("hand", "long"),
    "face, long sleeves": ("person", "long"),
    "face, short sleeves": ("person", "short"),
}
"""View and sleeve of `draw_gesture`."""
TRAINED_ON = ("webcam clips", "drawn hands")
WAYS = {"never": False, "auto": True}
"""Whether hands are found with the help of a face, as ``hri train gesture --faces`` says."""
NUM_SIGNERS, SEED = 4, 0
FPS, SIZE_PX = 10.0, (416, 312)

Rows = NDArray[np.float32]
Labelled = tuple[list[Rows], list[str]]


def _drawn(picture: str, recognisers: dict[str, GestureRecognizer], signer: int) -> dict[str, Labelled]:
    """Rows of every gesture of one signer, by way."""
    view, sleeve = PICTURES[picture]
    person = make_signer(signer, SEED, SignerOptions(sleeve=sleeve, fps=FPS))
    clips = [draw_gesture(person, label, seed=SEED, view=view, size_px=SIZE_PX) for label in GESTURES]
    return {way: ([r.features(clip) for clip in clips], list(GESTURES)) for way, r in recognisers.items()}


def _share_right(recogniser: GestureRecognizer, clips: Labelled) -> float:
    """Of clips whose best label is right, rejected or not; a clip without a hand counts as wrong."""
    right = []
    for rows, label in zip(*clips, strict=True):
        nbest = recogniser.recognise_features(rows).nbest if len(rows) else ()
        right.append(bool(nbest) and nbest[0].label == label)
    return float(np.mean(right))


def _fit(use_faces: bool, clips: Labelled) -> GestureRecognizer:
    seen = [(rows, label) for rows, label in zip(*clips, strict=True) if len(rows)]
    return GestureRecognizer(use_faces=use_faces).fit_features([rows for rows, _ in seen], [label for _, label in seen])


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    trained_on: Sequence[str] = TRAINED_ON,
    pictures: Sequence[str] = tuple(PICTURES),
    faces: Sequence[str] = tuple(WAYS),
) -> dict[str, Any]:
    finders = {way: GestureRecognizer(use_faces=WAYS[way]) for way in faces}
    drawn: dict[str, list[dict[str, Labelled]]] = {}
    needed = list(dict.fromkeys([*pictures, *(["hand alone"] if "drawn hands" in trained_on else [])]))
    for picture in needed:
        drawn[picture] = []
        for signer in range(NUM_SIGNERS):
            drawn[picture].append(_drawn(picture, finders, signer))
            progress(f"drawing {picture}", signer + 1, NUM_SIGNERS)
    webcam: dict[str, Labelled] = {}
    if "webcam clips" in trained_on:
        dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
        webcam = {way: ([], [sample.label for sample in dataset.samples]) for way in faces}
        for done, sample in enumerate(dataset.samples):
            frames = read_frames(sample.path).frames
            for way, finder in finders.items():
                webcam[way][0].append(finder.features(frames))
            progress("finding hands in webcam clips", done + 1, len(dataset))
    rows: list[Row] = []
    for source in trained_on:
        for way in faces:
            found: dict[str, dict[str, float]] = {picture: {} for picture in pictures}
            trained = _fit(WAYS[way], webcam[way]) if source == "webcam clips" else None
            for signer in range(NUM_SIGNERS):
                recogniser = trained or _fit(WAYS[way], _others(drawn["hand alone"], way, signer))
                for picture in pictures:
                    found[picture][f"signer {signer + 1}"] = _share_right(recogniser, drawn[picture][signer][way])
            rows += [
                {"trained on": source, "faces": way, "pictures": picture, **statistics(per_signer)}
                for picture, per_signer in found.items()
            ]
    return {"synthetic": True, "seed": SEED, "num_signers": NUM_SIGNERS, "rows": rows, "passed": None}


def _others(drawn: Sequence[dict[str, Labelled]], way: str, signer: int) -> Labelled:
    """The clips of all signers but one."""
    parts = [clips[way] for number, clips in enumerate(drawn) if number != signer]
    return [rows for clips, _ in parts for rows in clips], [label for _, labels in parts for label in labels]


STUDIES = (
    Study(
        "drawn-gestures",
        f"the webcam gestures by {NUM_SIGNERS} drawn people with face and sleeves (synthetic), trained on hands alone",
        (FOLDER,),
        "none: drawn people are no people",
        _run,
        layout=Layout(columns="pictures"),
        axes={"trained_on": TRAINED_ON, "pictures": tuple(PICTURES), "faces": tuple(WAYS)},
        sources=GESTURE_SOURCES,
        quick={"trained_on": ("drawn hands",), "pictures": ("hand alone",), "faces": ("never",)},
    ),
)
