// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Linear support vector machines, one class against the rest, by dual coordinate descent on the
// squared hinge loss (Hsieh et al., "A dual coordinate descent method for large-scale linear SVM",
// ICML 2008).
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct LinearSvmOptions {
  double cost = 1.0;          ///< C > 0: larger fits the training rows more closely
  double bias_feature = 1.0;  ///< constant feature that carries the bias, > 0
  int max_iterations = 1000;  ///< passes over the rows, 1..1000000
  double tolerance = 1e-3;    ///< stop when the projected gradient's range falls below, > 0
  std::uint64_t seed = 0;     ///< of the order of the rows
  StopCheck should_stop;
};

/// Immutable; const calls are safe from several threads.
class HRI_API LinearSvm {
 public:
  /// `classes[r]` in 0..num_classes - 1 is the class of row r; -1 is a row that belongs to none and
  /// counts against every class. Throws InvalidArgument for rows not
  /// finite, a class without a row (names it), or fewer than two classes.
  static LinearSvm train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                         const LinearSvmOptions& options);

  /// Margin of every class for one row, shape (num_classes,).
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(weights_.cols()); }
  [[nodiscard]] const MatrixF& weights() const { return weights_; }
  [[nodiscard]] const VectorF& biases() const { return biases_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static LinearSvm read(const ModelFile& file, const std::string& prefix);

 private:
  LinearSvm(MatrixF weights, VectorF biases)
      : weights_(std::move(weights)), biases_(std::move(biases)) {}
  MatrixF weights_;
  VectorF biases_;
};

}  // namespace hri
