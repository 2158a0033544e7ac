// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/gaussian_bayes.hpp"

#include <algorithm>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "models/classifiers/class_statistics.hpp"
#include "models/classifiers/row_kernels.hpp"

namespace hri {
namespace {

using detail::kLog2Pi;

}  // namespace

GaussianBayes GaussianBayes::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                   const GaussianBayesOptions& options) {
  validate(options);
  const detail::ClassStatistics statistics = detail::class_statistics(rows, classes, num_classes);
  const Eigen::Index dim = statistics.dim();
  GaussianBayes model;
  model.means_ = statistics.means;
  model.log_priors_ = (statistics.counts / statistics.counts.sum()).array().log();
  const bool shared = options.covariance == CovarianceKind::shared;
  const int num_covariances = shared ? 1 : num_classes;
  model.covariances_.resize(num_covariances * dim, dim);
  for (int k = 0; k < num_covariances; ++k) {
    MatrixD covariance = shared ? statistics.pooled() : statistics.covariance(k);
    if (options.covariance == CovarianceKind::diagonal)
      covariance = MatrixD(covariance.diagonal().asDiagonal());
    model.covariances_.middleRows(k * dim, dim) =
        detail::regularised(std::move(covariance), options.shrinkage, statistics.floor);
  }
  if (!model.finish())
    fail(ErrorKind::invalid_argument, "rows: a class has no positive definite covariance");
  return model;
}

bool GaussianBayes::finish() {
  const Eigen::Index n = dim();
  for (Eigen::Index at = 0; at < covariances_.rows(); at += n) {
    const detail::Whitening found = detail::whiten(covariances_.middleRows(at, n));
    if (!found.valid) return false;
    whitening_.push_back(std::make_shared<const detail::RowTable>(found.inverse));
    log_norms_.push_back(
        static_cast<float>(found.log_root + 0.5 * static_cast<double>(n) * kLog2Pi));
  }
  return true;
}

VectorF GaussianBayes::log_densities(Span<const float> row) const {
  validate_row(row, dim());
  return log_densities(Eigen::Map<const MatrixF>(row.data(), 1, dim())).row(0).transpose();
}

MatrixF GaussianBayes::log_densities(ConstMatrixRefF rows) const {
  validate_width(rows, dim());
  validate_finite(rows, "rows");
  constexpr Eigen::Index kRowsAtOnce = 64;
  const detail::RowKernels& kernels = detail::row_kernels();
  MatrixF centred(std::min(kRowsAtOnce, rows.rows()), dim());
  MatrixF white(centred.rows(), whitening_[0]->padded_rows());
  MatrixF result(rows.rows(), num_classes());
  for (Eigen::Index first = 0; first < rows.rows(); first += kRowsAtOnce) {
    const Eigen::Index now = std::min(kRowsAtOnce, rows.rows() - first);
    for (int c = 0; c < num_classes(); ++c) {
      const std::size_t k = whitening_.size() == 1 ? 0 : static_cast<std::size_t>(c);
      centred.topRows(now) = rows.middleRows(first, now).rowwise() - means_.row(c).cast<float>();
      kernels.project(centred.data(), centred.cols(), now, whitening_[k]->layout(), white.data(),
                      white.cols());
      for (Eigen::Index r = 0; r < now; ++r) {
        const float distance = kernels.squared_norm(white.row(r).data(), dim());
        result(first + r, c) = -0.5F * distance - log_norms_[k];
      }
    }
  }
  return result;
}

VectorF GaussianBayes::decision_values(Span<const float> row) const {
  return log_densities(row) + log_priors_.cast<float>();
}

MatrixF GaussianBayes::decision_values(ConstMatrixRefF rows) const {
  return log_densities(rows).rowwise() + log_priors_.transpose().cast<float>();
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
