// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Both directions in one sweep: a line of coefficients across the columns is filtered along its own
// direction while it is still in the cache.
#include "hri/signal/dwt2.hpp"

#include <algorithm>
#include <array>

#include "hri/core/error.hpp"
#include "signal/border_extension.hpp"
#include "signal/dwt_lines.hpp"

namespace hri {
namespace {

using detail::ExtendedSample;
using detail::FilterPair;

// Kept from picture to picture.
template <class T>
struct Scratch {
  std::vector<const T*> rows;
  std::vector<T> lines;
};
template <class T>
Scratch<T>& scratch(std::ptrdiff_t num_rows, std::ptrdiff_t num_values) {
  thread_local Scratch<T> kept;
  if (static_cast<std::ptrdiff_t>(kept.rows.size()) < num_rows)
    kept.rows.resize(static_cast<std::size_t>(num_rows));
  if (static_cast<std::ptrdiff_t>(kept.lines.size()) < num_values)
    kept.lines.resize(static_cast<std::size_t>(num_values));
  return kept;
}

// How many positions beyond each end of n samples `count` outputs read.
struct Margins {
  std::ptrdiff_t before;
  std::ptrdiff_t after;

  Margins(std::ptrdiff_t n, std::ptrdiff_t num_taps, Border border, std::ptrdiff_t count)
      : before(-detail::first_read(num_taps, border)),
        after(std::max<std::ptrdiff_t>(2 * (count - 1) - before + num_taps - n, 0)) {}
  [[nodiscard]] std::ptrdiff_t size() const { return before + after; }
};

template <class T>
T value_of(const ExtendedSample& s, const T* x, std::ptrdiff_t stride) {
  double sum = 0;
  for (int j = 0; j < 3; ++j)
    if (s.weight[j] != 0) sum += s.weight[j] * static_cast<double>(x[s.from[j] * stride]);
  return static_cast<T>(sum);
}

// All rows that the outputs read; those that are no row of the picture are made.
template <class T>
void extend_rows(const Eigen::Ref<const Matrix<T>>& image, Border border, const Margins& margins,
                 T* made, const T** rows) {
  const std::ptrdiff_t stride = image.outerStride();
  for (std::ptrdiff_t at = -margins.before; at < image.rows() + margins.after; ++at) {
    const ExtendedSample s = detail::extended_sample(at, image.rows(), border);
    if (s.weight[0] == 1 && s.weight[1] == 0 && s.weight[2] == 0) {
      *rows++ = image.data() + s.from[0] * stride;
      continue;
    }
    for (Eigen::Index c = 0; c < image.cols(); ++c) made[c] = value_of(s, image.data() + c, stride);
    *rows++ = made;
    made += image.cols();
  }
}

// A line with room for its margins, which finish() fills before it filters the line.
template <class T>
class Line {
 public:
  Line(std::ptrdiff_t n, Border border, const Margins& margins) : n_(n), margins_(margins) {
    for (std::ptrdiff_t i = 0; i < margins_.size(); ++i)
      beyond_[static_cast<std::size_t>(i)] = detail::extended_sample(place(i), n, border);
  }
  void finish(T* line, const FilterPair<T>& filters, std::ptrdiff_t count, T* approx,
              T* detail) const {
    T* inside = line + margins_.before;
    for (std::ptrdiff_t i = 0; i < margins_.size(); ++i)
      inside[place(i)] = value_of(beyond_[static_cast<std::size_t>(i)], inside, 1);
    detail::analyse_extended(line, filters, count, approx, detail);
  }

 private:
  [[nodiscard]] std::ptrdiff_t place(std::ptrdiff_t i) const {
    return i < margins_.before ? i - margins_.before : n_ + i - margins_.before;
  }

  std::ptrdiff_t n_;
  Margins margins_;
  std::array<ExtendedSample, 2 * detail::kMaxTaps> beyond_;
};

template <class T>
bool has_shape(const T& matrix, Dwt2Shape shape) {
  return matrix.rows() == shape.rows && matrix.cols() == shape.cols;
}

}  // namespace

Dwt2Shape dwt2_shape(Eigen::Index rows, Eigen::Index cols, std::size_t num_taps, Border border) {
  const auto length = [&](Eigen::Index n) {
    return static_cast<Eigen::Index>(dwt_length(static_cast<std::size_t>(n), num_taps, border));
  };
  return {length(rows), length(cols)};
}

template <class T>
void dwt2(const Eigen::Ref<const Matrix<T>>& image, const Wavelet& wavelet, Border border,
          Dwt2Bands<T> bands) {
  const FilterPair<T> filters = detail::analysis_filters<T>(wavelet);
  require(image.rows() > 0 && image.cols() > 0, "image must have at least one pixel");
  const Dwt2Shape shape = dwt2_shape(image.rows(), image.cols(), wavelet.dec_lo.size(), border);
  require(has_shape(bands.approx, shape) && has_shape(bands.horizontal, shape) &&
              has_shape(bands.vertical, shape) && has_shape(bands.diagonal, shape),
          "bands must have dwt2_shape()");
  const std::ptrdiff_t taps = filters.num_taps;
  const Margins across(image.rows(), taps, border, shape.rows);
  const Margins along(image.cols(), taps, border, shape.cols);
  const Line<T> line(image.cols(), border, along);
  const std::ptrdiff_t width = image.cols() + along.size();
  Scratch<T>& kept =
      scratch<T>(image.rows() + across.size(), 2 * width + across.size() * image.cols());
  T* low = kept.lines.data();
  T* high = low + width;
  const T** rows = kept.rows.data();
  extend_rows<T>(image, border, across, high + width, rows);
  for (Eigen::Index k = 0; k < shape.rows; ++k) {
    detail::pair_loops<T>().weigh(rows + 2 * k, filters.low.data(), filters.high.data(),
                                  static_cast<int>(taps), image.cols(), low + along.before,
                                  high + along.before);
    line.finish(low, filters, shape.cols, &bands.approx(k, 0), &bands.vertical(k, 0));
    line.finish(high, filters, shape.cols, &bands.horizontal(k, 0), &bands.diagonal(k, 0));
  }
}

template <class T>
Dwt2<T> dwt2(const Eigen::Ref<const Matrix<T>>& image, const Wavelet& wavelet, Border border) {
  const Dwt2Shape shape = dwt2_shape(image.rows(), image.cols(), wavelet.dec_lo.size(), border);
  const Matrix<T> band(shape.rows, shape.cols);
  Dwt2<T> level{band, band, band, band};
  dwt2<T>(image, wavelet, border,
          Dwt2Bands<T>{level.approx, level.horizontal, level.vertical, level.diagonal});
  return level;
}

template <class T>
Matrix<T> idwt2(const Dwt2<T>& level, const Wavelet& wavelet, Border border, Eigen::Index rows,
                Eigen::Index cols) {
  const FilterPair<T> filters = detail::synthesis_filters<T>(wavelet);
  const Dwt2Shape shape{level.approx.rows(), level.approx.cols()};
  require(has_shape(level.horizontal, shape) && has_shape(level.vertical, shape) &&
              has_shape(level.diagonal, shape),
          "approximation and details must have one shape");
  require(rows > 0 && cols > 0, "image must have at least one pixel");
  const Dwt2Shape expected = dwt2_shape(rows, cols, wavelet.dec_lo.size(), border);
  require(shape.rows == expected.rows && shape.cols == expected.cols,
          "coefficients are not those of an image of this shape");
  Matrix<T> image(rows, cols);
  const std::ptrdiff_t half = filters.num_taps / 2;
  const detail::PairPlaces places = detail::pair_places(filters.num_taps, border);
  // A ring of lines filtered along the rows, low and high in turn, and a line that is not used.
  Scratch<T>& kept = scratch<T>(2 * half, (2 * half + 1) * cols);
  T* lines = kept.lines.data();
  T* unwanted = lines + 2 * half * cols;
  const T** read = kept.rows.data();
  const auto make = [&](std::ptrdiff_t q) {
    const std::ptrdiff_t k = detail::modulo(q, shape.rows);
    T* low = lines + 2 * detail::modulo(q, half) * cols;
    detail::synthesise_line(&level.approx(k, 0), &level.vertical(k, 0), shape.cols, filters, border,
                            cols, low);
    detail::synthesise_line(&level.horizontal(k, 0), &level.diagonal(k, 0), shape.cols, filters,
                            border, cols, low + cols);
  };
  for (std::ptrdiff_t u = 0; u + 1 < half; ++u) make(places.offset + u);
  for (std::ptrdiff_t p = 0; 2 * p - places.late < rows; ++p) {
    make(p + places.offset + half - 1);
    for (std::ptrdiff_t u = 0; u < half; ++u) {
      read[2 * u] = lines + 2 * detail::modulo(p + places.offset + u, half) * cols;
      read[2 * u + 1] = read[2 * u] + cols;
    }
    const std::ptrdiff_t even = 2 * p - places.late;
    detail::pair_loops<T>().weigh(
        read, filters.low.data(), filters.high.data(), static_cast<int>(filters.num_taps), cols,
        even < 0 ? unwanted : &image(even, 0), even + 1 < rows ? &image(even + 1, 0) : unwanted);
  }
  return image;
}

template <class T>
WaveletDecomposition2<T> wavedec2(const Eigen::Ref<const Matrix<T>>& image, const Wavelet& wavelet,
                                  Border border, int num_levels) {
  require(num_levels >= 1 && num_levels <= 62, "num_levels must lie in 1..62");
  WaveletDecomposition2<T> result;
  result.rows = image.rows();
  result.cols = image.cols();
  for (int level = 0; level < num_levels; ++level) {
    result.details.push_back(level == 0 ? dwt2<T>(image, wavelet, border)
                                        : dwt2<T>(result.approx, wavelet, border));
    result.approx.swap(result.details.back().approx);
    result.details.back().approx.resize(0, 0);
  }
  std::reverse(result.details.begin(), result.details.end());
  return result;
}

template <class T>
Matrix<T> waverec2(const WaveletDecomposition2<T>& decomposition, const Wavelet& wavelet,
                   Border border) {
  const auto& details = decomposition.details;
  require(!details.empty(), "a decomposition needs an approximation and at least one detail");
  Matrix<T> approx = decomposition.approx;
  for (std::size_t i = 0; i < details.size(); ++i) {
    const bool last = i + 1 == details.size();
    const Eigen::Index rows = last ? decomposition.rows : details[i + 1].horizontal.rows();
    const Eigen::Index cols = last ? decomposition.cols : details[i + 1].horizontal.cols();
    approx = idwt2<T>({approx, details[i].horizontal, details[i].vertical, details[i].diagonal},
                      wavelet, border, rows, cols);
  }
  return approx;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define HRI_INSTANTIATE_DWT2(T)                                                                    \
  template void dwt2<T>(const Eigen::Ref<const Matrix<T>>&, const Wavelet&, Border, Dwt2Bands<T>); \
  template Dwt2<T> dwt2<T>(const Eigen::Ref<const Matrix<T>>&, const Wavelet&, Border);            \
  template Matrix<T> idwt2<T>(const Dwt2<T>&, const Wavelet&, Border, Eigen::Index, Eigen::Index); \
  template WaveletDecomposition2<T> wavedec2<T>(const Eigen::Ref<const Matrix<T>>&,                \
                                                const Wavelet&, Border, int);                      \
  template Matrix<T> waverec2<T>(const WaveletDecomposition2<T>&, const Wavelet&, Border);
// NOLINTEND(bugprone-macro-parentheses)
HRI_INSTANTIATE_DWT2(float)
HRI_INSTANTIATE_DWT2(double)
#undef HRI_INSTANTIATE_DWT2

}  // namespace hri
