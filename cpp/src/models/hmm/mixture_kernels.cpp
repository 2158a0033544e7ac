// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/mixture_kernels.hpp"

#include <cstdint>
#include <limits>

namespace hri::detail {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

}  // namespace
}  // namespace hri::detail

#define HRI_KERNEL_FILE "models/hmm/mixture_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const MixtureKernels* const> all_mixture_kernels() {
  static constexpr const MixtureKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const MixtureKernels& mixture_kernels() {
  static const MixtureKernels& kernels = *widest(all_mixture_kernels());
  return kernels;
}

}  // namespace hri::detail
