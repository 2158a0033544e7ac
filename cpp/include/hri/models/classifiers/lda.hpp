// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Linear discriminant analysis (Fisher, 1936; Fukunaga, Introduction to Statistical Pattern
// Recognition, 1990, ch. 10): the directions along which classes lie max_displacement apart,
// measured in their spread within classes. Rows may be fixed vectors, or frames labelled by state.
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct LdaOptions {
  int num_components = 0;
  double shrinkage = 0;

  static constexpr const char* kName = "LdaOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_components", o.num_components, within(0, 1e6),
      "at most the number of classes less 1; 0: as many as there are");
    v("shrinkage", o.shrinkage, within(0, 1),
      "share of the covariance within classes that is replaced by its mean variance times the "
      "identity");
  }
};

/// Immutable; const calls are safe from several threads. Invariant: projected rows of the training
/// set have the identity for their (shrunk) covariance within classes.
class HRI_API Lda {
 public:
  /// Directions in which rows of the same class do not vary at all are left out. The sign of a
  /// component is such that its largest entry is positive. Throws InvalidArgument as validate_rows
  /// does, for options out of range (named), and where no direction is left.
  static Lda train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                   const LdaOptions& options);

  [[nodiscard]] int num_components() const { return static_cast<int>(components_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(components_.cols()); }
  [[nodiscard]] const MatrixF& components() const { return components_; }
  /// Of all training rows.
  [[nodiscard]] const VectorF& mean() const { return mean_; }
  /// Variance between classes over variance within, of every component, falling.
  [[nodiscard]] const VectorF& ratios() const { return ratios_; }

  /// (rows - mean) * components^T, shape (num_rows, num_components).
  [[nodiscard]] MatrixF transform(ConstMatrixRefF rows) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static Lda read(const ModelFile& file, const std::string& prefix);

 private:
  MatrixF components_;
  VectorF mean_;
  VectorF ratios_;
};

}  // namespace hri
