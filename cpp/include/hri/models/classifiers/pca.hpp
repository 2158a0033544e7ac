// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Principal component analysis (thesis eq. 6.11-6.14).
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads. Invariant: rows of `components` are
/// orthonormal.
class HRI_API Pca {
 public:
  /// The `num_components` directions of largest variance, 1..; fewer where the rows vary in fewer.
  /// The sign of a component is such that its largest entry is positive. Throws InvalidArgument for
  /// no rows or values not finite.
  static Pca train(ConstMatrixRefF rows, int num_components);

  [[nodiscard]] int num_components() const { return static_cast<int>(components_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(components_.cols()); }
  [[nodiscard]] const MatrixF& components() const { return components_; }
  [[nodiscard]] const VectorF& mean() const { return mean_; }
  /// Variance along every component, falling, shape (num_components,).
  [[nodiscard]] const VectorF& variances() const { return variances_; }

  /// (rows - mean) * components^T, shape (num_rows, num_components).
  [[nodiscard]] MatrixF transform(ConstMatrixRefF rows) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static Pca read(const ModelFile& file, const std::string& prefix);

 private:
  MatrixF components_;
  VectorF mean_;
  VectorF variances_;
};

}  // namespace hri
