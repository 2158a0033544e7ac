// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/filter_pair.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>

#include "hri/core/error.hpp"

#define HRI_KERNEL_FILE "signal/filter_pair_kernel.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {
namespace {

void require_filters(const Wavelet& w) {
  const std::size_t size = w.dec_lo.size();
  require(size >= 2 && size <= kMaxTaps && size % 2 == 0 && w.dec_hi.size() == size &&
              w.rec_lo.size() == size && w.rec_hi.size() == size,
          "the four filters of a wavelet must have one even length, 2..128");
}

}  // namespace

template <class T>
Span<const NamedPairLoops<T>> all_pair_loops() {
  static constexpr NamedPairLoops<T> kAll[] = {HRI_EVERY_SET(, kLoops<T>)};
  return runnable(kAll);
}

template <class T>
const PairLoops<T>& pair_loops() {
  static const PairLoops<T>& best = widest(all_pair_loops<T>()).loops;
  return best;
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
