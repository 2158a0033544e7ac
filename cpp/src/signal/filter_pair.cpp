// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/filter_pair.hpp"

#include "hri/core/error.hpp"

// A fused multiply-add rounds once where others round twice, and compilers fuse unless told.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

namespace hri::detail {
namespace {

namespace baseline {
constexpr int kBytes = 16;
constexpr int kGroup = 4;
#include "signal/filter_pair_kernel.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
constexpr int kBytes = 32;
constexpr int kGroup = 4;
#include "signal/filter_pair_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
constexpr int kBytes = 64;
constexpr int kGroup = 8;
#include "signal/filter_pair_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

void require_filters(const Wavelet& w) {
  const std::size_t size = w.dec_lo.size();
  require(size >= 2 && size <= kMaxTaps && size % 2 == 0 && w.dec_hi.size() == size &&
              w.rec_lo.size() == size && w.rec_hi.size() == size,
          "the four filters of a wavelet must have one even length, 2..128");
}

}  // namespace

// A table and no vector: streams ask in the middle of a signal, where nothing may be allocated.
template <class T>
Span<const NamedPairLoops<T>> all_pair_loops() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  static constexpr NamedPairLoops<T> kAll[] = {
      {"baseline", baseline::kLoops<T>}, {"avx2", avx2::kLoops<T>}, {"avx512", avx512::kLoops<T>}};
  const bool avx2 = __builtin_cpu_supports("avx2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq");
  return {kAll, avx512 ? 3U : avx2 ? 2U : 1U};
#else
  static constexpr NamedPairLoops<T> kAll[] = {{"baseline", baseline::kLoops<T>}};
  return {kAll, 1};
#endif
}

template <class T>
const PairLoops<T>& pair_loops() {
  static const Span<const NamedPairLoops<T>> all = all_pair_loops<T>();
  return all[all.size() - 1].loops;
}

template <class T>
FilterPair<T> analysis_filters(const Wavelet& wavelet) {
  require_filters(wavelet);
  FilterPair<T> pair;
  const std::size_t size = wavelet.dec_lo.size();
  pair.num_taps = static_cast<std::ptrdiff_t>(size);
  for (std::size_t i = 0; i < size; ++i) {
    pair.low[i] = static_cast<T>(wavelet.dec_lo[size - 1 - i]);
    pair.high[i] = static_cast<T>(wavelet.dec_hi[size - 1 - i]);
  }
  return pair;
}

template <class T>
FilterPair<T> synthesis_filters(const Wavelet& wavelet) {
  require_filters(wavelet);
  FilterPair<T> pair;
  const std::size_t size = wavelet.rec_lo.size();
  pair.num_taps = static_cast<std::ptrdiff_t>(size);
  for (std::size_t i = 0; i < size; i += 2) {
    const std::size_t tap = size - 2 - i;
    pair.low[i] = static_cast<T>(wavelet.rec_lo[tap]);
    pair.low[i + 1] = static_cast<T>(wavelet.rec_hi[tap]);
    pair.high[i] = static_cast<T>(wavelet.rec_lo[tap + 1]);
    pair.high[i + 1] = static_cast<T>(wavelet.rec_hi[tap + 1]);
  }
  return pair;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define HRI_INSTANTIATE_FILTER_PAIR(T)                        \
  template Span<const NamedPairLoops<T>> all_pair_loops<T>(); \
  template const PairLoops<T>& pair_loops<T>();               \
  template FilterPair<T> analysis_filters<T>(const Wavelet&); \
  template FilterPair<T> synthesis_filters<T>(const Wavelet&);
// NOLINTEND(bugprone-macro-parentheses)
HRI_INSTANTIATE_FILTER_PAIR(float)
HRI_INSTANTIATE_FILTER_PAIR(double)
#undef HRI_INSTANTIATE_FILTER_PAIR

}  // namespace hri::detail
