// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/normal_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#define HRI_KERNEL_FILE "core/normal_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

Span<const NormalKernels* const> all_normal_kernels() {
  static constexpr const NormalKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const NormalKernels& normal_kernels() {
  static const NormalKernels& kernels = *widest(all_normal_kernels());
  return kernels;
}

void fill_normals(Random* random, Span<double> out) {
  constexpr std::size_t kAtOnce = 64;
  double u[kAtOnce];
  double v[kAtOnce];
  for (std::size_t first = 0; first < out.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, out.size() - first);
    std::fill_n(u, kAtOnce, 1.0);
    std::fill_n(v, kAtOnce, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      u[i] = 1.0 - random->uniform();
      v[i] = random->uniform();
    }
    normal_kernels().box_muller(u, v, kAtOnce, u);
    std::copy_n(u, count, out.data() + first);
  }
}

}  // namespace hri::detail
