// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/dense_kernels.hpp"

#include <cstdint>
#include <limits>

// A fused multiply-add rounds once where others round twice, and compilers fuse unless told.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

namespace hri::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Lane l + half of a register, for half = 4, 2, 1; narrower registers use the last ones.
constexpr std::int64_t kShifts[3][8] = {
    {4, 5, 6, 7, 0, 1, 2, 3}, {2, 3, 4, 5, 6, 7, 0, 1}, {1, 2, 3, 4, 5, 6, 7, 0}};

namespace baseline {
constexpr int kWidth = 2;
constexpr int kBlock = 8;
#include "models/hmm/dense_kernels.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
constexpr int kWidth = 4;
constexpr int kBlock = 8;
#include "models/hmm/dense_kernels.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
constexpr int kWidth = 8;
constexpr int kBlock = 8;
#include "models/hmm/dense_kernels.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

}  // namespace

std::vector<const DenseKernels*> all_dense_kernels() {
  std::vector<const DenseKernels*> all{&baseline::kKernels};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    all.push_back(&avx2::kKernels);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    all.push_back(&avx512::kKernels);
  }
#endif
  return all;
}

const DenseKernels& dense_kernels() {
  static const DenseKernels& kernels = *all_dense_kernels().back();
  return kernels;
}

}  // namespace hri::detail
