// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Stationary wavelet transform (a trous; Holschneider et al., 1989; Nason and Silverman, 1995),
// equal to PyWavelets' swt: no level is decimated, so that a shift of the signal shifts all
// coefficients alike. The signal is periodic.
#pragma once

#include <cstddef>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

/// The most levels: how often num_samples can be halved; 0 for odd lengths and for none.
HRI_API int max_swt_level(std::size_t num_samples);

/// `approximations` and `details` have shape (num_levels, x.size()), row l of level l + 1; T is
/// float or double. Throws InvalidArgument for levels outside 1..max_swt_level() and for shapes
/// that do not fit.
template <class T>
HRI_API void swt(Span<const T> x, const Wavelet& wavelet, Eigen::Ref<Matrix<T>> approximations,
                 Eigen::Ref<Matrix<T>> details);

/// The inverse from the approximation of the highest level (n) and the details of all, shape
/// (num_levels, n); of all signals with such coefficients, the mean over the bases of shifts.
template <class T>
HRI_API void iswt(Span<const T> approximation, const Eigen::Ref<const Matrix<T>>& details,
                  const Wavelet& wavelet, Span<T> x);

}  // namespace hri
