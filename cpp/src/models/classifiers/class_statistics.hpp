// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Means and covariances of classes of rows, which several classifiers start from.
#pragma once

#include "hri/core/types.hpp"

namespace hri::detail {

struct ClassStatistics {
  MatrixD means;     ///< (num_classes, dim)
  VectorD counts;    ///< rows of every class
  MatrixD scatter;   ///< sums of squared deviations of every class, (num_classes * dim, dim)
  double floor = 0;  ///< variance that keeps constant features invertible

  [[nodiscard]] Eigen::Index dim() const { return means.cols(); }
  /// The covariance within classes, over the number of all rows.
  [[nodiscard]] MatrixD pooled() const;
  /// Of one class over its number of rows; pooled where one row has no spread of its own.
  [[nodiscard]] MatrixD covariance(int c) const;
};

/// Throws InvalidArgument as validate_rows does.
ClassStatistics class_statistics(ConstMatrixRefF rows, Span<const int> classes, int num_classes);

/// Shrinks towards a sphere: `shrinkage` (0..1) of the covariance becomes its mean variance times
/// the identity. The floor keeps tiny classes invertible whatever the share. Throws InvalidArgument
/// for a share out of range.
MatrixD regularised(MatrixD covariance, double shrinkage, double floor);

/// L^-1 of the Cholesky factor L and log |L|; `valid` is false where the matrix is not positive
/// definite.
struct Whitening {
  MatrixF inverse;
  double log_root = 0;
  bool valid = false;
};
Whitening whiten(ConstMatrixRefD covariance);

}  // namespace hri::detail
