// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of CodedPossibilities: codewords of values, and sums of rows of tables, one column a
// lane. Rows are added in their order whatever the instruction set, so that all give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Rows and lists are padded to a multiple of so many floats: a cache line, and the widest
/// register.
constexpr std::ptrdiff_t kRowFloats = 16;

struct PossibilityKernels {
  /// How many of the values, which rise, are at most x; `count` is a multiple of kRowFloats.
  std::ptrdiff_t (*count_up_to)(const float* values, std::ptrdiff_t count, float x);
  /// out[j] = ((0 + rows[0][j]) + rows[1][j]) + ..., for `size` columns, a multiple of kRowFloats.
  void (*add_rows)(const float* const* rows, std::ptrdiff_t num_rows, std::ptrdiff_t size,
                   float* out);
};

/// Those of the widest instruction set this machine has.
const PossibilityKernels& possibility_kernels();

/// Those of all instruction sets it has, for tests.
Span<const PossibilityKernels* const> all_possibility_kernels();

}  // namespace hri::detail
