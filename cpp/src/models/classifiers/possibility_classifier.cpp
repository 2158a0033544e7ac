// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/possibility_classifier.hpp"

#include <cmath>
#include <utility>

namespace hri {

PossibilityClassifier::PossibilityClassifier(GaussianBayes densities)
    : densities_(std::move(densities)) {}

PossibilityClassifier PossibilityClassifier::train(ConstMatrixRefF rows, Span<const int> classes,
                                                   int num_classes,
                                                   const GaussianBayesOptions& options) {
  return PossibilityClassifier(GaussianBayes::train(rows, classes, num_classes, options));
}

Possibilities PossibilityClassifier::classify(Span<const float> row) const {
  return possibilities(densities_.log_densities(row));
}

VectorF PossibilityClassifier::decision_values(Span<const float> row) const {
  const VectorF log_densities = densities_.log_densities(row);
  const float top = log_densities.maxCoeff();
  if (log_densities.hasNaN() || !std::isfinite(top)) return VectorF::Zero(log_densities.size());
  return log_densities.array() - top;
}

void PossibilityClassifier::write(ModelFile& file, const std::string& prefix) const {
  densities_.write(file, prefix);
}

PossibilityClassifier PossibilityClassifier::read(const ModelFile& file,
                                                  const std::string& prefix) {
  return PossibilityClassifier(GaussianBayes::read(file, prefix));
}

}  // namespace hri
