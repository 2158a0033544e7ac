# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features of hands against plain NumPy, and silhouettes of drawn hands."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor

import cv2
import librosa
import numpy as np
import pytest
import pywt
from scipy.fft import dct

from hri.core.errors import InvalidArgument
from hri.features import (
    HandFeatureComputer,
    HandFeatureOptions,
    OrientationHistogramOptions,
    SilhouetteCepstrumComputer,
    SilhouetteCepstrumOptions,
    orientation_histogram,
)
from hri.features.hand import hand_column_names, hand_features
from hri.synthetic.drawing.signer import make_signer
from hri.synthetic.signer import draw_still
from hri.vision import SilhouetteExtractor, SilhouetteOptions


def picture(rows: int, columns: int, seed: int = 0) -> np.ndarray:
    """Smooth blobs, float32, 0..1."""
    noise = np.random.default_rng(seed).random((rows, columns)).astype("f4")
    return cv2.GaussianBlur(noise, (0, 0), 2.0)


def normalised(block: np.ndarray) -> np.ndarray:
    block = np.minimum(scaled_to_unit(block), 0.2)
    return block / np.sqrt((block**2).sum() + 1e-3) if block.any() else block


def scaled_to_unit(block: np.ndarray) -> np.ndarray:
    return block / np.sqrt((block**2).sum() + 0.1**2)


def reference(image: np.ndarray, num_cells: int, num_bins: int) -> np.ndarray:
    """Orientation histograms in double: every pixel deals its gradient out to two bins of up to four cells."""
    image = image.astype("f8")
    gx, gy = np.zeros(image.shape), np.zeros(image.shape)
    gx[1:-1, 1:-1] = image[1:-1, 2:] - image[1:-1, :-2]
    gy[1:-1, 1:-1] = image[2:, 1:-1] - image[:-2, 1:-1]
    magnitude, angle = np.hypot(gx, gy), np.arctan2(gy, gx) % np.pi

    def shares(positions: np.ndarray, count: int, wraps: bool) -> np.ndarray:
        """Triangular weight of every position for each of `count` centres one apart, shape (..., count)."""
        away = np.abs(positions[..., None] - np.arange(count))
        return np.maximum(0, 1 - (np.minimum(away, count - away) if wraps else away))

    def along(size: int) -> np.ndarray:
        return shares((np.arange(size) + 0.5) * num_cells / size - 0.5, num_cells, wraps=False)

    bins = shares(angle / np.pi * num_bins - 0.5, num_bins, wraps=True) * magnitude[..., None]
    cells = np.einsum("yi,xj,yxb->ijb", along(image.shape[0]), along(image.shape[1]), bins)
    if num_cells == 1:
        return scaled_to_unit(cells.ravel())
    places = [(i, j) for i in range(num_cells - 1) for j in range(num_cells - 1)]
    return np.concatenate([normalised(cells[i : i + 2, j : j + 2].ravel()) for i, j in places])


@pytest.mark.parametrize(("num_cells", "num_bins"), [(1, 18), (1, 36), (2, 9), (8, 9), (5, 3)])
@pytest.mark.parametrize("shape", [(40, 60), (64, 64), (9, 11)])
def test_orientation_histogram_equals_its_definition(num_cells: int, num_bins: int, shape: tuple[int, int]) -> None:
    image = picture(*shape)
    options = OrientationHistogramOptions(num_cells=num_cells, num_bins=num_bins)
    ours = orientation_histogram(image, options)
    theirs = reference(image, num_cells, num_bins)
    assert ours.dtype == np.float32 and ours.shape == theirs.shape
    # Sums of single precision in another order; blocks have length 1.
    np.testing.assert_allclose(ours, theirs, atol=1e-5)


def test_orientation_histogram_tells_directions_apart() -> None:
    options = OrientationHistogramOptions(num_cells=1, num_bins=18)
    y, x = np.mgrid[:48, :64]
    for bin_index in range(18):
        angle = np.deg2rad(10 * bin_index + 5)
        ramp = (x * np.cos(angle) + y * np.sin(angle)).astype("f4")
        for image in (ramp, -ramp):  # only the direction of the edge counts, not its sign
            assert orientation_histogram(image, options).argmax() == bin_index


@pytest.mark.parametrize("value", [0.0, 0.5, 1e6])
def test_flat_picture_has_no_orientation(value: float) -> None:
    np.testing.assert_array_equal(orientation_histogram(np.full((20, 20), value, "f4")), 0)


def test_orientation_histogram_takes_any_layout() -> None:
    image = picture(32, 48)
    expected = orientation_histogram(image)
    np.testing.assert_array_equal(orientation_histogram(image.astype("f8")), expected)
    np.testing.assert_array_equal(orientation_histogram(np.repeat(image, 2, axis=1)[:, ::2]), expected)
    np.testing.assert_array_equal(orientation_histogram(np.asfortranarray(image)), expected)


@pytest.mark.parametrize(
    ("shape", "fields", "message"),
    [
        ((2, 20), {"num_cells": 1}, "at least 3"),
        ((20, 7), {"num_cells": 8}, "num_cells"),
        ((20, 20), {"num_cells": 0}, "num_cells"),
        ((20, 20), {"num_bins": 1}, "num_bins"),
        ((400,), {}, "2 dimensions, got 1"),
        ((20, 20, 3), {}, "2 dimensions, got 3"),
    ],
)
def test_orientation_histogram_names_what_does_not_fit(shape: tuple[int, ...], fields: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        orientation_histogram(np.zeros(shape, "f4"), OrientationHistogramOptions(**fields))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 3e38])
def test_value_without_a_direction_is_named(bad: float) -> None:
    image = picture(20, 30)
    image[7, 19] = bad
    with pytest.raises(InvalidArgument, match="row 7, column 19"):
        orientation_histogram(image)


def disc(size_px: int = 200, radius_px: float = 60.0) -> np.ndarray:
    y, x = np.mgrid[:size_px, :size_px] - size_px / 2
    return np.where(np.hypot(x, y) < radius_px, 255, 0).astype("u1")


def test_parts_of_the_feature_stand_side_by_side() -> None:
    grey, mask = (255 * picture(200, 200)).astype("u1"), disc()

    def parts(*names: str) -> np.ndarray:
        chosen = {f"use_{name}": name in names for name in ("grey", "silhouette", "cepstrum")}
        computer = HandFeatureComputer(HandFeatureOptions(**chosen))
        values = computer.compute(grey, mask)
        assert values.dtype == np.float32 and values.shape == (computer.num_features,)
        return values

    whole = parts("grey", "silhouette", "cepstrum")
    np.testing.assert_array_equal(whole, np.concatenate([parts("grey"), parts("silhouette"), parts("cepstrum")]))
    weight = np.float32(HandFeatureOptions().cepstrum_weight)
    cepstrum = SilhouetteCepstrumComputer().compute(mask)
    np.testing.assert_allclose(parts("cepstrum"), weight * cepstrum, rtol=1e-6)


def test_contour_of_a_disc_is_flat_and_of_a_square_has_four_corners() -> None:
    computer = SilhouetteCepstrumComputer()
    flat = computer.contour_signal(disc())
    assert flat.dtype == np.float32 and flat.shape == (SilhouetteCepstrumOptions().num_points,)
    np.testing.assert_allclose(flat, 1, atol=0.06)
    square = np.zeros((200, 200), "u1")
    square[50:150, 50:150] = 255
    signal = computer.contour_signal(square)
    assert np.abs(np.fft.rfft(signal))[1:20].argmax() + 1 == 4
    assert signal.max() / signal.min() == pytest.approx(np.sqrt(2), rel=0.1)


def framed(signal: np.ndarray, num_frames: int, num_filters: int, num_cepstra: int) -> np.ndarray:
    """Thesis equations 3.26 to 3.33 in double: frames that overlap by half, at 16 kHz, none longer than a second."""
    shift = len(signal) // (num_frames + 1)
    size = 2 ** int(np.ceil(np.log2(2 * shift)))
    frames = np.stack([signal[shift * i : shift * (i + 2)] for i in range(num_frames)]) * np.hamming(2 * shift)
    power = np.abs(np.fft.rfft(frames, size)) ** 2
    rate_hz = max(16000, 2 * shift)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of short frames some filters hold no frequency
        bank = librosa.filters.mel(sr=rate_hz, n_fft=size, n_mels=num_filters, htk=True, norm=None)
    return dct(np.log(np.maximum(power @ bank.T, 1e-10)), norm="ortho")[:, : num_cepstra + 1]


@pytest.mark.parametrize(("wavelet", "num_levels"), [("haar", 0), ("haar", 1), ("haar", 3), ("db2", 3), ("sym8", 2)])
@pytest.mark.parametrize("num_frames", [1, 11, 14])
def test_cepstra_of_a_picture_equal_the_formulae(wavelet: str, num_levels: int, num_frames: int) -> None:
    mask = SilhouetteExtractor().extract(draw_still(make_signer(0), "3")).mask
    fields = {"signal": "picture", "mask_px": 128, "num_frames": num_frames, "num_filters": 26, "num_cepstra": 11}
    square = SilhouetteCepstrumComputer(SilhouetteCepstrumOptions(num_levels=0, mask_px=128)).picture_signal(mask)
    approximation = square.reshape(128, 128).T.astype("f8")
    assert 0.2 < approximation.mean() < 0.8 and approximation.max() == 1
    for _ in range(num_levels):
        approximation = pywt.dwt2(approximation, wavelet, mode="zero")[0] / 2
    chosen = SilhouetteCepstrumOptions(wavelet=wavelet, num_levels=num_levels, average_frames=False, **fields)
    computer = SilhouetteCepstrumComputer(chosen)
    np.testing.assert_allclose(computer.picture_signal(mask), approximation.T.ravel(), atol=1e-6)
    ours, theirs = computer.compute(mask), framed(approximation.T.ravel(), num_frames, 26, 11)
    assert ours.dtype == np.float32 and ours.shape == (computer.num_features,) == (num_frames * 12,)
    # Single precision, then a logarithm.
    np.testing.assert_allclose(ours.reshape(num_frames, 12), theirs, atol=2e-2)
    averaged = SilhouetteCepstrumOptions(wavelet=wavelet, num_levels=num_levels, average_frames=True, **fields)
    mean = SilhouetteCepstrumComputer(averaged).compute(mask)
    np.testing.assert_allclose(mean, ours.reshape(num_frames, 12).mean(axis=0), atol=1e-3)


def test_framed_cepstra_are_those_of_the_thesis_by_default() -> None:
    mask = SilhouetteExtractor().extract(draw_still(make_signer(0), "3")).mask
    square = SilhouetteCepstrumComputer(SilhouetteCepstrumOptions(num_levels=0)).picture_signal(mask).reshape(256, 256)
    approximation = square.astype("f8").reshape(32, 8, 32, 8).mean(axis=(1, 3))  # three levels of "haar", columns first
    found = hand_features([mask], [mask], "framed-mfcc")
    assert found.dtype == np.float32 and found.shape == (1, 11 * 12)
    np.testing.assert_allclose(found.reshape(11, 12), framed(approximation.ravel(), 11, 26, 11), atol=2e-2)
    names = hand_column_names("framed-mfcc")
    assert names[0] == "frame0_c0" and names[11:13] == ["frame0_c11", "frame1_c0"] and len(names) == 132
    outline = hand_features([mask], [mask], "framed-mfcc", signal="contour", num_levels=0)
    same = {"num_frames": 11, "average_frames": False, "num_filters": 26, "num_cepstra": 11, "num_levels": 0}
    np.testing.assert_array_equal(outline, hand_features([mask], [mask], "dwt-mfcc", **same))
    assert hand_features([mask], [mask], "framed-mfcc", num_frames=5, num_cepstra=7).shape == (1, 5 * 8)
    with pytest.raises(InvalidArgument, match="too small for num_frames"):
        hand_features([mask], [mask], "framed-mfcc", mask_px=64)


def test_picture_signal_is_the_cropped_mask_column_by_column() -> None:
    mask = np.zeros((300, 400), "u1")
    mask[100:228, 50:178] = 255  # a square, which gets 8 % of its side around it
    mask[110:228, 120:178] = 0
    signal = SilhouetteCepstrumComputer(SilhouetteCepstrumOptions(num_levels=0)).picture_signal(mask)
    found = signal.reshape(256, 256).T
    edge = 1.16 * 128 / 256  # pixels of the mask per pixel of the crop
    rows, columns = ((np.arange(256) + 0.5) * edge - 0.08 * 128 + first for first in (100, 50))
    expected = mask[np.floor(rows).astype(int)][:, np.floor(columns).astype(int)] / 255
    inside = cv2.erode((expected > 0).astype("u1"), np.ones((5, 5)))
    outside = cv2.dilate((expected > 0).astype("u1"), np.ones((5, 5)))
    np.testing.assert_allclose(found[inside > 0], 1, atol=1e-6)
    np.testing.assert_allclose(found[outside == 0], 0, atol=1e-6)


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"signal": "picture", "mask_px": 64, "num_levels": 4, "num_frames": 32}, "mask_px after num_levels is too s"),
        ({"signal": "picture", "mask_px": 1024, "num_levels": 0}, "mask_px after num_levels is too large"),
        ({"num_points": 64, "num_frames": 20}, "num_points is too few"),
        ({"num_frames": 33}, "num_frames must lie in 1..32"),
        ({"num_cepstra": 20}, "num_cepstra must be less than num_filters"),
    ],
)
def test_frames_that_do_not_fit_a_silhouette_are_refused(fields: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        SilhouetteCepstrumComputer(SilhouetteCepstrumOptions(**fields))
    with pytest.raises(ValueError, match="'contour', 'picture'"):
        SilhouetteCepstrumOptions(signal="outline")


def test_orientation_of_the_whole_frame_is_that_of_its_60_by_40_pixels() -> None:
    grey = (255 * picture(480, 640, seed=3)).astype("u1")
    small = grey.reshape(40, 12, 640).mean(axis=1)
    weights = np.zeros((640, 60))
    for x in range(60):  # a pixel of the small picture is 10 2/3 of the large one's wide
        left, right = x * 32 / 3, (x + 1) * 32 / 3
        cover = np.minimum(np.arange(640) + 1, right) - np.maximum(np.arange(640), left)
        weights[:, x] = np.maximum(cover, 0) / (32 / 3)
    small = np.rint(small @ weights) / 255
    mask = np.zeros_like(grey)
    mask[200:210, 300:330] = 255  # where the hand is does not matter
    for num_bins in (9, 18, 27, 36):
        (ours,) = hand_features([grey], [mask], "frame-orientation", num_bins=num_bins)
        np.testing.assert_allclose(ours, reference(small, 1, num_bins), atol=5e-3)
        assert np.linalg.norm(ours) == pytest.approx(1, abs=1e-2)


def test_feature_takes_any_layout_of_bytes_and_nothing_else() -> None:
    computer = HandFeatureComputer()
    grey, mask = (255 * picture(200, 200)).astype("u1"), disc()
    expected = computer.compute(grey, mask)
    np.testing.assert_array_equal(
        computer.compute(np.repeat(grey, 2, axis=1)[:, ::2], np.asfortranarray(mask)), expected
    )
    with pytest.raises(TypeError):
        computer.compute(grey.astype("f4"), mask)
    with pytest.raises(InvalidArgument, match="2 dimensions, got 3"):
        computer.compute(grey[..., None], mask)
    with pytest.raises(InvalidArgument, match="same size"):
        computer.compute(grey[:100], mask)
    with pytest.raises(InvalidArgument, match="empty"):
        computer.compute(grey, np.zeros_like(mask))


@pytest.mark.parametrize("mask", [np.full((1, 1), 255), np.eye(30) * 255, np.full((40, 3), 255), np.eye(1, 900) * 255])
def test_strange_masks_give_finite_features(mask: np.ndarray) -> None:
    mask = mask.astype("u1")
    assert np.isfinite(HandFeatureComputer().compute(mask, mask)).all()


@pytest.mark.parametrize("person", range(4))
def test_drawn_hand_is_cut_out_of_its_wall(person: int) -> None:
    bgr = draw_still(make_signer(person), "5")
    found = SilhouetteExtractor().extract(bgr)
    assert found.grey.shape == found.mask.shape == bgr.shape[:2]
    assert found.grey.dtype == found.mask.dtype == np.uint8
    assert set(np.unique(found.mask)) == {0, 255}
    assert 0.7 < found.quality <= 1
    assert cv2.connectedComponents(found.mask)[0] == 2  # the background and one hand
    np.testing.assert_allclose(found.grey, cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY), atol=1)
    # Inside there is skin, redder than any wall; outside there is not.
    redness = bgr[..., 2].astype(int) - bgr[..., 0]
    inside = cv2.erode(found.mask, np.ones((5, 5))) > 0
    outside = cv2.dilate(found.mask, np.ones((9, 9))) == 0
    outside[120:] = False  # the sleeve
    assert np.mean(redness[inside] > np.quantile(redness[outside], 0.99)) > 0.97


def num_gaps(mask: np.ndarray) -> int:
    """Number of deep bays in the outline: gaps between fingers."""
    contour = max(cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0], key=cv2.contourArea)
    defects = cv2.convexityDefects(contour, cv2.convexHull(contour, returnPoints=False))
    return int(sum(depth / 256 > 15 for *_, depth in defects.reshape(-1, 4)))


def test_silhouette_keeps_the_fingers() -> None:
    for person in range(3):
        extractor = SilhouetteExtractor()
        gaps = [num_gaps(extractor.extract(draw_still(make_signer(person), label)).mask) for label in "0245"]
        assert gaps == [0, 2, 3, 4]  # beside the second finger of a 2 the fist is a bay, too


def test_wall_alone_holds_no_hand() -> None:
    found = SilhouetteExtractor().extract(np.full((240, 320, 3), (180, 170, 160), np.uint8))
    assert not found.mask.any() and found.quality == 0


def test_silhouette_outlives_its_extractor_and_is_the_same_in_every_thread() -> None:
    pictures = [draw_still(make_signer(person), "3") for person in range(3)]
    expected = [SilhouetteExtractor().extract(p).mask for p in pictures]
    extractor = SilhouetteExtractor()
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda p: extractor.extract(p).mask, pictures * 4))
    for mask, place in zip(found, range(12), strict=True):
        np.testing.assert_array_equal(mask, expected[place % 3])


def test_silhouette_takes_any_layout_of_bytes_and_nothing_else() -> None:
    extractor = SilhouetteExtractor()
    bgr = draw_still(make_signer(0), "4")
    expected = extractor.extract(bgr).mask
    np.testing.assert_array_equal(extractor.extract(np.repeat(bgr, 2, axis=1)[:, ::2]).mask, expected)
    np.testing.assert_array_equal(extractor.extract(np.asfortranarray(bgr)).mask, expected)
    with pytest.raises(TypeError):
        extractor.extract(bgr / 255)
    with pytest.raises(InvalidArgument, match="3 dimensions, got 2"):
        extractor.extract(bgr[..., 0].copy())
    with pytest.raises(InvalidArgument, match="3 channels, got 4"):
        extractor.extract(np.zeros((20, 20, 4), "u1"))
    with pytest.raises(InvalidArgument):
        extractor.extract(np.zeros((0, 0, 3), "u1"))
    with pytest.raises(InvalidArgument, match="blur_px"):
        SilhouetteExtractor(SilhouetteOptions(blur_px=4))


SKIN_BOUNDS = {  # hue in degrees, saturation and value 0..1: hsv_narrow, hsv_wide
    (20, 0.40, 0.80): (True, True),
    (48, 0.30, 0.80): (True, True),
    (54, 0.30, 0.80): (False, True),
    (20, 0.61, 0.80): (False, True),
    (20, 0.22, 0.80): (False, True),
    (20, 0.40, 0.12): (False, True),  # value 31 of 255
    (20, 0.18, 0.80): (False, False),
    (20, 0.97, 0.80): (False, False),
    (190, 0.40, 0.80): (False, True),
    (206, 0.40, 0.80): (False, False),
}


@pytest.mark.parametrize("colour", SKIN_BOUNDS)
def test_fixed_bounds_of_skin_are_those_of_the_thesis(colour: tuple[float, float, float]) -> None:
    hue, saturation, value = colour
    patch = cv2.cvtColor(np.array([[[hue / 2, 255 * saturation, 255 * value]]], "u1"), cv2.COLOR_HSV2BGR)[0, 0]
    frame = np.full((200, 200, 3), (150, 150, 150), np.uint8)
    frame[60:140, 70:130] = patch
    for method, expected in zip(("hsv_narrow", "hsv_wide"), SKIN_BOUNDS[colour], strict=True):
        found = SilhouetteExtractor(SilhouetteOptions(method=method, remove_face=False)).extract(frame).mask
        centre = found[90:110, 90:110]  # the blur mixes colours at the edge
        assert centre.all() == centre.any() == expected, method
