// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Discrete wavelet transform, one- and two-dimensional, and its inverse (thesis section 6.2.2),
// equal to PyWavelets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

/// What stands beyond the ends of x = (a b c d):
///   symmetric        d c b a | a b c d | d c b a
///   zero             0 0 0 0 | a b c d | 0 0 0 0
///   constant         a a a a | a b c d | d d d d
///   periodic         a b c d | a b c d | a b c d
///   reflect            d c b | a b c d | c b a
///   periodization    as periodic, but with the fewest coefficients: half the length, rounded up
///   (the thesis's padding)
enum class Border : std::uint8_t { symmetric, zero, constant, periodic, reflect, periodization };

/// Coefficients of one level: (n + taps - 1) / 2, or (n + 1) / 2 for periodization.
std::size_t dwt_length(std::size_t num_samples, std::size_t num_taps, Border border);

/// One level: `approx` and `detail` have dwt_length() values. T is float or double; sums are taken
/// in T. Throws InvalidArgument for an empty signal and for lengths that do not fit.
template <class T>
void dwt(Span<const T> x, const Wavelet& wavelet, Border border, Span<T> approx, Span<T> detail);

/// The inverse of one level: `x` has 2 size - taps + 2 values (periodization: 2 size), of which a
/// signal of odd length takes one less.
template <class T>
void idwt(Span<const T> approx, Span<const T> detail, const Wavelet& wavelet, Border border,
          Span<T> x);

/// Coefficients of several levels as PyWavelets orders them: approximation, then details from
/// coarse to fine.
template <class T>
struct WaveletDecomposition {
  std::vector<std::vector<T>> coefficients;
  std::size_t num_samples = 0;  ///< length of the signal, to which waverec cuts
};
/// Both throw InvalidArgument: for an empty signal, and for coefficients that no signal has.
template <class T>
WaveletDecomposition<T> wavedec(Span<const T> x, const Wavelet& wavelet, Border border,
                                int num_levels);
template <class T>
std::vector<T> waverec(const WaveletDecomposition<T>& decomposition, const Wavelet& wavelet,
                       Border border);

/// One level of an image, rows then columns; details as PyWavelets names them.
template <class T>
struct Dwt2 {
  Matrix<T> approx;
  Matrix<T> horizontal;
  Matrix<T> vertical;
  Matrix<T> diagonal;
};
template <class T>
Dwt2<T> dwt2(const Matrix<T>& image, const Wavelet& wavelet, Border border);
/// The inverse; cut to (rows, cols) of the image. Throws InvalidArgument for shapes that do not
/// fit.
template <class T>
Matrix<T> idwt2(const Dwt2<T>& level, const Wavelet& wavelet, Border border, Eigen::Index rows,
                Eigen::Index cols);

}  // namespace hri
