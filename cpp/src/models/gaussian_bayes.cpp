// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/gaussian_bayes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr double kFloorShare = 1e-9;  // of the mean variance of all rows
constexpr double kLog2Pi = 1.8378770664093454835606594728112;

// Shrinks towards a sphere. The floor keeps constant features and tiny classes invertible whatever
// the option says.
MatrixD regularised(MatrixD covariance, double shrinkage, double floor) {
  const double mean_variance = covariance.trace() / static_cast<double>(covariance.rows());
  covariance *= 1.0 - shrinkage;
  covariance.diagonal().array() += shrinkage * mean_variance + floor;
  return covariance;
}

// Sum of squared deviations of every class from its mean, (num_classes * dim, dim).
MatrixD scatter_of(ConstMatrixRefF rows, Span<const int> classes, const MatrixD& means) {
  const Eigen::Index dim = rows.cols();
  MatrixD scatter = MatrixD::Zero(means.rows() * dim, dim);
  for (Eigen::Index c = 0; c < means.rows(); ++c) {
    std::vector<Eigen::Index> members;
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      if (classes[static_cast<std::size_t>(r)] == c) members.push_back(r);
    }
    MatrixD centred(static_cast<Eigen::Index>(members.size()), dim);
    for (std::size_t i = 0; i < members.size(); ++i) {
      centred.row(static_cast<Eigen::Index>(i)) =
          rows.row(members[i]).cast<double>() - means.row(c);
    }
    scatter.middleRows(c * dim, dim).noalias() = centred.transpose() * centred;
  }
  return scatter;
}

}  // namespace

GaussianBayes GaussianBayes::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                   const GaussianBayesOptions& options) {
  validate_rows(rows, classes, num_classes);
  require(options.shrinkage >= 0 && options.shrinkage <= 1, "shrinkage must lie in 0..1");
  const Eigen::Index dim = rows.cols();
  GaussianBayes model;
  model.means_ = MatrixD::Zero(num_classes, dim);
  VectorD counts = VectorD::Zero(num_classes);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const int c = classes[static_cast<std::size_t>(r)];
    model.means_.row(c) += rows.row(r).cast<double>();
    counts[c] += 1;
  }
  for (int c = 0; c < num_classes; ++c) model.means_.row(c) /= counts[c];
  model.log_priors_ = (counts / counts.sum()).array().log();

  const MatrixD scatter = scatter_of(rows, classes, model.means_);
  MatrixD pooled = MatrixD::Zero(dim, dim);
  for (int c = 0; c < num_classes; ++c) pooled += scatter.middleRows(c * dim, dim);
  pooled /= counts.sum();
  const VectorD spread = (rows.cast<double>().rowwise() - rows.cast<double>().colwise().mean())
                             .colwise()
                             .squaredNorm();
  const double floor = kFloorShare * spread.mean() / counts.sum() + 1e-12;

  const bool shared = options.covariance == CovarianceKind::shared;
  const int num_covariances = shared ? 1 : num_classes;
  model.covariances_.resize(num_covariances * dim, dim);
  for (int k = 0; k < num_covariances; ++k) {
    const bool own = !shared && counts[k] > 1;  // one row has no spread of its own
    MatrixD covariance = own ? MatrixD(scatter.middleRows(k * dim, dim) / counts[k]) : pooled;
    if (options.covariance == CovarianceKind::diagonal)
      covariance = MatrixD(covariance.diagonal().asDiagonal());
    model.covariances_.middleRows(k * dim, dim) =
        regularised(std::move(covariance), options.shrinkage, floor);
  }
  if (!model.finish())
    fail(ErrorKind::invalid_argument, "rows: a class has no positive definite covariance");
  return model;
}

bool GaussianBayes::finish() {
  const Eigen::Index n = dim();
  for (Eigen::Index at = 0; at < covariances_.rows(); at += n) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky{Eigen::MatrixXd(covariances_.middleRows(at, n))};
    if (cholesky.info() != Eigen::Success) return false;
    const Eigen::MatrixXd inverse = cholesky.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
    whitening_.emplace_back(inverse.cast<float>());
    const double log_root = Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
    log_norms_.push_back(static_cast<float>(log_root + 0.5 * static_cast<double>(n) * kLog2Pi));
  }
  return true;
}

VectorF GaussianBayes::log_densities(Span<const float> row) const {
  validate_row(row, dim());
  const Eigen::Map<const VectorF> x(row.data(), dim());
  VectorF result(num_classes());
  for (int c = 0; c < num_classes(); ++c) {
    const std::size_t k = whitening_.size() == 1 ? 0 : static_cast<std::size_t>(c);
    const VectorF centred = x - means_.row(c).transpose().cast<float>();
    result[c] = -0.5F * (whitening_[k] * centred).squaredNorm() - log_norms_[k];
  }
  return result;
}

VectorF GaussianBayes::decision_values(Span<const float> row) const {
  return log_densities(row) + log_priors_.cast<float>();
}

void GaussianBayes::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "means", means_);
  file.set_matrix(prefix + "covariances", covariances_);
  file.set_vector(prefix + "log_priors", log_priors_);
}

GaussianBayes GaussianBayes::read(const ModelFile& file, const std::string& prefix) {
  GaussianBayes model;
  model.means_ = file.matrix_d(prefix + "means");
  model.covariances_ = file.matrix_d(prefix + "covariances");
  model.log_priors_ = file.vector_d(prefix + "log_priors");
  const Eigen::Index n = model.means_.cols();
  if (model.means_.rows() < 2 || n < 1 || model.covariances_.cols() != n ||
      (model.covariances_.rows() != n && model.covariances_.rows() != n * model.means_.rows()) ||
      model.log_priors_.size() != model.means_.rows()) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "means' does not fit covariances and log_priors");
  }
  if (!model.finish()) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "covariances' is not positive definite");
  }
  return model;
}

}  // namespace hri
