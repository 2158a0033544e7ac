// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/token_kernels.hpp"

#include <limits>

#define HRI_KERNEL_FILE "language/token_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const TokenKernels* const> all_token_kernels() {
  static constexpr const TokenKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const TokenKernels& token_kernels() {
  static const TokenKernels& kernels = *widest(all_token_kernels());
  return kernels;
}

}  // namespace hri::detail
