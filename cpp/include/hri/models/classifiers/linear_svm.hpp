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
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct LinearSvmOptions {
  double cost = 1.0;
  double bias_feature = 1.0;
  int max_iterations = 1000;
  double tolerance = 1e-3;
  std::uint64_t seed = 0;
  StopCheck should_stop;

  static constexpr const char* kName = "LinearSvmOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("cost", o.cost, above(0, 1e12), "C: larger fits the training rows more closely");
    v("bias_feature", o.bias_feature, above(0, 1e6), "constant feature that carries the bias");
    v("max_iterations", o.max_iterations, within(1, 1000000), "passes over the rows at most");
    v("tolerance", o.tolerance, above(0, 1e6),
      "training stops when the range of the projected gradient falls below");
    v("seed", o.seed, any_seed, "of the order of the rows");
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API LinearSvm {
 public:
  /// `classes[r]` in 0..num_classes - 1 is the class of row r; -1 is a row that belongs to none and
  /// counts against every class. Throws InvalidArgument for rows not
  /// finite, a class without a row (names it), or fewer than two classes.
  static LinearSvm train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                         const LinearSvmOptions& options);

  /// With one class more, of number `index`, where the rows that the others were trained on are
  /// not at hand: their planes move as little as separating `rows` asks for (adaptive support
  /// vector machines: Yang, Yan, Hauptmann, "Cross-domain video concept detection using adaptive
  /// SVMs", ACM Multimedia 2007). `classes` counts with the new one, and every class has a row.
  /// Throws InvalidArgument as train does, for another width, and an index out of range.
  [[nodiscard]] LinearSvm with_class(int index, ConstMatrixRefF rows, Span<const int> classes,
                                     const LinearSvmOptions& options) const;

  /// Margin of every class for one row, shape (num_classes,).
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;
  /// The same for many rows, a row each, equal to the bit and faster than one by one.
  [[nodiscard]] MatrixF decision_values(ConstMatrixRefF rows) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(weights_.cols()); }
  [[nodiscard]] const MatrixF& weights() const { return weights_; }
  [[nodiscard]] const VectorF& biases() const { return biases_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static LinearSvm read(const ModelFile& file, const std::string& prefix);

 private:
  LinearSvm(MatrixF weights, VectorF biases)
      : weights_(std::move(weights)), biases_(std::move(biases)) {}
  void margins(const float* row, float* out) const;
  MatrixF weights_;
  VectorF biases_;
};

}  // namespace hri
