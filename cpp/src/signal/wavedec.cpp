// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/signal/dwt.hpp"
#include "signal/dwt_lines.hpp"

namespace hri {
namespace {

constexpr int kMaxLevels = 62;

// Approximations between two levels, one behind the other.
template <class T>
std::vector<T>& between_levels() {
  thread_local std::vector<T> values;
  return values;
}

}  // namespace

int max_dwt_level(std::size_t num_samples, std::size_t num_taps) {
  if (num_taps < 2) return 0;
  int level = 0;
  for (std::size_t reach = 2 * (num_taps - 1); reach <= num_samples; reach *= 2) ++level;
  return level;
}

std::vector<std::size_t> wavedec_lengths(std::size_t num_samples, std::size_t num_taps,
                                         Border border, int num_levels) {
  require(num_levels >= 1 && num_levels <= kMaxLevels, "num_levels must lie in 1..62");
  std::vector<std::size_t> lengths(static_cast<std::size_t>(num_levels) + 1);
  for (std::size_t band = lengths.size() - 1; band > 0; --band)
    lengths[band] = num_samples = dwt_length(num_samples, num_taps, border);
  lengths[0] = num_samples;
  return lengths;
}

template <class T>
void wavedec(Span<const T> x, const Wavelet& wavelet, Border border, Span<const Span<T>> bands) {
  const auto filters = detail::analysis_filters<T>(wavelet);
  const std::size_t taps = wavelet.dec_lo.size();
  require(!x.empty(), "signal must not be empty");
  require(bands.size() >= 2 && bands.size() <= kMaxLevels + 1, "num_levels must lie in 1..62");
  std::size_t length = x.size();
  std::size_t sum = 0;
  for (std::size_t band = bands.size() - 1; band > 0; --band) {
    length = dwt_length(length, taps, border);
    require(bands[band].size() == length, "bands must have wavedec_lengths() values");
    sum += length;
  }
  require(bands[0].size() == length, "bands must have wavedec_lengths() values");
  constexpr std::ptrdiff_t kLine = 64 / sizeof(T);
  sum += bands.size() * static_cast<std::size_t>(kLine);
  std::vector<T>& between = between_levels<T>();
  if (between.size() < sum) between.resize(sum);
  T* next = between.data();
  for (std::size_t band = bands.size() - 1; band > 0; --band) {
    const std::size_t count = bands[band].size();
    // As far from a cache line as the details, which are written beside.
    next +=
        (kLine + detail::to_cache_line(next) - detail::to_cache_line(bands[band].data())) % kLine;
    T* approx = band == 1 ? bands[0].data() : next;
    detail::analyse_line(x.data(), static_cast<std::ptrdiff_t>(x.size()), filters, border,
                         static_cast<std::ptrdiff_t>(count), approx, bands[band].data());
    x = Span<const T>(approx, count);
    next += count;
  }
}

template <class T>
void waverec(Span<const Span<const T>> bands, const Wavelet& wavelet, Border border, Span<T> x) {
  const auto filters = detail::synthesis_filters<T>(wavelet);
  const std::size_t taps = wavelet.rec_lo.size();
  require(bands.size() >= 2, "a decomposition needs an approximation and at least one detail");
  require(!bands[0].empty(), "approximation must not be empty");
  std::size_t length = bands[0].size();
  std::size_t sum = 0;
  for (std::size_t band = 1; band < bands.size(); ++band) {
    const std::size_t count = bands[band].size();
    // One coefficient too many where the signal above had odd length.
    require(count > 0 && (length == count || length == count + 1),
            "coefficients of one level do not fit the next");
    length = idwt_length(count, taps, border);
    require(length > 0, "too few coefficients for the wavelet");
    sum += length;
  }
  require(x.size() <= length, "x does not fit the number of coefficients");
  std::vector<T>& between = between_levels<T>();
  if (between.size() < sum) between.resize(sum);
  T* next = between.data();
  const T* approx = bands[0].data();
  for (std::size_t band = 1; band < bands.size(); ++band) {
    const std::size_t count = bands[band].size();
    const bool last = band + 1 == bands.size();
    T* out = last ? x.data() : next;
    const std::size_t size = last ? x.size() : bands[band + 1].size();
    if (size == 0) return;
    detail::synthesise_line(approx, bands[band].data(), static_cast<std::ptrdiff_t>(count), filters,
                            border, static_cast<std::ptrdiff_t>(size), out);
    approx = out;
    next += size;
  }
}

template <class T>
WaveletDecomposition<T> wavedec(Span<const T> x, const Wavelet& wavelet, Border border,
                                int num_levels) {
  WaveletDecomposition<T> result;
  result.num_samples = x.size();
  std::vector<Span<T>> bands;
  for (const std::size_t length :
       wavedec_lengths(x.size(), wavelet.dec_lo.size(), border, num_levels)) {
    result.coefficients.emplace_back(length);
    bands.emplace_back(result.coefficients.back());
  }
  wavedec<T>(x, wavelet, border, Span<const Span<T>>(bands));
  return result;
}

template <class T>
std::vector<T> waverec(const WaveletDecomposition<T>& decomposition, const Wavelet& wavelet,
                       Border border) {
  std::vector<Span<const T>> bands;
  bands.reserve(decomposition.coefficients.size());
  for (const std::vector<T>& band : decomposition.coefficients) bands.emplace_back(band);
  const std::size_t full =
      bands.empty() ? 0 : idwt_length(bands.back().size(), wavelet.rec_lo.size(), border);
  std::vector<T> x(std::min(full, decomposition.num_samples));
  waverec<T>(Span<const Span<const T>>(bands), wavelet, border, Span<T>(x));
  return x;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define HRI_INSTANTIATE_WAVEDEC(T)                                                         \
  template void wavedec<T>(Span<const T>, const Wavelet&, Border, Span<const Span<T>>);    \
  template void waverec<T>(Span<const Span<const T>>, const Wavelet&, Border, Span<T>);    \
  template WaveletDecomposition<T> wavedec<T>(Span<const T>, const Wavelet&, Border, int); \
  template std::vector<T> waverec<T>(const WaveletDecomposition<T>&, const Wavelet&, Border);
// NOLINTEND(bugprone-macro-parentheses)
HRI_INSTANTIATE_WAVEDEC(float)
HRI_INSTANTIATE_WAVEDEC(double)
#undef HRI_INSTANTIATE_WAVEDEC

}  // namespace hri
