// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/resample_kernel.hpp"

#include <cstdint>
#include <utility>

#define HRI_KERNEL_FILE "signal/resample_kernel.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const ResampleKernel* const> all_resample_kernels() {
  static constexpr const ResampleKernel* kAll[] = {HRI_EVERY_SET(&, kKernel)};
  return runnable(kAll);
}

const ResampleKernel& resample_kernel() {
  static const ResampleKernel& kernel = *widest(all_resample_kernels());
  return kernel;
}

}  // namespace hri::detail
