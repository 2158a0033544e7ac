// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/dense_kernels.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace hri::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Lane l + half of a register, for half = 4, 2, 1; narrower registers use the last ones.
constexpr std::int64_t kShifts[3][8] = {
    {4, 5, 6, 7, 0, 1, 2, 3}, {2, 3, 4, 5, 6, 7, 0, 1}, {1, 2, 3, 4, 5, 6, 7, 0}};
// Of log_steps.cpp: a sum so small that terms may have underflowed is taken again in logs.
constexpr double kSafeSum = 1e-200;
// As long as no pair is too far above the total, terms that underflow are none that count.
constexpr double kSafeLead = 460;
// exp(-37) is lost beside 1.
constexpr double kLost = -37;

double log_of_sum(double a, double b) {
  const double top = a > b ? a : b;
  return top + std::log(std::exp(a - top) + std::exp(b - top));
}

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
