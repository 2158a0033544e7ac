# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Outlines and descriptors of shapes against OpenCV and NumPy; what they forget, on drawn and on real hands."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.features import (
    FourierDescriptorComputer,
    FourierDescriptorOptions,
    HandFeatureComputer,
    HandFeatureOptions,
    WaveletDescriptorComputer,
    b_spline_wavelet,
    chain_code,
    hu_features,
    hu_moments,
    resample_contour,
    shape_axis,
    shape_moments,
    shape_number,
    trace_contour,
)
from hri.features.hand import HAND_KINDS, hand_column_names, hand_features
from hri.media import read_image
from hri.synthetic.drawing.signer import make_signer
from hri.synthetic.signer import draw_still
from hri.vision.hands import find_silhouettes

Mask = np.ndarray


def blobs(seed: int, shape: tuple[int, int] = (60, 80), sigma: float = 1.5) -> Mask:
    """Regions of any form, with holes and bridges one pixel wide."""
    noise = np.random.default_rng(seed).standard_normal(shape)
    return np.where(cv2.GaussianBlur(noise, (0, 0), sigma) > 0.05 / sigma, 255, 0).astype("u1")


def hand(person: int = 0, label: str = "4") -> Mask:
    """The drawn hand of a person, somewhat smaller than the square that it stands in."""
    mask = find_silhouettes([draw_still(make_signer(person), label)])[0].mask
    return moved(mask, side=400, span=220)


def moved(mask: Mask, turn_deg: float = 0, scale: float = 1.0, side: int = 0, span: float = 0) -> Mask:
    """Turned and scaled about the middle of its box, into the middle of a square."""
    x, y, width, height = cv2.boundingRect(mask)
    scale *= span / max(width, height) if span else 1.0
    side = side or max(mask.shape)
    matrix = cv2.getRotationMatrix2D((x + (width - 1) / 2, y + (height - 1) / 2), turn_deg, scale)
    matrix[:, 2] += side / 2 - np.array([x + (width - 1) / 2, y + (height - 1) / 2])
    soft = cv2.warpAffine(mask, matrix, (side, side), flags=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
    kept = np.where(soft > 127, 255, 0).astype("u1")
    _, labels, stats, _ = cv2.connectedComponentsWithStats(kept)
    return np.where(labels == 1 + stats[1:, cv2.CC_STAT_AREA].argmax(), 255, 0).astype("u1")


def largest(mask: Mask) -> Mask:
    """The largest region, 8-connected."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=8)
    return np.where(labels == 1 + stats[1:, cv2.CC_STAT_AREA].argmax(), 255, 0).astype("u1")


@pytest.mark.parametrize("sigma", [0.3, 0.7, 1.5, 4.0])
@pytest.mark.parametrize("seed", range(12))
def test_outline_is_that_of_opencv(seed: int, sigma: float) -> None:
    mask = blobs(seed, sigma=sigma)
    ours = trace_contour(mask)
    assert ours.dtype == np.int32
    (theirs,) = cv2.findContours(largest(mask), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]
    # OpenCV starts at the same pixel and goes the other way round.
    theirs = np.roll(theirs[::-1, 0], 1, axis=0)
    np.testing.assert_array_equal(ours, theirs)


def test_outline_takes_any_layout_and_nothing_is_no_error() -> None:
    mask = blobs(1)
    expected = trace_contour(mask)
    np.testing.assert_array_equal(trace_contour(np.asfortranarray(mask)), expected)
    np.testing.assert_array_equal(trace_contour(np.repeat(mask, 2, axis=1)[:, ::2]), expected)
    assert trace_contour(np.zeros((5, 5), "u1")).shape == (0, 2)
    assert trace_contour(np.zeros((0, 0), "u1")).shape == (0, 2)
    with pytest.raises(InvalidArgument, match="2 dimensions"):
        trace_contour(np.zeros((5, 5, 3), "u1"))


def test_chain_code_leads_from_point_to_point() -> None:
    contour = trace_contour(hand())
    code = chain_code(contour)
    angle = code * np.pi / 4
    steps = np.rint(np.stack([np.cos(angle), -np.sin(angle)], axis=1) * np.sqrt(2) * 0.8).astype(int)
    np.testing.assert_array_equal(np.roll(contour, -1, axis=0) - contour, steps)
    turns = (np.roll(code, -1).astype(int) - code) % 8
    number = shape_number(contour)
    assert number.tobytes() == min(np.roll(turns, -i).astype("u1").tobytes() for i in range(len(turns)))
    with pytest.raises(InvalidArgument, match="not neighbours"):
        chain_code(contour[::2])
    with pytest.raises(InvalidArgument, match="two columns"):
        chain_code(np.zeros((4, 3), "i4"))


@pytest.mark.parametrize("seed", range(6))
def test_moments_are_those_of_opencv(seed: int) -> None:
    mask = blobs(seed, (240, 320), 8.0)
    ours, theirs = shape_moments(mask), cv2.moments(mask, binaryImage=True)
    assert set(ours) == set(theirs)
    for name, value in theirs.items():
        # Central moments are differences of numbers that are so much larger.
        largest_part = max(abs(theirs["m" + name[2:]]), 1.0) if name.startswith("mu") else abs(value)
        assert ours[name] == pytest.approx(value, rel=1e-12, abs=1e-10 * largest_part), name
    np.testing.assert_allclose(hu_moments(mask), cv2.HuMoments(theirs)[:, 0], rtol=1e-6, atol=1e-14)


def test_moments_as_features_are_roots_by_degree() -> None:
    mask = hand()
    hu = hu_moments(mask)
    degrees = np.array([1, 2, 2, 2, 4, 3, 4])
    np.testing.assert_allclose(hu_features(mask), np.sign(hu) * np.abs(hu) ** (1 / degrees), rtol=1e-5)


def test_axis_is_that_of_the_second_moments() -> None:
    mask = hand(1, "1")
    y, x = np.nonzero(mask)
    values, vectors = np.linalg.eigh(np.cov(np.stack([x, y]).astype(float)))
    angle, elongation = shape_axis(mask)
    assert abs(np.array([np.cos(angle), np.sin(angle)]) @ vectors[:, 1]) == pytest.approx(1, abs=1e-9)
    assert elongation == pytest.approx((values[1] - values[0]) / values.sum(), abs=1e-9)


@pytest.mark.parametrize("use_phase", [False, True])
def test_fourier_descriptor_is_numpys_fft_of_the_outline(use_phase: bool) -> None:
    contour = trace_contour(hand())
    options = FourierDescriptorOptions(num_points=100, num_harmonics=20, use_phase=use_phase)
    x, y = resample_contour(contour, 100).T.astype("f8")
    spectrum = np.fft.fft(x + 1j * y)
    spectrum[0] = 0
    spectrum /= np.linalg.norm(spectrum)
    k = np.ravel([(n, -n) for n in range(1, 21)])
    expected = np.abs(spectrum[k])
    if use_phase:
        shifted = spectrum[k] * np.exp(-1j * k * np.angle(spectrum[1]))
        expected = np.stack([shifted.real, shifted.imag], axis=1).ravel()
    ours = FourierDescriptorComputer(options).compute_contour(contour)
    np.testing.assert_allclose(ours, expected, atol=2e-5)


def test_resampled_outline_has_equal_steps() -> None:
    contour = trace_contour(hand())
    points = resample_contour(contour, 200)
    steps = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    assert np.std(steps) < 0.1 * np.mean(steps)
    distance = np.hypot(*(points[:, None] - contour[None]).transpose(2, 0, 1)).min(axis=1)
    assert distance.max() < 1.0
    np.testing.assert_array_equal(resample_contour(contour[:1], 3), np.repeat(contour[:1], 3, axis=0))
    with pytest.raises(InvalidArgument, match="num_points"):
        resample_contour(contour, 0)
    with pytest.raises(InvalidArgument, match="empty"):
        resample_contour(contour[:0], 4)


def test_wavelet_descriptor_is_the_integral_of_the_paper() -> None:
    """Eq. 3.20-3.24 in double, pixel by pixel."""
    mask = hand()
    y, x = np.nonzero(mask)
    x, y = x - x.mean(), y - y.mean()
    largest_radius = np.hypot(x, y).max() + 0.5
    r, theta = np.hypot(x, y) / largest_radius, np.arctan2(y, x)
    a, f0, variance = 0.697066, 0.409177, 0.561145

    def psi(u: np.ndarray) -> np.ndarray:
        v = 2 * u - 1
        gauss = np.exp(-(v**2) / (2 * variance * 4))
        return 4 * a**4 / np.sqrt(2 * np.pi * 4) * np.sqrt(variance) * np.cos(2 * np.pi * f0 * v) * gauss

    assert b_spline_wavelet(0.3) == pytest.approx(psi(np.array(0.3)), rel=1e-12)
    expected = [
        abs(np.sum(2 ** (m / 2) * psi(2**m * r - n / 2) * np.exp(1j * b * theta))) / largest_radius**2
        for b in range(4)
        for m in range(4)
        for n in range(2 ** (m + 1) + 1)
    ]
    ours = WaveletDescriptorComputer().compute(mask)
    np.testing.assert_allclose(ours, expected, atol=2e-3 * max(expected))


SHAPE_KINDS = {
    "wavelet": {},
    "wavelet of the outline": {"source": "contour"},
    "fourier": {},
    "moments": {},
}


def shape(mask: Mask, kind: str) -> np.ndarray:
    (row,) = hand_features([mask], [mask], kind.split()[0], **SHAPE_KINDS[kind])
    return row


def relative_changes(masks: list[Mask], kind: str, turn_deg: float, scale: float) -> float:
    """Mean change of a feature when shapes are turned and scaled, over their mean distance from one another."""
    before = np.array([shape(mask, kind) for mask in masks])
    after = np.array([shape(moved(mask, turn_deg, scale, side=len(mask)), kind) for mask in masks])
    apart = np.linalg.norm(before[:, None] - before[None], axis=2)
    apart = apart.sum() / (len(masks) * (len(masks) - 1))
    return float(np.linalg.norm(after - before, axis=1).mean() / apart)


@pytest.mark.parametrize("kind", SHAPE_KINDS)
@pytest.mark.parametrize(("turn_deg", "scale"), [(0, 1), (33, 1), (90, 1), (170, 1), (0, 0.6), (0, 1.4), (-50, 0.8)])
def test_drawn_hands_may_be_moved_turned_and_scaled(kind: str, turn_deg: float, scale: float) -> None:
    masks = [hand(person, label) for person, label in enumerate("0123456789")]
    assert relative_changes(masks, kind, turn_deg, scale) < 0.2


@pytest.mark.data
@pytest.mark.parametrize("kind", SHAPE_KINDS)
def test_real_hands_may_be_moved_turned_and_scaled(kind: str) -> None:
    """On pictures of 100 x 100 a finger is 8 pixels wide, so that half a pixel counts."""
    folder = Path(os.environ["HRI_DATA"]) / "sign_digits"
    if not folder.is_dir():
        pytest.skip("HRI_DATA has no folder sign_digits")
    masks = []
    for number, person in enumerate(sorted(path for path in folder.iterdir() if path.is_dir())[:20]):
        found = find_silhouettes([read_image(person / f"{number % 10}.jpg")])[0].mask
        masks.append(moved(found, side=240))
    for turn_deg, scale in [(0, 1), (90, 1), (33, 1), (0, 1.4), (140, 1.4)]:
        assert relative_changes(masks, kind, turn_deg, scale) < 0.25, (turn_deg, scale)


def test_every_kind_has_names_for_its_columns() -> None:
    masks = [hand(0, "1"), np.zeros((400, 400), "u1"), hand(0, "3")]
    options = {
        "orientation": [{}, {"num_cells": 3, "num_bins": 9}],
        "frame-orientation": [{}, {"num_bins": 36}],
        "dwt-mfcc": [
            {},
            {"signal": "picture", "num_frames": 11, "average_frames": False, "num_cepstra": 11},
            {"num_levels": 0, "average_frames": False},
        ],
        "wavelet": [{}, {"num_scales": 2, "num_frequencies": 7}],
        "fourier": [{}, {"use_phase": True, "num_harmonics": 3}],
        "chain-code": [{}, {"num_parts": 4, "use_turns": True}],
        "track": [{}, {"delta_orders": 0}, {"delta_orders": 2, "frames_per_second": 15.0}],
    }
    for kind in HAND_KINDS:
        for fields in options.get(kind, [{}]):
            rows = hand_features(masks, masks, kind, **fields)
            names = hand_column_names(kind, **fields)
            assert rows.dtype == np.float32 and rows.shape == (2, len(names)) and len(set(names)) == len(names)
            assert np.isfinite(rows).all()
            assert hand_features([], [], kind, **fields).shape == (0, len(names))


def test_track_follows_the_hand() -> None:
    frames = [np.zeros((120, 160), "u1") for _ in range(6)]
    for i, frame in enumerate(frames):
        frame[40:60, 20 + 6 * i : 40 + 6 * i] = 255
    rows = hand_features(frames, frames, "track", frames_per_second=10.0)
    columns = dict(zip(hand_column_names("track"), rows.T, strict=True))
    np.testing.assert_allclose(columns["x"], (30 + 6 * np.arange(6)) / 120, atol=1e-6)
    np.testing.assert_allclose(columns["speed"][1:], 6 / 120 * 10, atol=1e-5)
    np.testing.assert_allclose(columns["move_cosine"][1:], 1, atol=1e-6)
    assert columns["d_x"][3] == pytest.approx(6 / 120, abs=1e-6)


def test_kinds_and_options_that_there_are_not_are_refused() -> None:
    mask = hand()
    with pytest.raises(InvalidArgument, match="kind must be one of hand, orientation"):
        hand_features([mask], [mask], "sift")
    with pytest.raises(TypeError, match="num_harmonic"):
        hand_features([mask], [mask], "fourier", num_harmonic=3)
    with pytest.raises(TypeError):
        hand_features([mask], [mask], "moments", order=3)
    with pytest.raises(InvalidArgument, match="num_harmonics"):
        hand_features([mask], [mask], "fourier", num_harmonics=64)
    with pytest.raises(InvalidArgument, match="num_parts"):
        hand_features([mask], [mask], "chain-code", num_parts=0)
    with pytest.raises(ValueError, match="source"):
        hand_features([mask], [mask], "wavelet", source="face")
    with pytest.raises(InvalidArgument, match="differ in length"):
        hand_features([mask], [], "hand")
    with pytest.raises(InvalidArgument, match="another size"):
        hand_features([mask, mask[:9]], [mask, mask[:9]], "track")
    with pytest.raises(InvalidArgument, match="empty"):
        WaveletDescriptorComputer().compute(np.zeros((5, 5), "u1"))


@pytest.mark.parametrize("mask", [np.full((1, 1), 255), np.eye(30) * 255, np.full((40, 3), 255), np.eye(1, 900) * 255])
def test_strange_masks_have_finite_shapes(mask: Mask) -> None:
    mask = mask.astype("u1")
    for kind in HAND_KINDS:
        assert np.isfinite(hand_features([mask], [mask], kind)).all(), kind


def test_shapes_are_the_same_in_every_thread() -> None:
    masks = [hand(person, "5") for person in range(3)]
    options = HandFeatureOptions(
        use_wavelet=True, use_moments=True, use_fourier=True, use_chain_code=True, use_grey=False
    )
    computer = HandFeatureComputer(options)
    expected = [computer.compute(mask, mask) for mask in masks]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda mask: computer.compute(mask, mask), masks * 4))
    for row, place in zip(found, range(12), strict=True):
        np.testing.assert_array_equal(row, expected[place % 3])
