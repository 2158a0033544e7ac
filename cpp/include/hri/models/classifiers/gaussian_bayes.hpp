// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Bayes classifier with one Gaussian a class (thesis eq. 5.15 and 6.15).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

namespace detail {
class RowTable;
}

enum class CovarianceKind : std::uint8_t {
  shared,    ///< one covariance for all classes: linear boundaries (LDA)
  full,      ///< one a class
  diagonal,  ///< one diagonal a class
};
constexpr auto enum_names(CovarianceKind) { return std::array{"shared", "full", "diagonal"}; }

struct GaussianBayesOptions {
  CovarianceKind covariance = CovarianceKind::shared;
  double shrinkage = 0.1;

  static constexpr const char* kName = "GaussianBayesOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("covariance", o.covariance, any_value, "covariances of the classes");
    v("shrinkage", o.shrinkage, within(0, 1),
      "share of the covariance that is replaced by its mean variance times the identity");
  }
};

/// Immutable; const calls are safe from several threads. Class priors are the shares of the
/// training rows.
class HRI_API GaussianBayes {
 public:
  /// A class with one row takes the covariance shared by all. Throws InvalidArgument as
  /// validate_rows does.
  static GaussianBayes train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                             const GaussianBayesOptions& options);

  /// log P(class) + log p(row | class), natural log, shape (num_classes,); the posterior is its
  /// softmax.
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;
  /// log p(row | class) alone, from which possibilities follow.
  [[nodiscard]] VectorF log_densities(Span<const float> row) const;
  /// The same for many rows, a row each, equal to the bit and faster than one by one.
  [[nodiscard]] MatrixF decision_values(ConstMatrixRefF rows) const;
  [[nodiscard]] MatrixF log_densities(ConstMatrixRefF rows) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(means_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(means_.cols()); }

  void write(ModelFile& file, const std::string& prefix) const;
  static GaussianBayes read(const ModelFile& file, const std::string& prefix);

 private:
  // Fills what scoring needs; false where a covariance is not positive definite.
  bool finish();

  MatrixD means_;        // (num_classes, dim)
  MatrixD covariances_;  // (num_covariances * dim, dim): one for all classes, or one a class
  VectorD log_priors_;
  // From finish(): whitening matrices L^-1 of each covariance, and log sqrt(|2 pi S|).
  std::vector<std::shared_ptr<const detail::RowTable>> whitening_;
  std::vector<float> log_norms_;
};

}  // namespace hri
