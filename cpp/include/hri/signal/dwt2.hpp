// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Discrete wavelet transform of pictures and its inverse, equal to PyWavelets. T is float or
// double.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {

/// One level of a picture; details as PyWavelets names them: horizontal ones answer to horizontal
/// edges.
template <class T>
struct Dwt2 {
  Matrix<T> approx;
  Matrix<T> horizontal;
  Matrix<T> vertical;
  Matrix<T> diagonal;
};

/// Where one level of a picture is written to.
template <class T>
struct Dwt2Bands {
  Eigen::Ref<Matrix<T>> approx;
  Eigen::Ref<Matrix<T>> horizontal;
  Eigen::Ref<Matrix<T>> vertical;
  Eigen::Ref<Matrix<T>> diagonal;
};

struct Dwt2Shape {
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;
};
/// The shape of each of the four bands.
HRI_API Dwt2Shape dwt2_shape(Eigen::Index rows, Eigen::Index cols, std::size_t num_taps,
                             Border border);

/// One level. Throws InvalidArgument for an empty picture.
template <class T>
HRI_API Dwt2<T> dwt2(const Eigen::Ref<const Matrix<T>>& image, const Wavelet& wavelet,
                     Border border);
/// The same into bands of dwt2_shape(). Allocates nothing once the thread has transformed a picture
/// of this shape.
template <class T>
HRI_API void dwt2(const Eigen::Ref<const Matrix<T>>& image, const Wavelet& wavelet, Border border,
                  Dwt2Bands<T> bands);

/// The inverse, cut to (rows, cols) of the picture. Throws InvalidArgument for shapes that do not
/// fit.
template <class T>
HRI_API Matrix<T> idwt2(const Dwt2<T>& level, const Wavelet& wavelet, Border border,
                        Eigen::Index rows, Eigen::Index cols);

/// Several levels of a picture.
template <class T>
struct WaveletDecomposition2 {
  Matrix<T> approx;
  std::vector<Dwt2<T>> details;  ///< from coarse to fine; their `approx` are empty
  Eigen::Index rows = 0;         ///< shape of the picture, to which waverec2 cuts
  Eigen::Index cols = 0;
};
/// Both throw InvalidArgument: for levels outside 1..62 and an empty picture, and for coefficients
/// that no picture has.
template <class T>
HRI_API WaveletDecomposition2<T> wavedec2(const Eigen::Ref<const Matrix<T>>& image,
                                          const Wavelet& wavelet, Border border, int num_levels);
template <class T>
HRI_API Matrix<T> waverec2(const WaveletDecomposition2<T>& decomposition, const Wavelet& wavelet,
                           Border border);

}  // namespace hri
