// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Classes by possibility: Gaussian class densities divided by the largest (thesis eq. 5.14-5.15).
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/possibility/possibility.hpp"

namespace hri {

/// Unlike GaussianBayes it knows no priors: how often a class was trained has no say. Immutable;
/// const calls are safe from several threads.
class HRI_API PossibilityClassifier {
 public:
  /// Throws InvalidArgument as validate_rows does.
  static PossibilityClassifier train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                     const GaussianBayesOptions& options);

  /// Possibility of every class, 0..1 with the largest 1, and its necessity: 1 - the largest
  /// possibility of another class. A row whose best class has little necessity is better rejected.
  [[nodiscard]] Possibilities classify(Span<const float> row) const;

  /// log possibility, natural log, 0 for the best class, shape (num_classes,); 0 for all
  /// where the row lies so far away that every density is 0.
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;

  [[nodiscard]] int num_classes() const { return densities_.num_classes(); }
  [[nodiscard]] int dim() const { return densities_.dim(); }

  void write(ModelFile& file, const std::string& prefix) const;
  static PossibilityClassifier read(const ModelFile& file, const std::string& prefix);

 private:
  explicit PossibilityClassifier(GaussianBayes densities);

  GaussianBayes densities_;
};

}  // namespace hri
