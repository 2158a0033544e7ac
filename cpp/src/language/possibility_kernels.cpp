// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/possibility_kernels.hpp"

#define HRI_KERNEL_FILE "language/possibility_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const PossibilityKernels* const> all_possibility_kernels() {
  static constexpr const PossibilityKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const PossibilityKernels& possibility_kernels() {
  static const PossibilityKernels& kernels = *widest(all_possibility_kernels());
  return kernels;
}

}  // namespace hri::detail
