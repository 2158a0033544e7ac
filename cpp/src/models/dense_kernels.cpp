// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "dense_kernels.hpp"

#include <cstdint>
#include <limits>

namespace hri::detail {
namespace {

namespace baseline {
constexpr int kWidth = 2;
constexpr int kBlock = 8;
#include "dense_kernels.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
constexpr int kWidth = 4;
constexpr int kBlock = 8;
#include "dense_kernels.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
constexpr int kWidth = 8;
constexpr int kBlock = 8;
#include "dense_kernels.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

const DenseKernels& choose() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    return avx512::kKernels;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::kKernels;
#endif
  return baseline::kKernels;
}

}  // namespace

MatrixD padded_rows(const MatrixD& matrix, double filler) {
  const std::ptrdiff_t width = padded(matrix.cols());
  if (width == matrix.cols()) return {};
  MatrixD result = MatrixD::Constant(matrix.rows(), width, filler);
  result.leftCols(matrix.cols()) = matrix;
  return result;
}

const DenseKernels& dense_kernels() {
  static const DenseKernels& kernels = choose();
  return kernels;
}

}  // namespace hri::detail
