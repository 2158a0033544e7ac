// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "features/speech/cepstra_kernels.hpp"

#include <cfloat>
#include <cstdint>

#include "core/simd.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-math-errno")  // square roots are instructions
#endif

#define HRI_KERNEL_FILE "features/speech/cepstra_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const CepstraKernels* const> all_cepstra_kernels() {
  static constexpr const CepstraKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const CepstraKernels& cepstra_kernels() {
  static const CepstraKernels& kernels = *widest(all_cepstra_kernels());
  return kernels;
}

}  // namespace hri::detail
