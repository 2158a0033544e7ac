// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/distances.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "hri/core/error.hpp"

namespace hri {
namespace {

double bhattacharyya(Span<const float> a, Span<const float> b) {
  double sum_a = 0;
  double sum_b = 0;
  double overlap = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i] >= 0) || !(b[i] >= 0)) {
      fail(ErrorKind::invalid_argument,
           "bhattacharyya: histograms must be >= 0, not so at index " + std::to_string(i));
    }
    sum_a += static_cast<double>(a[i]);
    sum_b += static_cast<double>(b[i]);
    overlap += std::sqrt(static_cast<double>(a[i]) * static_cast<double>(b[i]));
  }
  require(sum_a > 0 && sum_b > 0, "bhattacharyya: a histogram is empty");
  // Rounding may lift the overlap of equal histograms above 1.
  return std::max(0.0, -std::log(overlap / std::sqrt(sum_a * sum_b)));
}

double cosine(Span<const float> a, Span<const float> b) {
  double dot = 0;
  double norm_a = 0;
  double norm_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    dot += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    norm_a += static_cast<double>(a[i]) * static_cast<double>(a[i]);
    norm_b += static_cast<double>(b[i]) * static_cast<double>(b[i]);
  }
  if (norm_a == 0 || norm_b == 0) return 1.0;
  return 1.0 - dot / std::sqrt(norm_a * norm_b);
}

// log det of a positive definite matrix from its Cholesky factor.
double log_det(const Eigen::LLT<Eigen::MatrixXd>& factor, const char* name) {
  if (factor.info() != Eigen::Success) {
    fail(ErrorKind::invalid_argument, std::string(name) + " is not positive definite");
  }
  return 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
}

}  // namespace

double distance(Distance kind, Span<const float> a, Span<const float> b) {
  if (a.size() != b.size()) {
    fail(ErrorKind::invalid_argument,
         "a has " + std::to_string(a.size()) + " values, b has " + std::to_string(b.size()));
  }
  if (kind == Distance::cosine) return cosine(a, b);
  if (kind == Distance::bhattacharyya) return bhattacharyya(a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += kind == Distance::manhattan ? std::abs(difference) : difference * difference;
  }
  return kind == Distance::manhattan ? sum : std::sqrt(sum);
}

double bhattacharyya_gaussian(const VectorD& mean_a, ConstMatrixRefD covariance_a,
                              const VectorD& mean_b, ConstMatrixRefD covariance_b) {
  const Eigen::Index n = mean_a.size();
  require(n > 0 && mean_b.size() == n && covariance_a.rows() == n && covariance_a.cols() == n &&
              covariance_b.rows() == n && covariance_b.cols() == n,
          "means and covariances must have one dimension");
  const Eigen::LLT<Eigen::MatrixXd> factor{Eigen::MatrixXd(0.5 * (covariance_a + covariance_b))};
  const double log_det_a =
      log_det(Eigen::LLT<Eigen::MatrixXd>{Eigen::MatrixXd(covariance_a)}, "covariance_a");
  const double log_det_b =
      log_det(Eigen::LLT<Eigen::MatrixXd>{Eigen::MatrixXd(covariance_b)}, "covariance_b");
  const double log_det_mean = log_det(factor, "the mean covariance");
  const VectorD whitened = factor.matrixL().solve(mean_a - mean_b);
  return 0.125 * whitened.squaredNorm() + 0.5 * (log_det_mean - 0.5 * (log_det_a + log_det_b));
}

}  // namespace hri
