// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/kernels.hpp"

#include <cmath>

#include "core/simd.hpp"

namespace hri {

HRI_SIMD_CLONES
float dot(const float* a, const float* b, int count) {
  constexpr int kLanes = 16;
  float lanes[kLanes] = {};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int l = 0; l < kLanes; ++l) lanes[l] += a[i + l] * b[i + l];
  }
  float sum = 0;
  for (; i < count; ++i) sum += a[i] * b[i];
  for (const float lane : lanes) sum += lane;
  return sum;
}

namespace {

HRI_SIMD_CLONES
bool all_finite(const float* values, std::size_t count) {
  // Zero times a finite value is zero, times any other it is NaN, and NaN stays.
  constexpr std::size_t kLanes = 16;
  float lanes[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) lanes[l] += 0.0F * values[i + l];
  }
  float sum = 0;
  for (; i < count; ++i) sum += 0.0F * values[i];
  for (const float lane : lanes) sum += lane;
  return sum == 0;
}

}  // namespace

std::size_t first_not_finite(const float* values, std::size_t count) {
  if (all_finite(values, count)) return count;
  std::size_t i = 0;
  while (std::isfinite(values[i])) ++i;
  return i;
}

}  // namespace hri
