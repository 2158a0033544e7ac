// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/resample_kernel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"

namespace hri::detail {
namespace {

std::vector<float> noise(std::ptrdiff_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(static_cast<std::size_t>(count));
  for (float& value : values) value = static_cast<float>(random.normal());
  return values;
}

// Output by output, as the header says.
void expect_dots(const ResampleKernel& kernel, const PhaseTable& table, std::ptrdiff_t phase,
                 std::ptrdiff_t count) {
  const std::ptrdiff_t up = table.num_phases;
  const std::ptrdiff_t num_samples =
      (count / up + 2) * (table.sample_step * up + table.phase_step) + table.stride;
  const std::vector<float> x = noise(num_samples, 2);
  std::vector<float> out(static_cast<std::size_t>(count) + 1, 7.0F);
  kernel.filter(table, x.data(), phase, count, out.data());
  const std::ptrdiff_t whole = count - count % kernel.num_lanes;
  for (std::ptrdiff_t n = 0; n <= count; ++n) {
    const std::ptrdiff_t steps = phase + n * table.phase_step;
    const float* samples = x.data() + n * table.sample_step + steps / up;
    const float* weights = table.weights + steps % up * table.stride;
    ASSERT_EQ(out[static_cast<std::size_t>(n)],
              n < whole ? dot(weights, samples, static_cast<int>(table.taps)) : 7.0F)
        << kernel.name << ", " << table.taps << " taps, " << up << " phases, output " << n << " of "
        << count;
  }
}

TEST(ResampleKernel, GivesDotsByEveryInstructionSet) {
  ASSERT_FALSE(all_resample_kernels().empty());
  for (const ResampleKernel* kernel : all_resample_kernels()) {
    for (const std::ptrdiff_t taps : {2, 16, 31, 66, 186}) {
      for (const std::ptrdiff_t up : {1, 2, 7}) {
        PhaseTable table;
        table.taps = taps;
        table.stride = taps - taps % kDotLanes + kDotLanes;
        table.num_phases = up;
        const std::vector<float> weights = noise(up * table.stride, 1);
        table.weights = weights.data();
        for (const std::ptrdiff_t down : {1, 3, 16}) {
          table.phase_step = down % up;
          table.sample_step = down / up;
          for (const std::ptrdiff_t count : {0, 5, 16, 20, 40, 250})
            expect_dots(*kernel, table, up / 2, count);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hri::detail
