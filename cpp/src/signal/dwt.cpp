// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/dwt.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/core/simd.hpp"

namespace hri {
namespace {

// Index of the sample that stands at position i of the extended signal, or -1 for a zero.
std::ptrdiff_t extended_index(std::ptrdiff_t i, std::ptrdiff_t n, Border border) {
  if (i >= 0 && i < n) return i;
  switch (border) {
    case Border::zero:
      return -1;
    case Border::constant:
      return i < 0 ? 0 : n - 1;
    case Border::symmetric: {
      const std::ptrdiff_t m = ((i % (2 * n)) + 2 * n) % (2 * n);
      return m < n ? m : 2 * n - 1 - m;
    }
    case Border::reflect: {
      if (n == 1) return 0;
      const std::ptrdiff_t period = 2 * n - 2;
      const std::ptrdiff_t m = ((i % period) + period) % period;
      return m < n ? m : period - m;
    }
    case Border::periodic:
      return ((i % n) + n) % n;
    case Border::periodization: {
      // A signal of odd length repeats its last sample once to become even.
      const std::ptrdiff_t period = n + n % 2;
      return std::min(((i % period) + period) % period, n - 1);
    }
  }
  return -1;
}

// out[k] = sum_j taps[j] x[2 k + offset - j] for both filters at once.
template <class T>
inline void convolve_pairs(const T* x, const T* low, const T* high, std::size_t num_taps,
                           std::size_t count, T* approx, T* detail) {
  // Eight outputs side by side: the inner loops run over outputs, which vectorises for every filter
  // length.
  constexpr std::size_t kBlock = 8;
  std::size_t k = 0;
  for (; k + kBlock <= count; k += kBlock) {
    T a[kBlock] = {};
    T d[kBlock] = {};
    for (std::size_t j = 0; j < num_taps; ++j) {
      const T* from = x + 2 * k + (num_taps - 1 - j);
      for (std::size_t b = 0; b < kBlock; ++b) {
        a[b] += low[j] * from[2 * b];
        d[b] += high[j] * from[2 * b];
      }
    }
    std::copy(a, a + kBlock, approx + k);
    std::copy(d, d + kBlock, detail + k);
  }
  for (; k < count; ++k) {
    T a = 0;
    T d = 0;
    for (std::size_t j = 0; j < num_taps; ++j) {
      const T v = x[2 * k + (num_taps - 1 - j)];
      a += low[j] * v;
      d += high[j] * v;
    }
    approx[k] = a;
    detail[k] = d;
  }
}

HRI_SIMD_CLONES
void convolve_float(const float* x, const float* low, const float* high, std::size_t num_taps,
                    std::size_t count, float* approx, float* detail) {
  convolve_pairs(x, low, high, num_taps, count, approx, detail);
}

HRI_SIMD_CLONES
void convolve_double(const double* x, const double* low, const double* high, std::size_t num_taps,
                     std::size_t count, double* approx, double* detail) {
  convolve_pairs(x, low, high, num_taps, count, approx, detail);
}

void convolve(const float* x, const float* low, const float* high, std::size_t num_taps,
              std::size_t count, float* approx, float* detail) {
  convolve_float(x, low, high, num_taps, count, approx, detail);
}
void convolve(const double* x, const double* low, const double* high, std::size_t num_taps,
              std::size_t count, double* approx, double* detail) {
  convolve_double(x, low, high, num_taps, count, approx, detail);
}

template <class T>
std::vector<T> converted(const std::vector<double>& taps) {
  return {taps.begin(), taps.end()};
}

}  // namespace

std::size_t dwt_length(std::size_t num_samples, std::size_t num_taps, Border border) {
  if (border == Border::periodization) return (num_samples + 1) / 2;
  return (num_samples + num_taps - 1) / 2;
}

template <class T>
void dwt(Span<const T> x, const Wavelet& wavelet, Border border, Span<T> approx, Span<T> detail) {
  const std::size_t taps = wavelet.dec_lo.size();
  const std::size_t count = dwt_length(x.size(), taps, border);
  require(!x.empty(), "signal must not be empty");
  require(approx.size() == count && detail.size() == count,
          "approx and detail must have dwt_length() values");
  // Output k reads positions 2 k + shift - (taps - 1) .. 2 k + shift of the signal.
  const std::ptrdiff_t shift =
      border == Border::periodization ? static_cast<std::ptrdiff_t>(taps / 2) : 1;
  const std::ptrdiff_t first = shift - static_cast<std::ptrdiff_t>(taps) + 1;
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  thread_local std::vector<T> extended;
  extended.resize(2 * count + taps);
  for (std::size_t i = 0; i < extended.size(); ++i) {
    const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(i);
    if (at >= 0 && at < n) {
      const auto run = static_cast<std::size_t>(
          std::min<std::ptrdiff_t>(n - at, static_cast<std::ptrdiff_t>(extended.size() - i)));
      std::copy(x.data() + at, x.data() + at + run, extended.data() + i);
      i += run - 1;
      continue;
    }
    const std::ptrdiff_t from = extended_index(at, n, border);
    extended[i] = from < 0 ? T(0) : x[static_cast<std::size_t>(from)];
  }
  const std::vector<T> low = converted<T>(wavelet.dec_lo);
  const std::vector<T> high = converted<T>(wavelet.dec_hi);
  convolve(extended.data(), low.data(), high.data(), taps, count, approx.data(), detail.data());
}

template <class T>
void idwt(Span<const T> approx, Span<const T> detail, const Wavelet& wavelet, Border border,
          Span<T> x) {
  const auto taps = static_cast<std::ptrdiff_t>(wavelet.rec_lo.size());
  const auto count = static_cast<std::ptrdiff_t>(approx.size());
  require(count > 0 && detail.size() == approx.size(),
          "approx and detail must have the same size, at least 1");
  const bool wrap = border == Border::periodization;
  const std::ptrdiff_t full = wrap ? 2 * count : 2 * count - taps + 2;
  const auto size = static_cast<std::ptrdiff_t>(x.size());
  require(full > 0 && (size == full || size == full - 1),
          "x does not fit the number of coefficients");
  const std::ptrdiff_t shift = wrap ? taps / 2 - 1 : taps - 2;
  std::fill(x.begin(), x.end(), T(0));
  // x[i] collects rec[j] c[k] where 2 k + j - shift = i, around the end for periodization.
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    for (std::ptrdiff_t j = 0; j < taps; ++j) {
      std::ptrdiff_t i = 2 * k + j - shift;
      if (wrap) i = ((i % full) + full) % full;
      if (i < 0 || i >= size) continue;
      x[static_cast<std::size_t>(i)] +=
          static_cast<T>(wavelet.rec_lo[static_cast<std::size_t>(j)]) *
              approx[static_cast<std::size_t>(k)] +
          static_cast<T>(wavelet.rec_hi[static_cast<std::size_t>(j)]) *
              detail[static_cast<std::size_t>(k)];
    }
  }
}

template <class T>
WaveletDecomposition<T> wavedec(Span<const T> x, const Wavelet& wavelet, Border border,
                                int num_levels) {
  require(num_levels >= 1 && num_levels <= 62, "num_levels must lie in 1..62");
  WaveletDecomposition<T> result;
  result.num_samples = x.size();
  std::vector<T> approx(x.begin(), x.end());
  for (int level = 0; level < num_levels; ++level) {
    const std::size_t count = dwt_length(approx.size(), wavelet.dec_lo.size(), border);
    std::vector<T> next(count);
    std::vector<T> detail(count);
    dwt<T>(Span<const T>(approx), wavelet, border, Span<T>(next), Span<T>(detail));
    result.coefficients.insert(result.coefficients.begin(), std::move(detail));
    approx = std::move(next);
  }
  result.coefficients.insert(result.coefficients.begin(), std::move(approx));
  return result;
}

template <class T>
std::vector<T> waverec(const WaveletDecomposition<T>& decomposition, const Wavelet& wavelet,
                       Border border) {
  const auto& c = decomposition.coefficients;
  require(c.size() >= 2, "a decomposition needs an approximation and at least one detail");
  std::vector<T> approx = c.front();
  const std::size_t taps = wavelet.rec_lo.size();
  for (std::size_t level = 1; level < c.size(); ++level) {
    const std::vector<T>& detail = c[level];
    require(approx.size() == detail.size() || approx.size() == detail.size() + 1,
            "coefficients of one level do not fit the next");
    approx.resize(detail.size());  // one coefficient too many where the signal above had odd length
    const std::size_t twice = 2 * detail.size();
    require(border == Border::periodization ? twice > 0 : twice + 2 > taps,
            "too few coefficients for the wavelet");
    const std::size_t full = border == Border::periodization ? twice : twice + 2 - taps;
    std::vector<T> above(full);
    idwt<T>(Span<const T>(approx), Span<const T>(detail), wavelet, border, Span<T>(above));
    approx = std::move(above);
  }
  approx.resize(std::min(approx.size(), decomposition.num_samples));
  return approx;
}

#define HRI_INSTANTIATE_DWT(T)                                                             \
  template void dwt<T>(Span<const T>, const Wavelet&, Border, Span<T>, Span<T>);           \
  template void idwt<T>(Span<const T>, Span<const T>, const Wavelet&, Border, Span<T>);    \
  template WaveletDecomposition<T> wavedec<T>(Span<const T>, const Wavelet&, Border, int); \
  template std::vector<T> waverec<T>(const WaveletDecomposition<T>&, const Wavelet&, Border);
HRI_INSTANTIATE_DWT(float)
HRI_INSTANTIATE_DWT(double)
#undef HRI_INSTANTIATE_DWT

}  // namespace hri
