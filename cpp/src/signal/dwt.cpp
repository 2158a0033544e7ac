// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/dwt.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "signal/border_extension.hpp"
#include "signal/dwt_lines.hpp"

namespace hri {
namespace detail {
namespace {

constexpr std::ptrdiff_t kBlock = 1024;  // outputs at a time: what lies between stays in the cache
constexpr std::ptrdiff_t kMaxHalf = kMaxTaps / 2;
constexpr std::ptrdiff_t kWide = 16;  // as many outputs as the widest register takes

// Samples dealt into even and odd ones, each of them shifted against itself.
template <class T>
class Dealt {
 public:
  explicit Dealt(const FilterPair<T>& filters) : filters_(filters) {
    for (std::ptrdiff_t i = 0; i < filters.num_taps / 2; ++i) {
      rows_[2 * i] = even_ + i;
      rows_[2 * i + 1] = odd_ + i;
    }
  }
  // `count` <= kBlock outputs from the samples that they read.
  void analyse(const T* samples, std::ptrdiff_t count, T* approx, T* detail) {
    loops_.split(samples, count + filters_.num_taps / 2 - 1, even_, odd_);
    loops_.weigh(rows_, filters_.low.data(), filters_.high.data(),
                 static_cast<int>(filters_.num_taps), count, approx, detail);
  }

 private:
  const PairLoops<T>& loops_ = pair_loops<T>();
  const FilterPair<T>& filters_;
  alignas(64) T even_[kBlock + kMaxHalf];  // a cache line's bounds
  alignas(64) T odd_[kBlock + kMaxHalf];
  const T* rows_[kMaxTaps];
};

}  // namespace

template <class T>
void analyse_extended(const T* samples, const FilterPair<T>& filters, std::ptrdiff_t count,
                      T* approx, T* detail) {
  Dealt<T> dealt(filters);
  for (std::ptrdiff_t k = 0; k < count; k += kBlock)
    dealt.analyse(samples + 2 * k, std::min(kBlock, count - k), approx + k, detail + k);
}

template <class T>
void analyse_line(const T* x, std::ptrdiff_t n, const FilterPair<T>& filters, Border border,
                  std::ptrdiff_t count, T* approx, T* detail) {
  Dealt<T> dealt(filters);
  const std::ptrdiff_t first = first_read(filters.num_taps, border);
  const auto some = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    T extended[2 * (kMaxHalf + kWide) + kMaxTaps];
    for (std::ptrdiff_t k = begin; k < end;) {
      std::ptrdiff_t now = std::min(kBlock, end - k);
      const T* samples = x + 2 * k + first;
      if (2 * k + first < 0 || 2 * (k + now - 1) + first + filters.num_taps > n) {
        now = std::min(now, kMaxHalf + kWide);
        extend(x, n, border, 2 * k + first, 2 * now + filters.num_taps - 2, extended);
        samples = extended;
      }
      dealt.analyse(samples, now, approx + k, detail + k);
      k += now;
    }
  };
  // Whole registers at the edges, and between them outputs that read samples only, from where
  // registers of details do not lie across two cache lines.
  const std::ptrdiff_t needed = (-first / 2 + kWide) / kWide * kWide;
  const std::ptrdiff_t left = std::min(count, needed + to_cache_line(detail + needed));
  const std::ptrdiff_t inside = (n - first - filters.num_taps) / 2 + 1 - left;
  const std::ptrdiff_t right = left + std::max<std::ptrdiff_t>(inside, 0) / kWide * kWide;
  some(0, left);
  some(left, right);
  some(right, count);
}

template <class T>
void synthesise_line(const T* approx, const T* detail, std::ptrdiff_t count,
                     const FilterPair<T>& filters, Border border, std::ptrdiff_t size, T* x) {
  const PairLoops<T>& loops = pair_loops<T>();
  const std::ptrdiff_t half = filters.num_taps / 2;
  const PairPlaces places = pair_places(filters.num_taps, border);
  const std::ptrdiff_t num_pairs = (size + places.late + 1) / 2;
  T even[kBlock];
  T odd[kBlock];
  const T* rows[kMaxTaps];
  for (std::ptrdiff_t p = 0; p < num_pairs;) {
    const std::ptrdiff_t begin = p + places.offset;  // the first coefficient read
    std::ptrdiff_t now = std::min({kBlock, num_pairs - p, count - half + 1 - begin});
    T around[2][2 * kMaxHalf];
    const T* bands[2] = {approx + begin, detail + begin};
    if (begin < 0 || now <= 0) {
      // Coefficients on both sides of an end, which only periodization asks for.
      now = std::min(kMaxHalf, num_pairs - p);
      if (begin < 0) now = std::min(now, -begin);
      extend(approx, count, Border::periodic, begin, now + half - 1, around[0]);
      extend(detail, count, Border::periodic, begin, now + half - 1, around[1]);
      bands[0] = around[0];
      bands[1] = around[1];
    }
    for (std::ptrdiff_t u = 0; u < half; ++u) {
      rows[2 * u] = bands[0] + u;
      rows[2 * u + 1] = bands[1] + u;
    }
    loops.weigh(rows, filters.low.data(), filters.high.data(), static_cast<int>(filters.num_taps),
                now, even, odd);
    std::ptrdiff_t i = 0;
    std::ptrdiff_t whole = now;  // pairs of which both samples are wanted
    if (2 * p - places.late < 0) {
      x[0] = odd[0];
      i = 1;
    }
    if (2 * (p + now) - places.late > size) {
      --whole;
      if (whole >= i) x[size - 1] = even[whole];
    }
    if (whole > i) loops.join(even + i, odd + i, whole - i, x + 2 * (p + i) - places.late);
    p += now;
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define HRI_INSTANTIATE_LINES(T)                                                             \
  template void analyse_line<T>(const T*, std::ptrdiff_t, const FilterPair<T>&, Border,      \
                                std::ptrdiff_t, T*, T*);                                     \
  template void analyse_extended<T>(const T*, const FilterPair<T>&, std::ptrdiff_t, T*, T*); \
  template void synthesise_line<T>(const T*, const T*, std::ptrdiff_t, const FilterPair<T>&, \
                                   Border, std::ptrdiff_t, T*);
// NOLINTEND(bugprone-macro-parentheses)
HRI_INSTANTIATE_LINES(float)
HRI_INSTANTIATE_LINES(double)
#undef HRI_INSTANTIATE_LINES

}  // namespace detail

std::size_t dwt_length(std::size_t num_samples, std::size_t num_taps, Border border) {
  if (border == Border::periodization) return (num_samples + 1) / 2;
  return (num_samples + num_taps - 1) / 2;
}

std::size_t idwt_length(std::size_t num_coefficients, std::size_t num_taps, Border border) {
  const std::size_t twice = 2 * num_coefficients;
  if (border == Border::periodization) return twice;
  return twice + 2 > num_taps ? twice + 2 - num_taps : 0;
}

template <class T>
void dwt(Span<const T> x, const Wavelet& wavelet, Border border, Span<T> approx, Span<T> detail) {
  const auto filters = detail::analysis_filters<T>(wavelet);
  const std::size_t count = dwt_length(x.size(), wavelet.dec_lo.size(), border);
  require(!x.empty(), "signal must not be empty");
  require(approx.size() == count && detail.size() == count,
          "approx and detail must have dwt_length() values");
  detail::analyse_line(x.data(), static_cast<std::ptrdiff_t>(x.size()), filters, border,
                       static_cast<std::ptrdiff_t>(count), approx.data(), detail.data());
}

template <class T>
void idwt(Span<const T> approx, Span<const T> detail, const Wavelet& wavelet, Border border,
          Span<T> x) {
  const auto filters = detail::synthesis_filters<T>(wavelet);
  require(!approx.empty() && detail.size() == approx.size(),
          "approx and detail must have the same size, at least 1");
  const std::size_t full = idwt_length(approx.size(), wavelet.rec_lo.size(), border);
  require(full > 0 && (x.size() == full || x.size() + 1 == full),
          "x does not fit the number of coefficients");
  detail::synthesise_line(approx.data(), detail.data(), static_cast<std::ptrdiff_t>(approx.size()),
                          filters, border, static_cast<std::ptrdiff_t>(x.size()), x.data());
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define HRI_INSTANTIATE_DWT(T)                                                   \
  template void dwt<T>(Span<const T>, const Wavelet&, Border, Span<T>, Span<T>); \
  template void idwt<T>(Span<const T>, Span<const T>, const Wavelet&, Border, Span<T>);
// NOLINTEND(bugprone-macro-parentheses)
HRI_INSTANTIATE_DWT(float)
HRI_INSTANTIATE_DWT(double)
#undef HRI_INSTANTIATE_DWT

}  // namespace hri
