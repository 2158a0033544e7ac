// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "features/speech/cepstra_kernels.hpp"

#include <cfloat>
#include <cstdint>

// A fused multiply-add rounds once where others round twice, and compilers fuse unless told.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#pragma GCC optimize("no-math-errno")  // square roots are instructions
#endif

namespace hri::detail {
namespace {

namespace baseline {
constexpr const char* kName = "baseline";
constexpr int kLanes = 4;
#include "features/speech/cepstra_kernels.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
constexpr const char* kName = "avx2";
constexpr int kLanes = 8;
#include "features/speech/cepstra_kernels.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
constexpr const char* kName = "avx512";
constexpr int kLanes = 16;
#include "features/speech/cepstra_kernels.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

}  // namespace

std::vector<const CepstraKernels*> all_cepstra_kernels() {
  std::vector<const CepstraKernels*> all{&baseline::kKernels};
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

const CepstraKernels& cepstra_kernels() {
  static const CepstraKernels& kernels = *all_cepstra_kernels().back();
  return kernels;
}

}  // namespace hri::detail
