// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/simd.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace hri::detail {
namespace {

constexpr std::string_view kNames[] = {"baseline",
#if HRI_WITH_AVX2
                                       "avx2",
#endif
#if HRI_WITH_AVX512
                                       "avx512"
#endif
};

#if HRI_WITH_AVX2
bool has_avx2() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}
#endif

#if HRI_WITH_AVX512
bool has_avx512() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512dq") != 0;
}
#endif

std::size_t count_sets() {
  std::size_t count = 1;
#if HRI_WITH_AVX2
  if (!has_avx2()) return count;
  ++count;
#endif
#if HRI_WITH_AVX512
  if (has_avx512()) ++count;
#endif
  return count;
}

std::size_t count_used() {
  const char* const level = std::getenv("HRI_SIMD_LEVEL");  // NOLINT(concurrency-mt-unsafe)
  const std::size_t available = num_instruction_sets();
  if (level == nullptr) return available;
  const auto* const named = std::find(std::begin(kNames), std::end(kNames), level);
  return std::min(available, static_cast<std::size_t>(named - std::begin(kNames)) + 1);
}

}  // namespace

std::size_t num_instruction_sets() {
  static const std::size_t count = count_sets();
  return count;
}

std::size_t num_used_instruction_sets() {
  static const std::size_t count = count_used();
  return count;
}

}  // namespace hri::detail
