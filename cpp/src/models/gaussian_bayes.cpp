// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/gaussian_bayes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/models/linear_svm.hpp"

namespace hri {
namespace {

constexpr double kLog2Pi = 1.8378770664093454835606594728112;

// Shrinks towards a sphere; a share of the identity keeps classes with few rows invertible whatever the option says.
MatrixD regularised(MatrixD covariance, double shrinkage) {
  const double mean_variance = covariance.trace() / static_cast<double>(covariance.rows());
  covariance *= 1.0 - shrinkage;
  covariance.diagonal().array() += shrinkage * mean_variance + 1e-6 * mean_variance + 1e-12;
  return covariance;
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

  const bool shared = options.covariance == CovarianceKind::shared;
  const int num_covariances = shared ? 1 : num_classes;
  model.covariances_ = MatrixD::Zero(num_covariances * dim, dim);
  for (int k = 0; k < num_covariances; ++k) {
    std::vector<Eigen::Index> members;
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      if (shared || classes[static_cast<std::size_t>(r)] == k) members.push_back(r);
    }
    MatrixD centred(static_cast<Eigen::Index>(members.size()), dim);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const int c = classes[static_cast<std::size_t>(members[i])];
      centred.row(static_cast<Eigen::Index>(i)) = rows.row(members[i]).cast<double>() - model.means_.row(c);
    }
    MatrixD covariance = centred.transpose() * centred / static_cast<double>(members.size());
    if (options.covariance == CovarianceKind::diagonal) covariance = MatrixD(covariance.diagonal().asDiagonal());
    model.covariances_.middleRows(k * dim, dim) = regularised(std::move(covariance), options.shrinkage);
  }
  model.finish();
  return model;
}

void GaussianBayes::finish() {
  const Eigen::Index n = dim();
  for (Eigen::Index at = 0; at < covariances_.rows(); at += n) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky{Eigen::MatrixXd(covariances_.middleRows(at, n))};
    if (cholesky.info() != Eigen::Success) fail(ErrorKind::format, "a covariance is not positive definite");
    const Eigen::MatrixXd inverse = cholesky.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
    whitening_.emplace_back(inverse.cast<float>());
    const double log_root = Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
    log_norms_.push_back(static_cast<float>(log_root + 0.5 * static_cast<double>(n) * kLog2Pi));
  }
}

VectorF GaussianBayes::log_densities(Span<const float> row) const {
  require(row.size() == static_cast<std::size_t>(dim()), "row must have dim() values");
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
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "means' does not fit covariances and log_priors");
  }
  model.finish();
  return model;
}

Possibilities possibilities(const VectorF& log_densities) {
  require(log_densities.size() > 0, "log_densities must not be empty");
  Eigen::Index best = 0;
  const float top = log_densities.maxCoeff(&best);
  Possibilities result;
  result.possibility = (log_densities.array() - top).exp();
  result.necessity = VectorF::Zero(log_densities.size());
  float other = 0;
  for (Eigen::Index c = 0; c < log_densities.size(); ++c) {
    if (c != best) other = std::max(other, result.possibility[c]);
  }
  result.necessity[best] = 1.0F - other;
  return result;
}

}  // namespace hri
