// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The search behind Codebook: all distances from a few rows to a few codewords at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hri/core/types.hpp"

namespace hri::detail {

struct Nearest {
  std::int32_t index = 0;
  float distance = 0;  ///< squared
};

/// Centroids as columns, padded to whole blocks; codewords that only pad lie infinitely far.
MatrixF codeword_columns(const MatrixF& centroids);

/// The nearest codeword of every row, the lower index where two are as near. `columns` is what
/// codeword_columns() gave; rows are `stride` values apart. Allocates nothing.
void find_nearest(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const MatrixF& columns, Nearest* out);

/// sums += row; and, unless `squares` is null, squares += row^2.
void accumulate(const float* row, int dim, double* sums, double* squares);

}  // namespace hri::detail
