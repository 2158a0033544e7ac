// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Logistic regression of two classes: P(yes | x) = 1 / (1 + exp(-(w z + b))) with z the
// standardised row, by Newton's method on the penalised log-likelihood (Bishop, "Pattern
// recognition and machine learning", section 4.3.3).
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct LogisticRegressionOptions {
  double penalty = 1;
  int max_iterations = 50;

  static constexpr const char* kName = "LogisticRegressionOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("penalty", o.penalty, above(0, 1e12),
      "of half the squared weights, against the sum over rows");
    v("max_iterations", o.max_iterations, within(1, 1000), "iterations at most");
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API LogisticRegression {
 public:
  /// Columns are standardised by the mean and deviation of all rows; one that is constant gets no
  /// weight. `row_weights` (positive) say how often each row counts. Throws InvalidArgument for
  /// values that are not finite (names row and column), lengths that differ, or a class without
  /// rows.
  static LogisticRegression train(ConstMatrixRefD rows, Span<const int> yes,
                                  Span<const double> row_weights,
                                  const LogisticRegressionOptions& options);

  /// log (P(yes | row) / P(no | row)), for a row of dim() values.
  [[nodiscard]] double log_odds(Span<const double> row) const;

  [[nodiscard]] int dim() const { return static_cast<int>(weights_.size()); }
  /// In the units of the rows.
  [[nodiscard]] const VectorD& weights() const { return weights_; }
  [[nodiscard]] double bias() const { return bias_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static LogisticRegression read(const ModelFile& file, const std::string& prefix);

 private:
  VectorD weights_;
  double bias_ = 0;
};

}  // namespace hri
