// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/emission_kernels.hpp"

#define HRI_KERNEL_FILE "language/emission_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const EmissionKernels* const> all_emission_kernels() {
  static constexpr const EmissionKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const EmissionKernels& emission_kernels() {
  static const EmissionKernels& kernels = *widest(all_emission_kernels());
  return kernels;
}

}  // namespace hri::detail
