// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Linear prediction of a windowed frame by the autocorrelation method: x[n] is predicted as
// -a[1] x[n-1] - ... - a[p] x[n-p], and the frame's spectrum is modelled as gain / |A|^2 with
// A(z) = 1 + a[1] z^-1 + ... (Rabiner and Juang, Fundamentals of Speech Recognition, 1993, ch. 3).
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// r[k] = sum over n of x[n] x[n + k], k = 0 .. r.size() - 1.
HRI_API void autocorrelation(Span<const double> x, Span<double> r);

/// Levinson-Durbin: a[1] .. a[p] into `a` (p values) from r[0] .. r[p]. Gives the energy of what is
/// not predicted (the gain). A frame without energy is predicted by zeros.
HRI_API double levinson_durbin(Span<const double> r, Span<double> a);

/// Cepstrum of the log spectrum ln(gain / |A|^2) = c[0] + 2 sum of c[n] cos(n w): c[0] = ln gain,
/// c[n] = -a[n] - sum over k < n of (k / n) c[k] a[n - k]; c may be longer than a. gain > 0.
HRI_API void lpc_cepstrum(Span<const double> a, double gain, Span<double> c);

}  // namespace hri
