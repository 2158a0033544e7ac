// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Logistic regression of many classes: P(c | x) is in proportion to exp(w_c z + b_c) with z the
// standardised row (Bishop, "Pattern recognition and machine learning", section 4.3.4).
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct SoftmaxRegressionOptions {
  double penalty = 1;
  int max_iterations = 200;

  static constexpr const char* kName = "SoftmaxRegressionOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("penalty", o.penalty, above(0, 1e12),
      "of half the squared weights, against the sum over rows");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations at most");
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API SoftmaxRegression {
 public:
  /// Columns are standardised by the mean and deviation of all rows; one that is constant gets no
  /// weight. Throws InvalidArgument as validate_rows does, for options out of range (named), and
  /// for a class without rows.
  static SoftmaxRegression train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                 const SoftmaxRegressionOptions& options,
                                 const StopCheck& should_stop = {});

  /// Of rows as they are, by weights of shape (num_classes, dim). Throws InvalidArgument for sizes
  /// that do not fit and values that are not finite.
  static SoftmaxRegression of(ConstMatrixRefF weights, const VectorF& bias);

  [[nodiscard]] int num_classes() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(weights_.cols()); }

  /// log P(c | row) but for a constant, for a row of dim() values; shape (num_classes,).
  [[nodiscard]] VectorF scores(Span<const float> row) const;

  /// With one class more, of number `index`: its weights alone are fitted, to part `rows` from
  /// `others`, of which each stands for so many rows of another class, as all of `rows` together
  /// stand for as many. Throws InvalidArgument for rows of another size or not finite.
  [[nodiscard]] SoftmaxRegression with_class(int index, ConstMatrixRefF rows,
                                             ConstMatrixRefF others, double rows_per_other,
                                             const SoftmaxRegressionOptions& options,
                                             const StopCheck& should_stop = {}) const;
  [[nodiscard]] SoftmaxRegression without_class(int index) const;
  /// For rows that all lie so much further along.
  [[nodiscard]] SoftmaxRegression moved(Span<const float> shift) const;

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError where the sizes do not fit.
  static SoftmaxRegression read(const ModelFile& file, const std::string& prefix);

 private:
  [[nodiscard]] MatrixF standardised(ConstMatrixRefF rows) const;

  VectorF mean_;
  VectorF scale_;    // 1 / deviation; 0 for a constant column
  MatrixF weights_;  // of standardised columns, shape (num_classes, dim)
  VectorF bias_;
};

}  // namespace hri
