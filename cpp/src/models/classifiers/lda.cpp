// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/lda.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

// Rows of the result have unit variance within classes, for directions that vary at all.
MatrixD whitening(const MatrixD& within) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(within);
  const double largest = solver.eigenvalues()[within.rows() - 1];
  const double negligible = 1e-12 * static_cast<double>(within.rows()) * largest;
  const Eigen::Index rank = (solver.eigenvalues().array() > negligible).count();
  require(largest > 0 && rank > 0, "rows do not vary within classes");
  return solver.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal() *
         solver.eigenvectors().rightCols(rank).transpose();
}

}  // namespace

Lda Lda::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
               const LdaOptions& options) {
  validate_rows(rows, classes, num_classes);
  validate(options);
  require(options.num_components < num_classes, "num_components must lie in 0..num_classes - 1");
  require(rows.rows() > num_classes, "rows must be more than classes");
  const Eigen::Index dim = rows.cols();
  const VectorD mean = rows.cast<double>().colwise().mean();
  MatrixD means = MatrixD::Zero(num_classes, dim);  // about the mean of all
  VectorD counts = VectorD::Zero(num_classes);
  MatrixD centred = rows.cast<double>().rowwise() - mean.transpose();
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const int c = classes[static_cast<std::size_t>(r)];
    means.row(c) += centred.row(r);
    counts[c] += 1;
  }
  means.array().colwise() /= counts.array();
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    centred.row(r) -= means.row(classes[static_cast<std::size_t>(r)]);
  MatrixD within = centred.transpose() * centred / static_cast<double>(rows.rows() - num_classes);
  const double mean_variance = within.trace() / static_cast<double>(dim);
  within *= 1 - options.shrinkage;
  within.diagonal().array() += options.shrinkage * mean_variance;

  const MatrixD white = whitening(within);
  const MatrixD projected = counts.cwiseSqrt().asDiagonal() * means * white.transpose();
  const Eigen::MatrixXd between =
      projected.transpose() * projected / static_cast<double>(num_classes - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(between);
  const int wanted = options.num_components > 0 ? options.num_components : num_classes - 1;
  const Eigen::Index count = std::min<Eigen::Index>(wanted, between.rows());
  Lda lda;
  lda.mean_ = mean.cast<float>();
  lda.components_.resize(count, dim);
  lda.ratios_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index from = between.rows() - 1 - i;  // eigenvalues rise
    VectorD direction = white.transpose() * solver.eigenvectors().col(from);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0) direction = -direction;
    lda.components_.row(i) = direction.cast<float>().transpose();
    lda.ratios_[i] = static_cast<float>(std::max(0.0, solver.eigenvalues()[from]));
  }
  return lda;
}

MatrixF Lda::transform(ConstMatrixRefF rows) const {
  if (rows.cols() != dim()) {
    fail(ErrorKind::invalid_argument, "rows have " + std::to_string(rows.cols()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  validate_finite(rows, "rows");
  return (rows.rowwise() - mean_.transpose()) * components_.transpose();
}

void Lda::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "components", components_);
  file.set_vector(prefix + "mean", mean_);
  file.set_vector(prefix + "ratios", ratios_);
}

Lda Lda::read(const ModelFile& file, const std::string& prefix) {
  Lda lda;
  lda.components_ = file.matrix_f(prefix + "components");
  lda.mean_ = file.vector_f(prefix + "mean");
  lda.ratios_ = file.vector_f(prefix + "ratios");
  if (lda.components_.size() == 0 || lda.mean_.size() != lda.dim() ||
      lda.ratios_.size() != lda.num_components()) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "components' does not fit mean and ratios");
  }
  return lda;
}

}  // namespace hri
