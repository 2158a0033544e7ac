// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Least-squares support vector machines with a radial kernel, one class against the rest: every
// training row is a support vector, and its weight solves one linear system (Suykens and
// Vandewalle, "Least squares support vector machine classifiers", Neural Processing Letters 1999).
#pragma once

#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct RbfClassifierOptions {
  double cost = 10;
  double sharpness = 1.5;
  StopCheck should_stop;

  static constexpr const char* kName = "RbfClassifierOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("cost", o.cost, above(0, 1e12),
      "of a squared error, against the weights: larger fits more closely");
    v("sharpness", o.sharpness, above(0, 1e6),
      "the kernel is exp(-sharpness) at the root mean square distance of the training rows");
  }
};

/// Where a row lies by the training rows of one class.
struct RbfPlace {
  float nearest = 0;  ///< mean squared distance to the three nearest rows of the class, against the
                      ///< median of what its own rows have to their three nearest
  float centre = 0;   ///< squared distance to the mean of the class, against the mean squared
                      ///< distance of all training rows
  float agreement = 0;  ///< share of the class among the nearest rows of any class: twenty, or as
                        ///< many as the class has
};

/// Immutable; const calls are safe from several threads. It keeps its training rows.
class HRI_API RbfClassifier {
 public:
  /// `classes[r]` in 0..num_classes - 1 is the class of row r. Time grows with the cube of the
  /// rows, memory with the square. Throws InvalidArgument for rows not finite, a class without a
  /// row (names it), fewer than two classes, or more than 20000 rows; Interrupted when asked to
  /// stop.
  static RbfClassifier train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                             const RbfClassifierOptions& options);

  /// With one class more, of number `index`: trained anew on the rows that it keeps and on these.
  /// As those of few samples lie closer together than others will, what is usual in the new class
  /// is at least the median of the other classes. Throws as train does, and for another width or an
  /// index out of range.
  [[nodiscard]] RbfClassifier with_class(int index, ConstMatrixRefF rows,
                                         const RbfClassifierOptions& options) const;

  /// Value of every class for one row, shape (num_classes,): near 1 for its own, near -1 for
  /// others.
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;

  /// Where a row lies by the training rows of class `klass`.
  [[nodiscard]] RbfPlace place(Span<const float> row, int klass) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(rows_.cols()); }
  [[nodiscard]] int num_rows() const { return static_cast<int>(rows_.rows()); }

  void write(ModelFile& file, const std::string& prefix) const;
  static RbfClassifier read(const ModelFile& file, const std::string& prefix);

 private:
  RbfClassifier() = default;
  // Of a row of squared length `square` to training row r.
  [[nodiscard]] float squared_distance(const float* row, float square, Eigen::Index r) const;
  [[nodiscard]] VectorF squared_distances(Span<const float> row) const;

  MatrixF rows_;
  VectorF squares_;    // of the rows' lengths; empty where these are too large to be of use
  VectorF classes_;    // of the rows
  MatrixF weights_;    // (num_classes, num_rows)
  VectorF usual_;      // of every class: median of the mean of three nearest squared distances
  VectorF variances_;  // of every class: mean squared distance of its rows to their mean
  double spread_ = 1;  // mean squared distance of the training rows
  double sharpness_ = 1;
};

}  // namespace hri
