// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Instruction sets chosen at run time: shipped builds are for any machine of their architecture and
// never use -march=native. Loops that the compiler turns into vectors by itself stand behind
// HRI_SIMD_CLONES. Kernels that are written in vectors stand in an .inc file that
// core/foreach_instruction_set.inc compiles once for every set, in a namespace of its own; dispatch
// tables of them come from HRI_EVERY_SET. CMake's HRI_SIMD says which sets are built.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(HRI_NO_AVX2)
#define HRI_WITH_AVX2 1
#else
#define HRI_WITH_AVX2 0
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(HRI_NO_AVX512)
#define HRI_WITH_AVX512 1
#else
#define HRI_WITH_AVX512 0
#endif

/// In front of a non-inline function of a source file: the compiler makes one clone for every set
/// and the loader picks one, by the features of the processor (the name of a processor, such as
/// haswell, would ask for that very one). All give the same bits, as nothing is fused
/// (cmake/HriTarget.cmake). Clang makes clones of functions with external linkage only, and GCC
/// knows these levels from 12 on; others get none.
#if defined(__clang__) || !defined(__gnu_linux__) || __GNUC__ < 12
#define HRI_SIMD_CLONES
#elif HRI_WITH_AVX2 && HRI_WITH_AVX512
#define HRI_SIMD_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#elif HRI_WITH_AVX2
#define HRI_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#elif HRI_WITH_AVX512
#define HRI_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "default")))
#else
#define HRI_SIMD_CLONES
#endif

// The same expression of every set's namespace, from the narrowest to the widest: HRI_EVERY_SET(&,
// kKernels) is &baseline::kKernels, &avx2::kKernels, &avx512::kKernels.
#if HRI_WITH_AVX2 && HRI_WITH_AVX512
#define HRI_EVERY_SET(prefix, ...) \
  prefix baseline::__VA_ARGS__, prefix avx2::__VA_ARGS__, prefix avx512::__VA_ARGS__
#elif HRI_WITH_AVX2
#define HRI_EVERY_SET(prefix, ...) prefix baseline::__VA_ARGS__, prefix avx2::__VA_ARGS__
#elif HRI_WITH_AVX512
#define HRI_EVERY_SET(prefix, ...) prefix baseline::__VA_ARGS__, prefix avx512::__VA_ARGS__
#else
#define HRI_EVERY_SET(prefix, ...) prefix baseline::__VA_ARGS__
#endif

namespace hri::detail {

/// How many of the sets that were built this machine has, 1.. ; each implies those before it.
std::size_t num_instruction_sets();

/// How many of them are used: all, or fewer where the environment variable HRI_SIMD_LEVEL names a
/// narrower set (baseline, avx2, avx512) at the first call, to try on one machine what another one
/// does.
std::size_t num_used_instruction_sets();

/// The kernels that this machine can run, the widest last, from a table of all that were built
/// (HRI_EVERY_SET).
template <class Kernels, std::size_t kNum>
Span<const Kernels> runnable(const Kernels (&every_set)[kNum]) {
  static_assert(kNum == 1 + HRI_WITH_AVX2 + HRI_WITH_AVX512);
  return {every_set, num_instruction_sets()};
}

/// The one to use.
template <class Kernels>
const Kernels& widest(Span<const Kernels> kernels) {
  return kernels[num_used_instruction_sets() - 1];
}

}  // namespace hri::detail
