// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "nearest_codeword.hpp"

#include <limits>

#include "hri/core/simd.hpp"

namespace hri::detail {
namespace {

constexpr int kLanes = 16;
constexpr int kBlock = 2 * kLanes;  // codewords at a time
constexpr int kRows = 4;            // rows at a time: they share every load of a codeword

namespace baseline {
#include "nearest_codeword_kernel.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
#include "nearest_codeword_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
#include "nearest_codeword_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

using Search = void (*)(const float*, std::ptrdiff_t, std::ptrdiff_t, int, const float*,
                        std::ptrdiff_t, Nearest*);

// All give the same bits: no instruction set fuses or reorders the sums.
Search choose() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    return &avx512::search_rows;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &avx2::search_rows;
#endif
  return &baseline::search_rows;
}

}  // namespace

MatrixF codeword_columns(const MatrixF& centroids) {
  const Eigen::Index padded = (centroids.rows() + kBlock - 1) / kBlock * kBlock;
  MatrixF columns =
      MatrixF::Constant(centroids.cols(), padded, std::numeric_limits<float>::infinity());
  columns.leftCols(centroids.rows()) = centroids.transpose();
  return columns;
}

void find_nearest(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const MatrixF& columns, Nearest* out) {
  static const Search search_rows = choose();
  search_rows(rows, stride, num_rows, static_cast<int>(columns.rows()), columns.data(),
              columns.cols(), out);
}

HRI_SIMD_CLONES
void accumulate(const float* row, int dim, double* sums, double* squares) {
  for (int d = 0; d < dim; ++d) sums[d] += static_cast<double>(row[d]);
  if (squares == nullptr) return;
  for (int d = 0; d < dim; ++d) squares[d] += static_cast<double>(row[d]) * row[d];
}

}  // namespace hri::detail
