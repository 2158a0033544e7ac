# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signals: wavelet transforms by PyWavelets' names, noise reduction, end points, resampling, linear prediction."""

from hri._native import (
    ActivityOptions,
    Endpoint,
    Endpointer,
    EndpointerOptions,
    ShrinkageOptions,
    WaveletStreamOptions,
    frequency_order,
)
from hri.signal.arrays import MODES
from hri.signal.filters import FAMILIES, Wavelet, dwt_max_level, wavelist
from hri.signal.images import dwt2, idwt2, wavedec2, waverec2
from hri.signal.noise_reduction import approximation, denoise, noise_level, shrink, shrinkage_threshold
from hri.signal.packets import PacketNode, WaveletPacket, best_basis, wavelet_packets, waverec_packets
from hri.signal.speech import activity_frames, find_speech, linear_prediction, resample
from hri.signal.streams import WaveletStream
from hri.signal.wavelets import dwt, idwt, iswt, swt, swt_max_level, wavedec, waverec

__all__ = [
    "FAMILIES",
    "MODES",
    "ActivityOptions",
    "Endpoint",
    "Endpointer",
    "EndpointerOptions",
    "PacketNode",
    "ShrinkageOptions",
    "Wavelet",
    "WaveletPacket",
    "WaveletStream",
    "WaveletStreamOptions",
    "activity_frames",
    "approximation",
    "best_basis",
    "denoise",
    "dwt",
    "dwt2",
    "dwt_max_level",
    "find_speech",
    "frequency_order",
    "idwt",
    "idwt2",
    "iswt",
    "linear_prediction",
    "noise_level",
    "resample",
    "shrink",
    "shrinkage_threshold",
    "swt",
    "swt_max_level",
    "wavedec",
    "wavedec2",
    "wavelet_packets",
    "wavelist",
    "waverec",
    "waverec2",
    "waverec_packets",
]
