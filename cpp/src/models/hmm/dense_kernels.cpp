// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/dense_kernels.hpp"

#include <cstdint>
#include <limits>

namespace hri::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Lane l + half of a register, for half = 4, 2, 1; narrower registers use the last ones.
constexpr std::int64_t kShifts[3][8] = {
    {4, 5, 6, 7, 0, 1, 2, 3}, {2, 3, 4, 5, 6, 7, 0, 1}, {1, 2, 3, 4, 5, 6, 7, 0}};

}  // namespace
}  // namespace hri::detail

#define HRI_KERNEL_FILE "models/hmm/dense_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const DenseKernels* const> all_dense_kernels() {
  static constexpr const DenseKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const DenseKernels& dense_kernels() {
  static const DenseKernels& kernels = *widest(all_dense_kernels());
  return kernels;
}

}  // namespace hri::detail
