# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The hybrid feature of a moving gesture against NumPy, and the study that measures it."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import hri.studies
from hri.core.errors import InvalidArgument
from hri.features import (
    HybridFeatureComputer,
    HybridFeatureOptions,
    WaveletDescriptorComputer,
    WaveletDescriptorOptions,
    direction_code,
    hybrid_column_names,
)
from hri.features.hand import hand_column_names, hand_features
from hri.media import write_video
from hri.studies import hybrid_features, webcam

pywt = pytest.importorskip("pywt")


def disc(x: int, y: int, radius: int = 14) -> np.ndarray:
    """The mask of a hand: a disc with a finger."""
    mask = np.zeros((120, 160), np.uint8)
    cv2.circle(mask, (x, y), radius, 255, -1)
    cv2.line(mask, (x, y), (x + radius, y - 2 * radius), 255, 7)
    return mask


def way(num_frames: int = 12) -> list[np.ndarray]:
    return [disc(40 + 5 * t, 70 - (t * t) // 4, 12 + t // 3) for t in range(num_frames)]


def features(masks: Any, **options: Any) -> np.ndarray:
    return np.asarray(HybridFeatureComputer(HybridFeatureOptions(**options)).compute(masks))


def only(part: str) -> dict[str, Any]:
    return {use: use == f"use_{part}" for use in ("use_moments", "use_orientation", "use_chain_codes", "use_speed")}


def test_speed_and_chain_codes_are_those_of_the_centroids() -> None:
    masks = way()
    places = np.array([np.argwhere(mask)[:, ::-1].mean(axis=0) for mask in masks])
    speed = np.linalg.norm(np.diff(places, axis=0), axis=1)
    found = features(masks, **only("speed"), speed_weight=0.7)[:, 0]
    np.testing.assert_allclose(found, 0.7 * np.append(speed, speed[-1]) / speed.max(), rtol=1e-5)

    codes = features(masks, **only("chain_codes")) * 8
    steps = [direction_code(*(after - before)) for before, after in pairwise(places)]
    assert codes[:, 1].tolist() == [*steps, steps[-1]]
    assert codes[:, 0].tolist() == [direction_code(*(place - places.mean(axis=0))) for place in places]
    assert set(steps) == {0, 1}  # first to the right, later up as well


def test_moments_are_the_wavelet_descriptor_by_its_largest() -> None:
    masks = way()
    shape: dict[str, Any] = {"num_scales": 3, "num_frequencies": 2}
    descriptor = WaveletDescriptorComputer(WaveletDescriptorOptions(**shape))
    raw = np.array([descriptor.compute(mask) for mask in masks])
    np.testing.assert_allclose(features(masks, **only("moments"), moments=shape), raw / raw.max(), rtol=1e-5)
    by_column = features(masks, **only("moments"), moments=shape, moment_scale="column")
    np.testing.assert_allclose(by_column, raw / raw.max(axis=0), rtol=1e-5)


@pytest.mark.parametrize("wavelet", ["haar", "db2"])
def test_orientation_is_that_of_pywavelets_second_level(wavelet: str) -> None:
    mask = np.zeros((200, 200), np.uint8)
    cv2.fillConvexPoly(mask, np.array([[100, 70], [129, 85], [100, 119], [80, 100]]), 255)  # 50 x 50
    square = mask[66:124, 76:134] / 255  # with 0.08 of its side around: 58 pixels, so that nothing is scaled
    fg, gf, _ = pywt.wavedec2(square, wavelet, level=2)[1]
    options = {**only("orientation"), "wavelet": wavelet, "crop_px": 58}
    angle = np.arctan2(2 * (fg * gf).sum(), (gf**2 - fg**2).sum()) / 2
    found = features([mask], **options)[0, 0]
    assert found == pytest.approx(np.remainder(angle, np.pi) / np.pi, abs=1e-4)
    doubled = np.hypot((2 * fg * gf).sum(), (gf**2 - fg**2).sum()) / (gf**2 + fg**2).sum() * np.exp(2j * angle)
    circle = features([mask], **options, angles="circle")[0]
    np.testing.assert_allclose(circle, [0.5 + doubled.real / 2, 0.5 + doubled.imag / 2], atol=1e-4)


def test_orientation_turns_with_the_hand() -> None:
    mask = disc(80, 70)
    turned = [features([np.ascontiguousarray(np.rot90(mask, k))], **only("orientation"))[0, 0] for k in range(2)]
    assert abs(np.remainder(turned[0] - turned[1], 1) - 0.5) < 0.02  # 90 of 180 degrees


def test_columns_have_names_and_lie_between_zero_and_one() -> None:
    for chosen in (
        HybridFeatureOptions(),
        HybridFeatureOptions(angles="circle"),
        HybridFeatureOptions(use_moments=False),
        HybridFeatureOptions(use_chain_codes=False, use_speed=False, moments={"num_frequencies": 2}),
    ):
        rows = np.asarray(HybridFeatureComputer(chosen).compute(way()))
        assert rows.dtype == np.float32 and rows.shape == (12, len(hybrid_column_names(chosen)))
        assert rows.min() >= 0 and rows.max() <= 1
    assert hybrid_column_names()[:2] == ["b0_m0_n0", "b0_m0_n1"]
    circle = hybrid_column_names(HybridFeatureOptions(angles="circle"))
    assert circle[-3:] == ["code_of_step_cosine", "code_of_step_sine", "speed"]


def test_it_is_a_kind_of_hand_features() -> None:
    masks = [*way(), np.zeros((120, 160), np.uint8)]
    found = hand_features(masks, masks, "hybrid", angles="circle", use_moments=False)
    np.testing.assert_array_equal(found, features(masks, angles="circle", use_moments=False))
    assert found.shape == (12, len(hand_column_names("hybrid", angles="circle", use_moments=False)))


def test_frames_without_a_hand_have_no_row_and_bad_masks_are_refused() -> None:
    masks = way()
    gap = [*masks[:4], np.zeros_like(masks[0]), *masks[4:]]
    assert features(gap).shape[0] == len(masks)
    assert features([]).shape[0] == 0
    with pytest.raises(InvalidArgument, match="1 has another size"):
        features([masks[0], masks[0][:50]])
    with pytest.raises(InvalidArgument, match="dimensions"):
        features([np.zeros((4, 4, 3), np.uint8)])
    with pytest.raises(InvalidArgument, match="speed_weight"):
        HybridFeatureOptions(speed_weight=0)
    with pytest.raises(InvalidArgument, match="all false"):
        HybridFeatureComputer(HybridFeatureOptions(**only("nothing")))


def test_frames_are_taken_from_the_part_that_moves() -> None:
    rest, after = [disc(30, 60)] * 40, [disc(110, 60)] * 25
    masks = [*rest, *(disc(30 + 4 * t, 60) for t in range(1, 20)), *after]
    frames = hybrid_features.moving_frames(masks)
    assert 37 <= frames[0] <= 42 and 57 <= frames[-1] <= 62
    spread = hybrid_features.take_frames(masks, "spread")
    middle = hybrid_features.take_frames(masks, "middle")
    assert len(spread) == len(middle) == hybrid_features.NUM_FRAMES
    assert np.array_equal(spread[0], masks[frames[0]]) and np.array_equal(spread[-1], masks[frames[-1]])
    start = (len(frames) - hybrid_features.NUM_FRAMES) // 2
    assert np.array_equal(middle[0], masks[frames[start]])
    assert len(hybrid_features.take_frames([disc(40, 60)] * 15, "spread")) == 15  # a hand that rests
    with pytest.raises(InvalidArgument, match="needed are 15"):
        hybrid_features.moving_frames(masks[:14])


def test_only_what_changes_columns_is_chosen() -> None:
    numbers = {part: len(hybrid_features.settings_of(part)) for part in hybrid_features.PARTS}
    assert numbers == {"speed": 1, "orientation": 2, "chain codes": 2, "moments": 2, "joined": 20}


def film(down: bool, seed: int) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    start = rng.uniform(-6, 6, 2)
    frames = []
    for t in range(30):
        step = np.clip(t - 6, 0, 16) * 3
        frame = np.full((120, 160, 3), 90, np.uint8)
        x, y = int(40 + start[0] + (0 if down else step)), int(40 + start[1] + (step if down else 0))
        frame[disc(x, y) > 0] = (110, 150, 210)
        frames.append(frame)
    return frames


def test_the_study_runs_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for label, down in (("swipeRight", False), ("swipeDown", True)):
        (tmp_path / webcam.FOLDER / label).mkdir(parents=True)
        for take in range(1, 6):
            write_video(tmp_path / webcam.FOLDER / label / f"t{take}.m4v", film(down, take), 12.0)
    monkeypatch.setattr(hybrid_features, "SEEDS", (0, 1))
    monkeypatch.setattr(hybrid_features, "WEIGHTS", (0.1, 0.9))
    study = hri.studies.get_study("hybrid-features")
    found = hri.studies.run_study(
        study, tmp_path, lambda *_: None, {"frames": ("spread",), "part": ("chain codes", "joined")}, folds=2
    )
    shown = {(row["part"], row["weight"], row["classifier"]): row["accuracy_mean"] for row in found["rows"]}
    classifiers = {"possibility", "HMM", "PTBHMM", "HMM, Gaussian", "PTBHMM, Gaussian"}
    kinds = {("chain codes", "chosen"), ("joined", "chosen"), ("joined", "0.1"), ("joined", "0.9")}
    assert set(shown) == {(*kind, name) for kind in kinds for name in classifiers}
    assert shown["chain codes", "chosen", "possibility"] == 1.0  # down and to the right
    assert set(found["lost_by_ptbhmm"]) == {
        f"spread, {part}, {weight}, {name}" for part, weight in kinds for name in ("HMM", "HMM, Gaussian")
    }
    assert found["passed"] == (max(found["lost_by_ptbhmm"].values()) <= 0.01)
    for chosen in found["chosen"]["spread, joined"].values():
        assert {family["speed_weight"] for family in chosen.values()} <= {0.1, 0.9}
