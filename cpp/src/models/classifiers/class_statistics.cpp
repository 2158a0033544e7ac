// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/classifiers/class_statistics.hpp"

#include <Eigen/Cholesky>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "models/least_variance.hpp"

namespace hri::detail {
namespace {

constexpr double kFloorShare = 1e-9;  // of the mean variance of all rows

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

MatrixD ClassStatistics::pooled() const {
  MatrixD sum = MatrixD::Zero(dim(), dim());
  for (Eigen::Index c = 0; c < means.rows(); ++c) sum += scatter.middleRows(c * dim(), dim());
  return sum / counts.sum();
}

MatrixD ClassStatistics::covariance(int c) const {
  if (counts[c] < 2) return pooled();
  return scatter.middleRows(c * dim(), dim()) / counts[c];
}

ClassStatistics class_statistics(ConstMatrixRefF rows, Span<const int> classes, int num_classes) {
  validate_rows(rows, classes, num_classes);
  ClassStatistics result;
  result.means = MatrixD::Zero(num_classes, rows.cols());
  result.counts = VectorD::Zero(num_classes);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const int c = classes[static_cast<std::size_t>(r)];
    result.means.row(c) += rows.row(r).cast<double>();
    result.counts[c] += 1;
  }
  for (int c = 0; c < num_classes; ++c) result.means.row(c) /= result.counts[c];
  result.scatter = scatter_of(rows, classes, result.means);
  const VectorD mean = rows.cast<double>().colwise().mean().transpose();
  const VectorD spread = (rows.cast<double>().rowwise() - rows.cast<double>().colwise().mean())
                             .colwise()
                             .squaredNorm();
  result.floor = kFloorShare * spread.mean() / result.counts.sum() +
                 least_variance(mean, spread / result.counts.sum(), 1e-12);
  return result;
}

MatrixD regularised(MatrixD covariance, double shrinkage, double floor) {
  require(shrinkage >= 0 && shrinkage <= 1, "shrinkage must lie in 0..1");
  const double mean_variance = covariance.trace() / static_cast<double>(covariance.rows());
  covariance *= 1.0 - shrinkage;
  covariance.diagonal().array() += shrinkage * mean_variance + floor;
  return covariance;
}

Whitening whiten(ConstMatrixRefD covariance) {
  const Eigen::Index n = covariance.rows();
  const Eigen::LLT<Eigen::MatrixXd> cholesky{Eigen::MatrixXd(covariance)};
  if (cholesky.info() != Eigen::Success) return {};
  const Eigen::MatrixXd inverse = cholesky.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
  const double log_root = Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
  return {inverse.cast<float>(), log_root, true};
}

}  // namespace hri::detail
