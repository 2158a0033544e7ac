// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Spectral envelope of a cepstrum (thesis eq. 3.34-3.36).
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// out[t - 1] = exp(sum of c_i cos(i w_t)), w_t = pi t / n, t = 1 .. n = out.size(), from c_1, c_2,
/// ... in `cepstra`. The frequency axis is that of the cepstra (mel for MFCC). The power spectrum
/// that belongs to a cepstrum is exp(c_0) times the square of this.
HRI_API void spectral_envelope(Span<const float> cepstra, Span<float> out);

}  // namespace hri
