// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stationary.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

template <class T>
using Row = Eigen::Map<Eigen::Array<T, Eigen::Dynamic, 1>>;
template <class T>
using ConstRow = Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>>;

void validate_levels(std::size_t num_samples, Eigen::Index num_levels) {
  const int most = max_swt_level(num_samples);
  if (num_levels >= 1 && num_levels <= most) return;
  fail(ErrorKind::invalid_argument, "num_levels is " + std::to_string(num_levels) +
                                        ", a signal of " + std::to_string(num_samples) +
                                        " samples has 1.." + std::to_string(most) +
                                        " (its length must be a multiple of 2^num_levels)");
}

// x repeated periodically, so that `lead` samples stand before it and `trail` behind.
template <class T>
void extend(const T* x, std::ptrdiff_t size, std::ptrdiff_t lead, std::ptrdiff_t trail,
            std::vector<T>* out) {
  out->resize(static_cast<std::size_t>(lead + size + trail));
  std::ptrdiff_t from = ((-lead) % size + size) % size;
  for (T& value : *out) {
    value = x[from];
    from = from + 1 == size ? 0 : from + 1;
  }
}

// y[n] (+)= sum over j of filter[j] x[n + first - j * step], x extended by `lead` samples.
template <class T>
void convolve(const std::vector<T>& extended, std::ptrdiff_t lead,
              const std::vector<double>& filter, std::ptrdiff_t first, std::ptrdiff_t step,
              Row<T> y) {
  for (std::size_t j = 0; j < filter.size(); ++j) {
    const std::ptrdiff_t at = lead + first - static_cast<std::ptrdiff_t>(j) * step;
    y += static_cast<T>(filter[j]) * ConstRow<T>(extended.data() + at, y.size());
  }
}

}  // namespace

int max_swt_level(std::size_t num_samples) {
  int level = 0;
  for (; num_samples != 0 && num_samples % 2 == 0; num_samples /= 2) ++level;
  return level;
}

template <class T>
void swt(Span<const T> x, const Wavelet& wavelet, Eigen::Ref<Matrix<T>> approximations,
         Eigen::Ref<Matrix<T>> details) {
  const auto size = static_cast<std::ptrdiff_t>(x.size());
  validate_levels(x.size(), approximations.rows());
  require(details.rows() == approximations.rows() && details.cols() == size &&
              approximations.cols() == size,
          "approximations and details must have shape (num_levels, num_samples)");
  const auto num_taps = static_cast<std::ptrdiff_t>(wavelet.dec_lo.size());
  std::vector<T> extended;
  const T* above = x.data();
  for (Eigen::Index level = 0; level < approximations.rows(); ++level) {
    const std::ptrdiff_t step = std::ptrdiff_t{1} << level;
    const std::ptrdiff_t first = num_taps / 2 * step;
    extend(above, size, first, first, &extended);
    for (const bool low : {true, false}) {
      Row<T> out((low ? approximations : details).row(level).data(), size);
      out.setZero();
      convolve(extended, first, low ? wavelet.dec_lo : wavelet.dec_hi, first, step, out);
    }
    above = approximations.row(level).data();
  }
}

template <class T>
void iswt(Span<const T> approximation, const Eigen::Ref<const Matrix<T>>& details,
          const Wavelet& wavelet, Span<T> x) {
  const auto size = static_cast<std::ptrdiff_t>(approximation.size());
  validate_levels(approximation.size(), details.rows());
  require(details.cols() == size && x.size() == approximation.size(),
          "the approximation, the details of every level and the signal must be as long");
  const auto num_taps = static_cast<std::ptrdiff_t>(wavelet.rec_lo.size());
  std::vector<T> below(approximation.begin(), approximation.end());
  std::vector<T> extended;
  Row<T> out(x.data(), size);
  for (Eigen::Index level = details.rows() - 1; level >= 0; --level) {
    const std::ptrdiff_t step = std::ptrdiff_t{1} << level;
    const std::ptrdiff_t first = (num_taps / 2 - 1) * step;
    const std::ptrdiff_t lead = num_taps * step - step - first;
    out.setZero();
    extend(below.data(), size, lead, first, &extended);
    convolve(extended, lead, wavelet.rec_lo, first, step, out);
    extend(details.row(level).data(), size, lead, first, &extended);
    convolve(extended, lead, wavelet.rec_hi, first, step, out);
    out *= T(0.5);
    below.assign(x.begin(), x.end());
  }
}

template void swt(Span<const float>, const Wavelet&, Eigen::Ref<MatrixF>, Eigen::Ref<MatrixF>);
template void swt(Span<const double>, const Wavelet&, Eigen::Ref<MatrixD>, Eigen::Ref<MatrixD>);
template void iswt(Span<const float>, const Eigen::Ref<const MatrixF>&, const Wavelet&,
                   Span<float>);
template void iswt(Span<const double>, const Eigen::Ref<const MatrixD>&, const Wavelet&,
                   Span<double>);

}  // namespace hri
