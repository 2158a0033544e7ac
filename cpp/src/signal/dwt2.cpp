// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/error.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {
namespace {

template <class T>
struct Halves {
  Matrix<T> low;
  Matrix<T> high;
};

// One level along the rows (each row is a signal).
template <class T>
Halves<T> split_rows(const Matrix<T>& m, const Wavelet& wavelet, Border border) {
  const auto cols = static_cast<std::size_t>(m.cols());
  const std::size_t count = dwt_length(cols, wavelet.dec_lo.size(), border);
  Halves<T> h{Matrix<T>(m.rows(), static_cast<Eigen::Index>(count)),
              Matrix<T>(m.rows(), static_cast<Eigen::Index>(count))};
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    dwt<T>({m.data() + r * m.cols(), cols}, wavelet, border,
           {h.low.data() + r * h.low.cols(), count}, {h.high.data() + r * h.high.cols(), count});
  }
  return h;
}

template <class T>
Matrix<T> join_rows(const Matrix<T>& low, const Matrix<T>& high, const Wavelet& wavelet,
                    Border border, Eigen::Index cols) {
  Matrix<T> m(low.rows(), cols);
  const auto count = static_cast<std::size_t>(low.cols());
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    idwt<T>({low.data() + r * low.cols(), count}, {high.data() + r * high.cols(), count}, wavelet,
            border, {m.data() + r * cols, static_cast<std::size_t>(cols)});
  }
  return m;
}

}  // namespace

template <class T>
Dwt2<T> dwt2(const Matrix<T>& image, const Wavelet& wavelet, Border border) {
  require(image.rows() > 0 && image.cols() > 0, "image must have at least one pixel");
  // Columns first, as the transposed image's rows.
  const Halves<T> vertical = split_rows<T>(Matrix<T>(image.transpose()), wavelet, border);
  const Halves<T> low = split_rows<T>(Matrix<T>(vertical.low.transpose()), wavelet, border);
  const Halves<T> high = split_rows<T>(Matrix<T>(vertical.high.transpose()), wavelet, border);
  return {low.low, high.low, low.high, high.high};
}

template <class T>
Matrix<T> idwt2(const Dwt2<T>& level, const Wavelet& wavelet, Border border, Eigen::Index rows,
                Eigen::Index cols) {
  const auto same = [&level](const Matrix<T>& m) {
    return m.rows() == level.approx.rows() && m.cols() == level.approx.cols();
  };
  require(same(level.horizontal) && same(level.vertical) && same(level.diagonal),
          "approximation and details must have one shape");
  require(rows > 0 && cols > 0, "image must have at least one pixel");
  const auto fits = [&](Eigen::Index num_pixels, Eigen::Index num_coefficients) {
    return dwt_length(static_cast<std::size_t>(num_pixels), wavelet.dec_lo.size(), border) ==
           static_cast<std::size_t>(num_coefficients);
  };
  require(fits(rows, level.approx.rows()) && fits(cols, level.approx.cols()),
          "coefficients are not those of an image of this shape");
  const Matrix<T> low = join_rows<T>(level.approx, level.vertical, wavelet, border, cols);
  const Matrix<T> high = join_rows<T>(level.horizontal, level.diagonal, wavelet, border, cols);
  return join_rows<T>(Matrix<T>(low.transpose()), Matrix<T>(high.transpose()), wavelet, border,
                      rows)
      .transpose();
}

template Dwt2<float> dwt2<float>(const MatrixF&, const Wavelet&, Border);
template Dwt2<double> dwt2<double>(const MatrixD&, const Wavelet&, Border);
template MatrixF idwt2<float>(const Dwt2<float>&, const Wavelet&, Border, Eigen::Index,
                              Eigen::Index);
template MatrixD idwt2<double>(const Dwt2<double>&, const Wavelet&, Border, Eigen::Index,
                               Eigen::Index);

}  // namespace hri
