# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features of hands in one call, from grey pictures and masks: shapes, and the way of the hand through a clip."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri._native import (
    HAND_TRACK_COLUMNS,
    ChainCodeComputer,
    ChainCodeOptions,
    FourierDescriptorComputer,
    FourierDescriptorOptions,
    HandFeatureComputer,
    HandFeatureOptions,
    HandTrackComputer,
    HandTrackOptions,
    HybridFeatureComputer,
    HybridFeatureOptions,
    OrientationHistogramOptions,
    SilhouetteCepstrumComputer,
    SilhouetteCepstrumOptions,
    WaveletDescriptorComputer,
    WaveletDescriptorOptions,
    orientation_histogram,
)
from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv
from hri.features.motion import hybrid_column_names
from hri.features.shapes import hu_features

Kind = Literal[
    "hand",
    "orientation",
    "frame-orientation",
    "dwt-mfcc",
    "framed-mfcc",
    "wavelet",
    "fourier",
    "chain-code",
    "moments",
    "track",
    "hybrid",
]
Picture = NDArray[np.uint8]
Compute = Callable[[Picture, Picture], Any]
Rows = Callable[[Sequence[Picture] | Picture, Sequence[Picture] | Picture], Any]

FRAME_SIZE = (60, 40)
"""Width and height to which section 4.6.4 of the thesis scales whole pictures."""
FRAMED_CEPSTRUM: dict[str, Any] = {
    "signal": "picture",
    "wavelet": "haar",
    "num_levels": 3,
    "num_frames": 11,
    "average_frames": False,
    "num_filters": 26,
    "num_cepstra": 11,
}
"""Fields of `SilhouetteCepstrumOptions` as section 3.1.3 of the thesis has them: the approximation of three levels as
a column vector, blocked into 11 frames of 12 coefficients, c0 to c11 (text at figures 3.5 and 3.6). The text does not
give the wavelet (table 3.7 has Haar among others), the number of filters and the size of the mask."""


def hand_features(
    greys: Sequence[Picture] | Picture, masks: Sequence[Picture] | Picture, kind: Kind = "hand", **options: Any
) -> NDArray[np.float32]:
    """Features of every frame that shows a hand.

    Parameters
    ----------
    greys, masks : sequence of uint8 arrays, shape (height, width), or one of shape (num_frames, height, width)
        Grey pictures, and 255 where the hand is; a still is a sequence of one.
    kind : str
        One of `HAND_KINDS`: ``hand``, the concatenated features of `GestureRecognizer`; ``orientation`` histograms of
        the grey picture around the hand; ``frame-orientation``, of the whole grey picture, scaled to 60 x 40 (needs
        OpenCV); ``dwt-mfcc``, the cepstra of the silhouette; ``framed-mfcc``, the same with the defaults of
        `FRAMED_CEPSTRUM`, 11 frames of 12 coefficients side by side; ``wavelet``, moment-invariant wavelet descriptors;
        ``fourier`` descriptors; ``chain-code`` histograms; ``moments``, Hu's; ``track``, place, size, axis and speed;
        ``hybrid``, the hybrid feature of a whole gesture.
    **options
        Fields of the kind's options: `HandFeatureOptions`, `OrientationHistogramOptions`,
        `SilhouetteCepstrumOptions`, `WaveletDescriptorOptions`, `FourierDescriptorOptions`, `ChainCodeOptions`,
        `HandTrackOptions`, `HybridFeatureOptions`; moments have none.

    Returns
    -------
    ndarray of float32, shape (num_frames_with_hand, num_features)
        Columns as `hand_column_names` lists them.

    Raises
    ------
    InvalidArgument
        For a kind that there is not, pictures that do not fit together, or an option out of range (named).
    TypeError
        For an option that the kind has not.

    Examples
    --------
    >>> mask = np.zeros((60, 80), np.uint8)
    >>> mask[20:40, 10:70] = 255
    >>> hand_features([mask], [mask], "fourier", num_harmonics=4).shape
    (1, 8)
    """
    chosen, own = _chosen(kind, options)
    if len(greys) != len(masks):
        raise InvalidArgument(f"greys and masks differ in length: {len(greys)}, {len(masks)}")
    rows = own.compute(chosen)(greys, masks)
    return np.asarray(rows, np.float32).reshape(len(rows), len(own.names(chosen)))


def hand_column_names(kind: Kind = "hand", **options: Any) -> list[str]:
    """Names of the columns that `hand_features` gives for the same kind and options.

    Returns
    -------
    list of str
    """
    chosen, own = _chosen(kind, options)
    return own.names(chosen)


def _chosen(kind: str, options: dict[str, Any]) -> tuple[Any, _Kind]:
    if kind not in HAND_KINDS:
        raise InvalidArgument(f"kind must be one of {', '.join(HAND_KINDS)}, got {kind!r}")
    own = HAND_KINDS[kind]
    return own.options(**options), own


@dataclass(frozen=True)
class _Kind:
    """How one kind is made: its options, a function of all grey pictures and masks, the names of its columns."""

    options: Callable[..., Any]
    compute: Callable[[Any], Rows]
    names: Callable[[Any], list[str]]


def _each(make: Callable[[Any], Compute]) -> Callable[[Any], Rows]:
    """Of what is computed frame by frame: a row for each that shows a hand."""

    def of_clip(options: Any) -> Rows:
        compute = make(options)
        return lambda greys, masks: [
            compute(grey, mask) for grey, mask in zip(greys, masks, strict=True) if np.any(mask)
        ]

    return of_clip


def _whole(computer: Callable[[Any], Any]) -> Callable[[Any], Rows]:
    """Of what needs the whole clip."""
    return lambda options: lambda greys, masks: computer(options).compute(list(masks))


def _of_mask(computer: Callable[[Any], Any]) -> Callable[[Any], Rows]:
    def make(options: Any) -> Compute:
        compute = computer(options).compute
        return lambda grey, mask: compute(mask)

    return _each(make)


def _no_options() -> None:
    """Of a kind that has none: a keyword is an error."""


def _orientation_options(num_cells: int = 1, num_bins: int = 18) -> Any:
    return OrientationHistogramOptions(num_cells=num_cells, num_bins=num_bins)


def _orientation(options: Any) -> Compute:
    parts = HandFeatureOptions(histogram=options, use_silhouette=False, use_cepstrum=False)
    return HandFeatureComputer(parts).compute


def _orientation_names(options: Any) -> list[str]:
    if options.num_cells == 1:
        return [f"{180 * i / options.num_bins:g}_deg" for i in range(options.num_bins)]
    blocks = range((options.num_cells - 1) ** 2)
    return [f"block{b}_{cell}_bin{i}" for b in blocks for cell in range(4) for i in range(options.num_bins)]


def _frame_orientation(options: Any) -> Compute:
    cv2 = import_opencv("to scale pictures")
    return lambda grey, mask: orientation_histogram(
        cv2.resize(grey, FRAME_SIZE, interpolation=cv2.INTER_AREA) / np.float32(255), options
    )


def _framed_options(**fields: Any) -> SilhouetteCepstrumOptions:
    return SilhouetteCepstrumOptions(**FRAMED_CEPSTRUM | fields)


def _cepstrum_names(options: Any) -> list[str]:
    names = [f"c{i}" for i in range(options.num_cepstra + 1)]
    if options.average_frames:
        return names
    return [f"frame{frame}_{name}" for frame in range(options.num_frames) for name in names]


def _wavelet_names(options: Any) -> list[str]:
    pairs = [(m, n) for m in range(options.num_scales) for n in range(2 ** (m + 1) + 1)]
    return [f"b{b}_m{m}_n{n}" for b in range(options.num_frequencies) for m, n in pairs]


def _fourier_names(options: Any) -> list[str]:
    harmonics = [sign * k for k in range(1, options.num_harmonics + 1) for sign in (1, -1)]
    return [f"{part}{k}" for k in harmonics for part in (("re", "im") if options.use_phase else ("z",))]


def _chain_code_names(options: Any) -> list[str]:
    what = "turn" if options.use_turns else "direction"
    return [f"part{part}_{what}{d}" for part in range(options.num_parts) for d in range(8)]


def _track_names(options: Any) -> list[str]:
    orders = ("", "d_", "dd_")[: 1 + options.delta_orders]
    return [order + name for order in orders for name in HAND_TRACK_COLUMNS]


HAND_KINDS: dict[str, _Kind] = {
    "hand": _Kind(
        HandFeatureOptions,
        _each(lambda options: HandFeatureComputer(options).compute),
        lambda options: [f"f{i}" for i in range(HandFeatureComputer(options).num_features)],
    ),
    "orientation": _Kind(_orientation_options, _each(_orientation), _orientation_names),
    "frame-orientation": _Kind(_orientation_options, _each(_frame_orientation), _orientation_names),
    "dwt-mfcc": _Kind(SilhouetteCepstrumOptions, _of_mask(SilhouetteCepstrumComputer), _cepstrum_names),
    "framed-mfcc": _Kind(_framed_options, _of_mask(SilhouetteCepstrumComputer), _cepstrum_names),
    "wavelet": _Kind(WaveletDescriptorOptions, _of_mask(WaveletDescriptorComputer), _wavelet_names),
    "fourier": _Kind(FourierDescriptorOptions, _of_mask(FourierDescriptorComputer), _fourier_names),
    "chain-code": _Kind(ChainCodeOptions, _of_mask(ChainCodeComputer), _chain_code_names),
    "moments": _Kind(
        _no_options,
        _each(lambda options: lambda grey, mask: hu_features(mask)),
        lambda options: [f"hu{i}" for i in range(1, 8)],
    ),
    "track": _Kind(HandTrackOptions, _whole(HandTrackComputer), _track_names),
    "hybrid": _Kind(HybridFeatureOptions, _whole(HybridFeatureComputer), hybrid_column_names),
}
"""What `hand_features` can give, by name."""
