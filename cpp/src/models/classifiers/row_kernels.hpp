// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The arithmetic of classifiers of rows: rows against the rows of a table, many at a time. Each
// number depends on its two rows alone, by sums in an order that is stated here, and nothing is
// fused: it is the same to the bit for one row and for many, by every instruction set.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Rows of a table that stand side by side.
constexpr int kRowBlock = 32;

/// What the kernels see of a table. Plain pointers: kernels are compiled with flags of their own,
/// and calls to functions of other headers would stay calls.
struct RowLayout {
  std::ptrdiff_t num_rows = 0;
  std::ptrdiff_t dim = 0;
  const float* values = nullptr;  ///< by blocks of rows, columns, rows; padded with zeros
};

/// A matrix laid out for the kernels.
class RowTable {
 public:
  explicit RowTable(ConstMatrixRefF rows);
  [[nodiscard]] Eigen::Index rows() const { return num_rows_; }
  [[nodiscard]] Eigen::Index cols() const { return dim_; }
  /// Places that one row's results take: rows() and padding.
  [[nodiscard]] Eigen::Index padded_rows() const {
    return (num_rows_ + kRowBlock - 1) / kRowBlock * kRowBlock;
  }
  [[nodiscard]] MatrixF matrix() const;
  [[nodiscard]] RowLayout layout() const { return {num_rows_, dim_, values_.data()}; }

 private:
  Eigen::Index num_rows_;
  Eigen::Index dim_;
  std::vector<float> values_;
};

/// Rows `x` are `stride` values apart, results of a row and the next one `out_stride`. Whole
/// registers are written: as many places as the table has with its padding.
struct RowKernels {
  const char* name;
  /// Squared distances to the rows first .. first + count of the table, both multiples of
  /// kRowBlock: added up in the order of the columns.
  void (*squared_distances)(const float* x, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                            const RowLayout& table, std::ptrdiff_t first, std::ptrdiff_t count,
                            float* out, std::ptrdiff_t out_stride);
  /// What dot() gives for every row of the table.
  void (*dots)(const float* x, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
               const RowLayout& table, float* out, std::ptrdiff_t out_stride);
  /// The table times each row: sum j has columns j, j + 4, ... of whole fours; then
  /// (0 + 2) + (1 + 3), then the columns left over.
  void (*project)(const float* x, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const RowLayout& table, float* out, std::ptrdiff_t out_stride);
  /// Sum of squares: eight sums, the upper four added to the lower four, and the rest as above.
  float (*squared_norm)(const float* x, std::ptrdiff_t dim);
  /// Index of the first of values[first .. count) below the limit; `count` where there is none.
  std::ptrdiff_t (*first_below)(const float* values, std::ptrdiff_t first, std::ptrdiff_t count,
                                float limit);
};

/// Those of the widest instruction set this machine has.
const RowKernels& row_kernels();

/// Those of all instruction sets it has, for tests.
Span<const RowKernels* const> all_row_kernels();

}  // namespace hri::detail
