# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options do something: each that no other test sets gives another result with another value."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from hri import _native
from hri.htk import HtkFeatureOptions
from hri.models import SequenceNetwork
from hri.recognition import ConnectedWordRecognizer, ConnectedWordStream, GestureSegmenter, SentenceStream
from hri.vision import (
    Face,
    FaceFinder,
    FaceFinderOptions,
    HandFinder,
    PersonHands,
    PersonOptions,
    SilhouetteExtractor,
    SilhouetteOptions,
)
from signing_people import FPS, signed, train_sentences
from test_person_streams import CASCADE, room

pytestmark = pytest.mark.usefixtures("few_fillers")
ROOT = Path(__file__).resolve().parents[2]
# What would show these takes the extra "embedding", or minutes of training.
IN_NO_TEST = [
    "SubwordRecognizerOptions.num_adaptations",
    "WordRecognizerOptions.embedding_penalty",
    "WordRecognizerOptions.embedding_shrinkage",
]


def test_every_option_is_set_by_name_in_a_test() -> None:
    paths = [path for path in (ROOT / "tests").rglob("*") if path.suffix in (".py", ".cpp", ".hpp")]
    texts = [path.read_text(encoding="utf-8") for path in paths if path.name != "all_options_test.cpp"]
    named = set(re.findall(r"(?<!Options\.)\b\w+", " ".join(texts)))
    unnamed, name = [], ""
    for line in (ROOT / "docs/options.md").read_text(encoding="utf-8").splitlines():
        if heading := re.match(r"## (\w+)$", line):
            name = heading[1]
        elif (row := re.match(r"\| `(\w+)`", line)) and row[1] not in named:
            unnamed.append(f"{name}.{row[1]}")
    assert sorted(unnamed) == IN_NO_TEST


@functools.cache
def clips() -> tuple[list[NDArray[np.float32]], list[str], list[str]]:
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(2)
        for label, slope in (("1", 800.0), ("2", -350.0))
    ]
    x, y, persons = map(list, zip(*rows, strict=True))
    return x, y, persons


QUIET = (0.001 * np.random.default_rng(0).standard_normal(RATE_HZ)).astype(np.float32)
SAID = np.concatenate([QUIET, tone_word(575, 800, 50), tone_word(575, 60, 51), tone_word(575, -350, 52), QUIET])


@functools.cache
def connected_words() -> ConnectedWordRecognizer:
    return connected_fit()


def connected_fit(**options: Any) -> ConnectedWordRecognizer:
    words = {"num_states": 4, "num_vtlp_factors": 1, "num_noisy_copies": 1, "min_snr_db": 10.0, "max_iterations": 3}
    made = ConnectedWordRecognizer(words=words, max_words=3, **{"choose_penalty": False, **options})
    x, y, persons = clips()
    return made.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def connected(**options: Any) -> Any:
    return connected_fit(**options).recognise(SAID, RATE_HZ).to_dict()


def connected_unknown(**options: Any) -> Any:
    return connected(unknown_words=True, **options)


def connected_chosen(**options: Any) -> Any:
    """On strings of words, whose pauses are drawn."""
    return connected(choose_penalty=True, **options)


def lattice(**options: Any) -> Any:
    return len(connected_fit(lattice=options).lattice(SAID, RATE_HZ)[0].arcs)


def connected_stream(**options: Any) -> Any:
    stream = ConnectedWordStream(connected_words(), RATE_HZ, **options)
    return sum(len(stream.process(SAID[at : at + 320])) for at in range(0, len(SAID), 320))


@functools.cache
def sentences() -> list[Any]:
    rng = np.random.default_rng(3)
    return [signed([str(w) for w in rng.choice(["ball", "cat", "stop"], 3)], 100 + i) for i in range(8)]


def signs(**options: Any) -> Any:
    made = hri.SentenceRecognizer(**{"frames_per_state": 4, "choose_weights": False, **options})
    made.fit([tracks for tracks, _ in sentences()], [words for _, words in sentences()])
    tracks, words = signed(["cat", "ball"], 7)
    spans = [(first, last) for _, first, last in words]
    return made.recognise(tracks).to_dict(), made.recognise_spans(tracks, spans).to_dict()


@functools.cache
def trained_signs() -> hri.SentenceRecognizer:
    return train_sentences()


def sign_stream(**options: Any) -> Any:
    """A sentence, a twitch of 0.2 s, and one whose hands leave."""
    stream = SentenceStream(trained_signs(), **options)
    first, second = (signed(words, seed)[0] for words, seed in ((["cat", "ball", "cat"], 1), (["stop", "cat"], 2)))
    second[-20:, :2] = np.nan
    twitch = np.repeat(first[:1], 60, axis=0)
    twitch[20:25, :2] += 25 * np.arange(5)[:, None, None]
    tracks = np.concatenate([first, twitch, second, second[-1:].repeat(60, axis=0)])
    found = [(t, stream.push(frame, t / FPS)) for t, frame in enumerate(tracks)]
    return [(t, event.kind, event.labels, event.num_stable, event.reason) for t, event in found if event is not None]


def segments(**options: Any) -> Any:
    """A hand moves, is gone for 0.2 s, rests, is taken away, and comes for 0.24 s."""
    segmenter = GestureSegmenter(_native.GestureSegmenterOptions(**options))
    places = [None] * 10 + [4 * t for t in range(20)] + [None] * 5 + [80 + 3 * t for t in range(20)]
    places += [140] * 30 + [140 + 2 * t for t in range(10)] + [None] * 30 + [20 + 8 * t for t in range(6)] + [None] * 30
    found = []
    for t, place in enumerate(places):
        mask = np.zeros((120, 240), np.uint8)
        if place is not None:
            mask[40:80, place : place + 30] = 255
        event = segmenter.push(mask, t / 25)
        found.append((str(event.kind), event.first_s, event.last_s))
    return found


@functools.cache
def words() -> hri.WordRecognizer:
    x, y, persons = clips()
    return hri.WordRecognizer(max_iterations=3).fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def adapted(**options: Any) -> Any:
    adapter = hri.SpeakerAdapter(words(), words_per_label=0, **options)
    for label, slope in (("1", 800.0), ("2", -350.0)):
        adapter.learn(tone_word(1100.0, slope, 1), label, RATE_HZ)
    adapter.update()
    return adapter.recognizer.scores(tone_word(1100.0, 800.0, 9), RATE_HZ).tolist()


def networked_words(**options: Any) -> Any:
    made = hri.WordRecognizer(
        use_network=True, network={"num_channels": 16, "num_epochs": 2}, max_iterations=3, **options
    )
    x, y, persons = clips()
    return made.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons).scores(tone_word(575, 800, 9), RATE_HZ).tolist()


def network(**options: Any) -> Any:
    rng = np.random.default_rng(1)
    rows = [rng.normal(label, 1, (20, 6)).astype(np.float32) for label in (0, 1) * 8]
    made = SequenceNetwork(num_channels=16, num_blocks=1, num_epochs=3, batch_size=8, **options).fit(rows, [0, 1] * 8)
    return made.predict_log_proba(rows[:2]).tolist()


def hands_of_a_person(**options: Any) -> Any:
    frame = room(80)
    frame[110:150, 40:60] = (100, 135, 190)  # less like the face than the hand is
    return np.asarray(PersonHands(PersonOptions(**options)).extract(frame, Face(140, 60, 32)).mask).tobytes()


def finder(folder: Path, **options: Any) -> FaceFinder:
    (folder / "any.xml").write_text(CASCADE)
    return FaceFinder(folder / "any.xml", FaceFinderOptions(**{"min_side": 0.25, "scale_step": 2.0, **options}))


def silhouette(**options: Any) -> Any:
    """Of a hand that is darker by 4 grey levels, in noise."""
    grey = np.random.default_rng(0).normal(120, 4, (120, 160))
    grey -= 4 * (np.hypot(*(np.mgrid[:120, :160] - np.array([60, 80])[:, None, None])) < 30)
    extractor = SilhouetteExtractor(SilhouetteOptions(method="grey_otsu", remove_face=False, **options))
    frame = np.repeat(np.clip(np.round(grey), 0, 255).astype(np.uint8)[..., None], 3, axis=2)
    return np.asarray(extractor.extract(frame).mask).tobytes()


def htk_features(**options: Any) -> Any:
    made = HtkFeatureOptions(**options)
    audio = tone_word(500, 300, 1) + np.float32(0.05)
    return _native.HtkFeatureExtractor("MFCC_E_D_A_T", RATE_HZ, made).compute(audio).tobytes()


@functools.cache
def usual(made: Callable[..., Any]) -> Any:
    return made()


@pytest.mark.parametrize(
    ("made", "options"),
    [
        (connected, {"silence_states": 1}),
        (connected, {"silence_mixtures": 1}),
        (connected, {"num_alignments": 0}),
        (connected_chosen, {"max_pause_ms": 0.0}),
        (connected_unknown, {"unknown_rank": 2}),
        (connected_unknown, {"unknown_lead": 1.0}),
        (connected_stream, {"partial_share": 1.0}),
        (lattice, {"max_arcs": 10}),
        (signs, {"max_states": 1}),
        (signs, {"between_states": 1}),
        (signs, {"between_mixtures": 1}),
        (signs, {"known_language_scale": 0.0}),
        (sign_stream, {"appear_s": 0.4}),
        (sign_stream, {"leave_s": 0.5}),
        (sign_stream, {"partial_share": 0.5}),
        (sign_stream, {"num_agreeing": 4}),
        (segments, {"appear_s": 0.3}),
        (segments, {"leave_s": 0.1}),
        (segments, {"min_gesture_s": 0.05}),
        (segments, {"take_away_s": 0.1}),
        (adapted, {"num_iterations": 1}),
        (networked_words, {"network_weight": 50.0}),
        (network, {"learning_rate": 0.0005}),
        (network, {"weight_decay": 1.0}),
        (network, {"label_smoothing": 0.5}),
        (hands_of_a_person, {"min_log_ratio": 3.0}),
        (silhouette, {"sure_contrast": 1.5}),
        (htk_features, {"zero_mean": True}),
        (htk_features, {"raw_energy": False}),
        (htk_features, {"energy_scale": 0.5}),
        (htk_features, {"silence_floor_db": 5.0}),
        (htk_features, {"third_window": 4}),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, dict) else value.__name__,
)
def test_another_value_gives_another_result(made: Callable[..., Any], options: dict[str, Any]) -> None:
    assert made(**options) != usual(made) == made()


def test_faces_must_be_agreed_on(tmp_path: Path) -> None:
    """What is not of one grey passes for one: a dark corner is in few windows."""
    frame = np.full((240, 320, 3), 170, np.uint8)
    frame[:40, :40] = 20
    finders = (finder(tmp_path, min_side=0.6, min_neighbours=count) for count in (2, 100))
    assert [one.find(frame) is not None for one in finders] == [True, False]


@pytest.mark.parametrize(("face_interval", "seen"), [(1, True), (100, False)])
def test_a_face_is_looked_for_in_one_frame_of_so_many(tmp_path: Path, face_interval: int, seen: bool) -> None:
    """None is seen in the first picture."""
    finders = HandFinder(faces=finder(tmp_path), person=PersonOptions(face_interval=face_interval)), HandFinder()
    by_face, plain = (one.stream(True) for one in finders)
    for t in range(30):
        frame = room(80, noise=0 if t < 6 else 2)
        found, expected = (np.asarray(one.push(frame, t / 10).mask) for one in (by_face, plain))
    assert np.array_equal(found, expected) == (not seen)
