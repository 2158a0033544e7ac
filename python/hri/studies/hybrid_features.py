# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The hybrid feature of chapter 5 on moving gestures: each part alone and joined, by the thesis's three classifiers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.features import HybridFeatureComputer, HybridFeatureOptions
from hri.media import read_frames
from hri.models import (
    Codebook,
    DiscreteHmm,
    DiscreteHmmOptions,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    PossibilisticGaussianHmmSet,
    PossibilisticHmmSet,
    PossibilityClassifier,
    Topology,
)
from hri.studies import webcam
from hri.studies.registry import Layout, Progress, Study
from hri.studies.tables import Row, statistics
from hri.vision.hands import find_silhouettes, hand_place

NUM_FRAMES = 15
FRAMES = ("spread", "middle")
"""How they are taken from the part of a clip that moves: at equal distances, or the middle ones (section 5.1.2)."""
STILL_CHANGE = 0.03
"""Share of all change before which, and after which, the hand rests."""
USES = {  # part: the option that switches it on
    "speed": "use_speed",
    "orientation": "use_orientation",
    "chain codes": "use_chain_codes",
    "moments": "use_moments",
}
PARTS = (*USES, "joined")
ANGLES: tuple[Literal["number", "circle"], ...] = ("number", "circle")
SCALES: tuple[Literal["gesture", "column"], ...] = ("gesture", "column")
WEIGHTS = (0.1, 0.3, 0.5, 0.7, 0.9)
MOMENTS = {"num_scales": 2, "num_frequencies": 3}
"""24 numbers: 15 frames of all 136 are more than 67 clips train, and take minutes."""
NUM_CODEWORDS = 32
EMISSION_FLOOR = 0.1 / NUM_CODEWORDS
TOPOLOGY = Topology(kind="left_right", num_states=5, max_jump=1)
SEEDS = tuple(range(10))
"""Of codebooks, whose chance is averaged; `CHOOSING_SEEDS` where options are chosen."""
CHOOSING_SEEDS = (0, 1)
NUM_PARTS = 3
"""Parts of the conditions trained on, each left out in turn to choose."""
CHOSEN = "chosen"
"""In place of a weight of speed: it is chosen within the training folds, where the part has any."""
MOST_LOST = 0.01

Mask = NDArray[np.uint8]
Rows = NDArray[np.float32]
Shares = dict[str, NDArray[np.float64]]
"""Of every classifier: share of right answers for each test clip."""


@dataclass(frozen=True)
class Setting:
    """Options among which training folds choose; the thesis's own reading comes first."""

    part: str
    angles: Literal["number", "circle"] = "number"
    scale: Literal["gesture", "column"] = "gesture"
    weight: float = WEIGHTS[0]

    def computer(self) -> HybridFeatureComputer:
        options = HybridFeatureOptions(
            moments=MOMENTS, moment_scale=self.scale, angles=self.angles, speed_weight=self.weight
        )
        for part, use in USES.items():
            setattr(options, use, self.part in (part, "joined"))
        return HybridFeatureComputer(options)


def settings_of(part: str) -> list[Setting]:
    """What may be chosen for `part`: only what changes its columns."""
    directed = part in ("orientation", "chain codes", "joined")
    shaped = part in ("moments", "joined")
    return [
        Setting(part, angles, scale, weight)
        for angles in (ANGLES if directed else ANGLES[:1])
        for scale in (SCALES if shaped else SCALES[:1])
        for weight in (WEIGHTS if part == "joined" else WEIGHTS[:1])
    ]


def moving_frames(masks: Sequence[Mask]) -> NDArray[np.int64]:
    """The frames that show a hand, from the first in which it moves to the last; `NUM_FRAMES` or more.

    A step counts by the pixels that place and root of the area change, above what a hand at rest shows.

    Raises
    ------
    InvalidArgument
        Where fewer frames show a hand.
    """
    places = [(i, place) for i, mask in enumerate(masks) if (place := hand_place(mask)) is not None]
    if len(places) < NUM_FRAMES:
        raise InvalidArgument(f"a hand is seen in {len(places)} frames, needed are {NUM_FRAMES}")
    height, width = masks[0].shape
    way = np.array([(x * width, y * height, np.sqrt(area * width * height)) for _, (x, y, area) in places])
    steps = np.convolve(np.linalg.norm(np.diff(way, axis=0), axis=1), np.full(3, 1 / 3), "same")
    change = np.cumsum(np.maximum(steps - 1.5 * np.quantile(steps, 0.25), 0))
    first = int(np.searchsorted(change, STILL_CHANGE * change[-1]))
    last = int(np.searchsorted(change, (1 - STILL_CHANGE) * change[-1])) + 1
    last = min(max(last, first + NUM_FRAMES - 1), len(places) - 1)
    first = min(first, last - NUM_FRAMES + 1)
    return np.array([i for i, _ in places])[first : last + 1]


def take_frames(masks: Sequence[Mask], how: str) -> list[Mask]:
    """`NUM_FRAMES` masks of the part of a clip that moves, as `FRAMES` says."""
    frames = moving_frames(masks)
    start = (len(frames) - NUM_FRAMES) // 2
    chosen = np.linspace(0, len(frames) - 1, NUM_FRAMES).round().astype(int)
    if how == "middle":
        chosen = np.arange(start, start + NUM_FRAMES)
    return [masks[i] for i in frames[chosen]]


def _shares(scores: Any, truth: NDArray[np.int64]) -> NDArray[np.float64]:
    return (np.argmax(np.asarray(scores, np.float64), axis=1) == truth).astype(np.float64)


def _possibility(rows: Sequence[Rows], labels: NDArray[np.int64], train: Any, test: Any, seeds: Any) -> Shares:
    """Each frame is a vector (eq. 5.14-5.15); the possibilities of a clip's frames are joined by their product."""
    model = PossibilityClassifier(covariance="full")
    model.fit(np.concatenate([rows[i] for i in train]), np.repeat(labels[train], [len(rows[i]) for i in train]))
    scores = np.array([np.asarray(model.decision_function(rows[i])).sum(axis=0) for i in test])
    if scores.ndim == 1:  # of two classes: by how much the second is more possible
        scores = np.stack([-scores, scores], axis=1)
    return {"possibility": _shares(scores, labels[test])}


def _symbols(rows: Sequence[Rows], labels: NDArray[np.int64], train: Any, test: Any, seeds: Sequence[int]) -> Shares:
    """HMM and PTBHMM of the same models, over codewords."""
    pool = np.concatenate([rows[i] for i in train])
    options = DiscreteHmmOptions(topology=TOPOLOGY, num_symbols=NUM_CODEWORDS, emission_floor=EMISSION_FLOOR)
    found = {name: np.zeros(len(test)) for name in ("HMM", "PTBHMM")}
    for seed in seeds:
        half = np.random.default_rng(seed).permutation(len(pool))[: (len(pool) + 1) // 2]
        codebook = Codebook(num_codewords=NUM_CODEWORDS, max_iterations=20).fit(pool[np.sort(half)])
        symbols = [codebook.predict(row) for row in rows]
        models = [
            DiscreteHmm.train([symbols[i] for i in train if labels[i] == label], options)
            for label in range(labels.max() + 1)
        ]
        ptbhmm = PossibilisticHmmSet(models)
        likelihoods = [[model.log_likelihood(symbols[i]) for model in models] for i in test]
        found["HMM"] += _shares(likelihoods, labels[test]) / len(seeds)
        found["PTBHMM"] += _shares([ptbhmm.log_possibilities(symbols[i]) for i in test], labels[test]) / len(seeds)
    return found


def _gaussians(rows: Sequence[Rows], labels: NDArray[np.int64], train: Any, test: Any, seeds: Any) -> Shares:
    """HMM and PTBHMM of the same models, over frames."""
    options = GaussianMixtureHmmOptions(topology=TOPOLOGY, tied_variance=True)
    models = [
        GaussianMixtureHmm.train([rows[i] for i in train if labels[i] == label], options)
        for label in range(labels.max() + 1)
    ]
    ptbhmm = PossibilisticGaussianHmmSet(models)
    likelihoods = [[model.log_likelihood(rows[i]) for model in models] for i in test]
    return {
        "HMM, Gaussian": _shares(likelihoods, labels[test]),
        "PTBHMM, Gaussian": _shares([ptbhmm.log_possibilities(rows[i]) for i in test], labels[test]),
    }


FAMILIES: tuple[Callable[..., Shares], ...] = (_possibility, _symbols, _gaussians)
"""Options are chosen for a family: HMM and PTBHMM of one family see the same features."""
PAIRS = {"HMM": "PTBHMM", "HMM, Gaussian": "PTBHMM, Gaussian"}


@dataclass
class _Material:
    """Rows of every clip by setting, computed once."""

    clips: list[list[Mask]]
    labels: NDArray[np.int64]
    conditions: NDArray[np.str_]
    rows: dict[Setting, list[Rows]] = field(default_factory=dict)

    def of(self, setting: Setting) -> list[Rows]:
        if setting not in self.rows:
            computer = setting.computer()
            self.rows[setting] = [np.asarray(computer.compute(masks)) for masks in self.clips]
        return self.rows[setting]

    def measure(
        self, family: Callable[..., Shares], setting: Setting, train: Any, test: Any, seeds: Sequence[int]
    ) -> Shares:
        return family(self.of(setting), self.labels, train, test, seeds)


def _inner_scores(
    material: _Material, family: Callable[..., Shares], settings: Sequence[Setting], outer: NDArray[np.int64]
) -> dict[Setting, float]:
    """Right answers of `family` in parts of the conditions of `outer`, each left out of them in turn."""
    conditions = material.conditions[outer]
    names = list(dict.fromkeys(conditions.tolist()))
    scores = dict.fromkeys(settings, 0.0)
    for part in range(min(NUM_PARTS, len(names))):
        left_out = np.isin(conditions, names[part::NUM_PARTS])
        train, test = outer[~left_out], outer[left_out]
        for setting in settings:
            found = material.measure(family, setting, train, test, CHOOSING_SEEDS)
            scores[setting] += float(sum(shares.sum() for shares in found.values()))
    return scores


def _fold(
    material: _Material, part: str, left_out: str, with_curve: bool
) -> tuple[dict[tuple[str, str], float], dict[str, dict[str, Any]]]:
    """Accuracy by (weight of speed, classifier) of the clips of one condition, and what was chosen."""
    test = np.flatnonzero(material.conditions == left_out)
    train = np.flatnonzero(material.conditions != left_out)
    settings = settings_of(part)
    found: dict[tuple[str, str], float] = {}
    chosen: dict[str, dict[str, Any]] = {}
    for family in FAMILIES:
        scores = _inner_scores(material, family, settings, train) if len(settings) > 1 else {settings[0]: 0.0}
        wanted: dict[str, list[Setting]] = {CHOSEN: settings}
        if with_curve and part == "joined":
            wanted |= {str(w): [s for s in settings if s.weight == w] for w in WEIGHTS}
        for weight, among in wanted.items():
            best = max(among, key=lambda setting: scores[setting])
            for classifier, shares in material.measure(family, best, train, test, SEEDS).items():
                found[weight, classifier] = float(shares.mean())
            if weight == CHOSEN and len(settings) > 1:
                chosen[family.__name__.strip("_")] = {
                    "angles": best.angles,
                    "moment_scale": best.scale,
                    "speed_weight": best.weight,
                }
    return found, chosen


def _find_masks(dataset: Dataset, progress: Progress) -> list[list[Mask]]:
    clips = []
    for done, sample in enumerate(dataset.samples):
        shapes = find_silhouettes(read_frames(sample.path).frames, faces="never")
        clips.append([np.asarray(shape.mask) for shape in shapes])
        progress("finding hands", done + 1, len(dataset))
    return clips


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    frames: Sequence[str] = FRAMES,
    part: Sequence[str] = PARTS,
    folds: int | None = None,
) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / webcam.FOLDER, "gesture", webcam.PATTERN)
    own = data_dir / webcam.FOLDER / webcam.CONDITIONS
    takes = [f"{sample.label}/{sample.take}" for sample in dataset.samples]
    conditions = webcam.read_conditions(takes, own if own.exists() else None)
    labels = np.array([dataset.labels.index(sample.label) for sample in dataset.samples])
    names = list(dict.fromkeys(conditions))
    if len(names) < 3:
        raise InvalidArgument(f"{webcam.FOLDER}: clips of {len(names)} conditions, needed are 3")
    clips = _find_masks(dataset, progress)
    per_fold: dict[tuple[str, str, str, str], dict[str, float]] = {}
    chosen: dict[str, dict[str, dict[str, Any]]] = {}
    for how in frames:
        taken = [take_frames(masks, how) for masks in clips]
        material = _Material(taken, labels, np.array(conditions))
        for one in part:
            for done, left_out in enumerate(names[:folds]):
                found, best = _fold(material, one, left_out, with_curve=how == "spread")
                for (weight, classifier), accuracy in found.items():
                    per_fold.setdefault((how, one, weight, classifier), {})[left_out] = accuracy
                if best:
                    chosen.setdefault(f"{how}, {one}", {})[left_out] = best
                progress(f"{how}, {one}", done + 1, len(names[:folds]))
    rows: list[Row] = [
        {"frames": how, "part": one, "weight": weight, "classifier": classifier, **statistics(values)}
        for (how, one, weight, classifier), values in per_fold.items()
    ]
    means = {key: row["accuracy_mean"] for key, row in zip(per_fold, rows, strict=True)}
    lost = {", ".join(key): mean - means[(*key[:3], PAIRS[key[3]])] for key, mean in means.items() if key[3] in PAIRS}
    return {
        "seeds": list(SEEDS),
        "chosen": chosen,
        "lost_by_ptbhmm": lost,
        "rows": rows,
        "passed": max(lost.values()) <= MOST_LOST,
    }


STUDIES = (
    Study(
        "hybrid-features",
        "8 dynamic gestures before webcams by the hybrid feature of chapter 5 (table 5.2), its parts alone and joined, "
        "by possibility classifier, HMM and PTBHMM; one condition left out at a time, options and weight of speed "
        "chosen by leaving out others",
        (webcam.FOLDER,),
        f"PTBHMM at most {100 * MOST_LOST:g} point below the HMM of the same emissions, for every part and weight",
        _run,
        layout=Layout(columns="classifier"),
        axes={"frames": FRAMES, "part": PARTS},
        sources=(
            "cpp/signal",
            "cpp/features/hand",
            "cpp/features/motion",
            "cpp/models/...",
            "cpp/vision",
        ),
        folds=True,
        quick={"frames": ("middle",), "part": ("chain codes", "moments")},
    ),
)
