// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The class whose mean is nearest (thesis section 6.2.6 and table 6.5: Euclidean, Manhattan,
// Bhattacharyya; Mahalanobis as in chapter 4).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

enum class ClassDistance : std::uint8_t {
  euclidean,
  manhattan,
  mahalanobis,    ///< by the covariance within all classes
  bhattacharyya,  ///< between the Gaussian of the class and one about the row that has the
                  ///< covariance within all classes
};
constexpr auto enum_names(ClassDistance) {
  return std::array{"euclidean", "manhattan", "mahalanobis", "bhattacharyya"};
}

struct DistanceClassifierOptions {
  ClassDistance metric = ClassDistance::euclidean;
  double shrinkage = 0.1;

  static constexpr const char* kName = "DistanceClassifierOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("metric", o.metric, any_value, "distance of a row from a class");
    v("shrinkage", o.shrinkage, within(0, 1),
      "share of each covariance that is replaced by its mean variance times the identity "
      "(mahalanobis, bhattacharyya)");
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API DistanceClassifier {
 public:
  /// A class with one row takes the covariance within all. Throws InvalidArgument as validate_rows
  /// does.
  static DistanceClassifier train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                  const DistanceClassifierOptions& options);

  /// The negative distance to every class, shape (num_classes,).
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(means_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(means_.cols()); }

  void write(ModelFile& file, const std::string& prefix) const;
  static DistanceClassifier read(const ModelFile& file, const std::string& prefix);

 private:
  [[nodiscard]] Eigen::Index num_covariances() const;
  // Fills what scoring needs; false where a covariance is not positive definite.
  bool finish();

  ClassDistance metric_ = ClassDistance::euclidean;
  MatrixF means_;        // (num_classes, dim)
  MatrixD covariances_;  // mahalanobis: the one within classes; bhattacharyya: that after every
                         // class's own
  // From finish(): L^-1 of the covariance to measure by, and what the difference of the covariances
  // alone makes of the distance.
  std::vector<MatrixF> whitening_;
  std::vector<float> offsets_;
};

}  // namespace hri
