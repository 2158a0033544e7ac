// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hri/core/types.hpp"

namespace hri::detail {

/// Like resize(), which frees the old memory before it asks for the new: where there is none, the
/// matrix would free the old once more when it ends.
template <class M>
void fit(M* matrix, Eigen::Index rows, Eigen::Index cols) {
  if (matrix->rows() == rows && matrix->cols() == cols) return;
  M fresh(rows, cols);
  matrix->swap(fresh);
}

template <class M>
void fit_zeros(M* matrix, Eigen::Index rows, Eigen::Index cols) {
  fit(matrix, rows, cols);
  matrix->setZero();
}

}  // namespace hri::detail
