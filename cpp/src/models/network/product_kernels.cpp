// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/product_kernels.hpp"

#include "hri/core/error.hpp"

#define HRI_KERNEL_FILE "models/network/product_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {
namespace {

void multiply_with(const MatrixF& a, const MatrixF& b, const float* bias, MatrixF* c) {
  require(a.cols() == b.rows() && b.cols() % kProductColumns == 0,
          "the matrices do not fit one another");
  c->resize(a.rows(), b.cols());
  product_kernels().multiply(a.data(), b.data(), bias, static_cast<int>(a.rows()),
                             static_cast<int>(a.cols()), static_cast<int>(b.cols()), c->data());
}

}  // namespace

Span<const ProductKernels* const> all_product_kernels() {
  static constexpr const ProductKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const ProductKernels& product_kernels() {
  static const ProductKernels& kernels = *widest(all_product_kernels());
  return kernels;
}

void multiply(const MatrixF& a, const MatrixF& b, MatrixF* c) { multiply_with(a, b, nullptr, c); }

void multiply(const MatrixF& a, const MatrixF& b, const VectorF& bias, MatrixF* c) {
  require(bias.size() == b.cols(), "the bias does not fit the matrix");
  multiply_with(a, b, bias.data(), c);
}

}  // namespace hri::detail
