// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/classifiers/row_kernels.hpp"

#include <cstdint>

#define HRI_KERNEL_FILE "models/classifiers/row_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

RowTable::RowTable(ConstMatrixRefF rows) : num_rows_(rows.rows()), dim_(rows.cols()) {
  values_.assign(static_cast<std::size_t>(padded_rows() * dim_), 0.0F);
  for (Eigen::Index r = 0; r < num_rows_; ++r) {
    float* value = values_.data() + r / kRowBlock * kRowBlock * dim_ + r % kRowBlock;
    for (Eigen::Index d = 0; d < dim_; ++d) value[d * kRowBlock] = rows(r, d);
  }
}

MatrixF RowTable::matrix() const {
  MatrixF rows(num_rows_, dim_);
  for (Eigen::Index r = 0; r < num_rows_; ++r) {
    const float* value = values_.data() + r / kRowBlock * kRowBlock * dim_ + r % kRowBlock;
    for (Eigen::Index d = 0; d < dim_; ++d) rows(r, d) = value[d * kRowBlock];
  }
  return rows;
}

Span<const RowKernels* const> all_row_kernels() {
  static constexpr const RowKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const RowKernels& row_kernels() {
  static const RowKernels& kernels = *widest(all_row_kernels());
  return kernels;
}

}  // namespace hri::detail
