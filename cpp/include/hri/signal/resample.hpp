// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Change of sampling rate by a windowed-sinc low-pass filter (Kaiser window), any pair of rates.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// `samples` at `from_hz` as ceil(size * to_hz / from_hz) samples at `to_hz`; rates 1000..384000
/// Hz. The pass band ends at 0.9 of the lower Nyquist rate (0.2 dB down there), the stop band
/// begins at 1.02 of it and is 70 dB down. Throws InvalidArgument for rates out of range.
HRI_API std::vector<float> resample(Span<const float> samples, int from_hz, int to_hz);

}  // namespace hri
