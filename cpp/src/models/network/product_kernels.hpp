// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Products of matrices in rows. Every sum is taken in the same order on every machine, without
// fused multiply-adds, so that all give the same bits.
#pragma once

#include "hri/core/types.hpp"

namespace hri::detail {

/// Columns of a product come in multiples of this.
constexpr int kProductColumns = 8;

struct ProductKernels {
  /// c(i, j) = bias(j) + sum over l, ascending, of a(i, l) b(l, j), for shapes (rows, inner) and
  /// (inner, columns); without a bias from 0.
  void (*multiply)(const float* a, const float* b, const float* bias, int rows, int inner,
                   int columns, float* c);
};

/// Those of the widest instruction set this machine has.
const ProductKernels& product_kernels();

/// Those of all instruction sets it has, for tests.
Span<const ProductKernels* const> all_product_kernels();

/// a b into `c`, which gets its size; b has a multiple of kProductColumns columns.
void multiply(const MatrixF& a, const MatrixF& b, MatrixF* c);
/// The same plus `bias` in every row.
void multiply(const MatrixF& a, const MatrixF& b, const VectorF& bias, MatrixF* c);

}  // namespace hri::detail
