// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Doubles laid out for wide registers: rows begin at whole cache lines, so that no load or store of
// a register is split in two.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/cache_line.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

using AlignedVector = std::vector<double, CacheLineAllocator<double>>;

constexpr int kLanes = 8;  // doubles in a cache line

inline std::ptrdiff_t padded(std::ptrdiff_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

class PaddedMatrix {
 public:
  PaddedMatrix() = default;
  PaddedMatrix(std::ptrdiff_t num_rows, std::ptrdiff_t num_columns, double filler)
      : num_rows_(num_rows),
        stride_(padded(num_columns)),
        values_(static_cast<std::size_t>(num_rows * stride_), filler) {}
  explicit PaddedMatrix(const MatrixD& values, double filler = 0)
      : PaddedMatrix(values.rows(), values.cols(), filler) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      for (Eigen::Index j = 0; j < values.cols(); ++j) row(i)[j] = values(i, j);
    }
  }

  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] std::ptrdiff_t num_rows() const { return num_rows_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  [[nodiscard]] double* row(std::ptrdiff_t i) { return values_.data() + i * stride_; }
  [[nodiscard]] const double* row(std::ptrdiff_t i) const { return values_.data() + i * stride_; }

  /// The shape alone; values are undefined. Never gives memory back.
  void resize(std::ptrdiff_t num_rows, std::ptrdiff_t num_columns) {
    num_rows_ = num_rows;
    stride_ = padded(num_columns);
    const auto needed = static_cast<std::size_t>(num_rows * stride_);
    if (values_.size() < needed) values_.resize(needed);
  }

 private:
  std::ptrdiff_t num_rows_ = 0;
  std::ptrdiff_t stride_ = 0;
  AlignedVector values_;
};

}  // namespace hri::detail
