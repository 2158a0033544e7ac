// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The search behind Codebook. The answer is defined by squared_distance(): float sums in the order
// of the columns, nothing fused, the lower index where two sums are equal. Blocks of rows are
// searched by |c|^2/2 - x.c, which takes one multiply-add a value; where its lead is not larger
// than all rounding could make it, the row is searched again by the definition. So the answer is
// the same to the bit whatever the instruction set and however many rows come together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// What the kernels see of a table. Plain pointers: kernels are compiled with flags of their own,
/// and calls to functions of other headers would stay calls.
struct CodewordLayout {
  int dim = 0;
  std::ptrdiff_t num_blocks = 0;    ///< in `values`
  std::ptrdiff_t num_groups = 0;    ///< in `products` and `halves`
  const float* values = nullptr;    ///< by blocks of codewords, columns, codewords; padded with
                                    ///< infinity
  const float* middle = nullptr;    ///< mean of the codewords; keeps products small
  const float* products = nullptr;  ///< middle - c: by groups of codewords, columns, codewords
  const float* halves = nullptr;    ///< |c - middle|^2 / 2, padded with infinity
  float reach = 0;                  ///< the largest |c - middle|^2
};

/// Codewords laid out for the searches.
class CodewordTable {
 public:
  explicit CodewordTable(const MatrixF& centroids);
  [[nodiscard]] CodewordLayout layout() const;

 private:
  VectorF middle_;
  std::vector<float> values_;
  std::vector<float> products_;
  std::vector<float> halves_;
  float reach_ = 0;
};

/// Rows are `stride` values apart. Neither allocates.
struct CodewordKernels {
  const char* name;
  /// The nearest codeword of every row; places in `out` are `out_stride` apart.
  void (*find_nearest)(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                       const CodewordLayout& table, std::int32_t* out, std::ptrdiff_t out_stride);
  /// Adds rows to the sums of their cells, `sums` having `dim` values a cell.
  void (*add)(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
              const float* centroids, int dim, const std::int32_t* cells, double* sums,
              double* counts, double* distortions);
};

/// Those for the best instruction set of this machine.
const CodewordKernels& codeword_kernels();
/// Those that this machine can run, the best ones last.
Span<const CodewordKernels> all_codeword_kernels();

float squared_distance(const float* a, const float* b, int dim);

/// The cells that rows fall into, summed: centroids and how far the rows lie from theirs.
struct CellSums {
  MatrixD sums;
  VectorD counts;
  VectorD distortions;  ///< sums of squared distances
};

/// Adds rows with their cells to the sums.
void add_to_cells(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const MatrixF& centroids, const std::int32_t* cells, CellSums* sums);

}  // namespace hri::detail
