// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/conv_kernels.hpp"

#define HRI_KERNEL_FILE "models/network/conv_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const ConvKernels* const> all_conv_kernels() {
  static constexpr const ConvKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const ConvKernels& conv_kernels() {
  static const ConvKernels& kernels = *widest(all_conv_kernels());
  return kernels;
}

}  // namespace hri::detail
