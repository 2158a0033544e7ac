// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/pca.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {

Pca Pca::train(ConstMatrixRefF rows, int num_components) {
  require(rows.rows() > 0 && rows.cols() > 0, "training needs at least one row and column");
  require(num_components >= 1, "num_components must be at least 1");
  validate_finite(rows, "rows");
  Pca pca;
  const VectorD mean = rows.cast<double>().colwise().mean();
  const MatrixD centred = rows.cast<double>().rowwise() - mean.transpose();
  const bool few_rows = rows.rows() < rows.cols();
  // The smaller of covariance and Gram matrix has the same eigenvalues.
  const double scale = 1.0 / static_cast<double>(std::max<Eigen::Index>(1, rows.rows() - 1));
  const Eigen::MatrixXd square = few_rows ? Eigen::MatrixXd(centred * centred.transpose() * scale)
                                          : Eigen::MatrixXd(centred.transpose() * centred * scale);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(square);
  // Directions without variance are noise; one is kept for rows that are all alike.
  const double largest_variance = solver.eigenvalues()[square.rows() - 1];
  const double negligible = 1e-12 * static_cast<double>(square.rows()) * largest_variance;
  const Eigen::Index rank = (solver.eigenvalues().array() > negligible).count();
  const Eigen::Index count =
      std::max<Eigen::Index>(1, std::min<Eigen::Index>(num_components, rank));
  pca.mean_ = mean.cast<float>();
  pca.components_.resize(count, rows.cols());
  pca.variances_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index from = square.rows() - 1 - i;  // eigenvalues rise
    VectorD direction = few_rows ? VectorD(centred.transpose() * solver.eigenvectors().col(from))
                                 : VectorD(solver.eigenvectors().col(from));
    const double length = direction.norm();
    direction = length > 0 ? VectorD(direction / length) : VectorD(VectorD::Unit(rows.cols(), 0));
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0) direction = -direction;
    pca.components_.row(i) = direction.cast<float>().transpose();
    pca.variances_[i] = static_cast<float>(std::max(0.0, solver.eigenvalues()[from]));
  }
  return pca;
}

MatrixF Pca::transform(ConstMatrixRefF rows) const {
  if (rows.cols() != dim()) {
    fail(ErrorKind::invalid_argument, "rows have " + std::to_string(rows.cols()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  validate_finite(rows, "rows");
  return (rows.rowwise() - mean_.transpose()) * components_.transpose();
}

void Pca::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "components", components_);
  file.set_vector(prefix + "mean", mean_);
  file.set_vector(prefix + "variances", variances_);
}

Pca Pca::read(const ModelFile& file, const std::string& prefix) {
  Pca pca;
  pca.components_ = file.matrix_f(prefix + "components");
  pca.mean_ = file.vector_f(prefix + "mean");
  pca.variances_ = file.vector_f(prefix + "variances");
  if (pca.components_.size() == 0 || pca.mean_.size() != pca.dim() ||
      pca.variances_.size() != pca.num_components()) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "components' does not fit mean and variances");
  }
  return pca;
}

}  // namespace hri
