// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibility_kernel.hpp"

#include <limits>
#include <type_traits>

namespace hri::detail {
namespace {

namespace baseline {
#include "models/possibility/possibility_kernel.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
#include "models/possibility/possibility_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
#include "models/possibility/possibility_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

template <class T>
constexpr ChainKernels<T> kBaseline{"baseline", &baseline::advance_block<T>,
                                    &baseline::best_of_block<T>};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
template <class T>
constexpr ChainKernels<T> kAvx2{"avx2", &avx2::advance_block<T>, &avx2::best_of_block<T>};
template <class T>
constexpr ChainKernels<T> kAvx512{"avx512", &avx512::advance_block<T>, &avx512::best_of_block<T>};

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq");
}
#endif

template <class T>
ChainKernels<T> choose() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (has_avx512()) return kAvx512<T>;
  if (has_avx2()) return kAvx2<T>;
#endif
  return kBaseline<T>;
}

template <class T>
const ChainKernels<T>& kernels() {
  static const ChainKernels<T> chosen = choose<T>();
  return chosen;
}

}  // namespace

template <class T>
std::vector<ChainKernels<T>> chain_kernels() {
  std::vector<ChainKernels<T>> found = {kBaseline<T>};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (has_avx2()) found.push_back(kAvx2<T>);
  if (has_avx512()) found.push_back(kAvx512<T>);
#endif
  return found;
}

template <class T>
void advance(const ChainBlock<T>& block, const ChainRule<T>& rule, const T* start,
             const FrameTable<T>& frames, std::ptrdiff_t num_frames, ChainState<T>* state) {
  kernels<T>().advance(block, rule, start, frames, num_frames, state);
}

template <class T>
void best_of_lanes(const T* phi, const T* ends, int num_rows, int num_lanes, T floor, T* best) {
  kernels<T>().best_of_lanes(phi, ends, num_rows, num_lanes, floor, best);
}

template std::vector<ChainKernels<float>> chain_kernels<float>();
template std::vector<ChainKernels<double>> chain_kernels<double>();
template std::vector<ChainKernels<std::int16_t>> chain_kernels<std::int16_t>();

template void best_of_lanes<float>(const float*, const float*, int, int, float, float*);
template void best_of_lanes<double>(const double*, const double*, int, int, double, double*);
template void best_of_lanes<std::int16_t>(const std::int16_t*, const std::int16_t*, int, int,
                                          std::int16_t, std::int16_t*);

template void advance<float>(const ChainBlock<float>&, const ChainRule<float>&, const float*,
                             const FrameTable<float>&, std::ptrdiff_t, ChainState<float>*);
template void advance<double>(const ChainBlock<double>&, const ChainRule<double>&, const double*,
                              const FrameTable<double>&, std::ptrdiff_t, ChainState<double>*);
template void advance<std::int16_t>(const ChainBlock<std::int16_t>&, const ChainRule<std::int16_t>&,
                                    const std::int16_t*, const FrameTable<std::int16_t>&,
                                    std::ptrdiff_t, ChainState<std::int16_t>*);

}  // namespace hri::detail
