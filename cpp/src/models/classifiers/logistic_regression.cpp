// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/logistic_regression.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kConstant = 1e-12;   // deviation below which a column counts as constant
constexpr double kConverged = 1e-10;  // largest step that still counts

void check(ConstMatrixRefD rows, Span<const int> yes, Span<const double> row_weights,
           const LogisticRegressionOptions& options) {
  validate(options);
  require(rows.rows() == static_cast<Eigen::Index>(yes.size()) &&
              yes.size() == row_weights.size() && rows.cols() > 0,
          "rows, yes and row_weights differ in length");
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    for (Eigen::Index c = 0; c < rows.cols(); ++c) {
      if (!std::isfinite(rows(r, c))) {
        fail(ErrorKind::invalid_argument,
             "row " + std::to_string(r) + ", column " + std::to_string(c) + " is not finite");
      }
    }
  }
  for (const double w : row_weights)
    require(w > 0 && std::isfinite(w), "row_weights must be positive");
  const auto positive = std::count_if(yes.begin(), yes.end(), [](int y) { return y != 0; });
  require(positive > 0 && positive < static_cast<std::ptrdiff_t>(yes.size()),
          "both classes need rows");
}

// log(1 + exp(x)) without overflow.
using detail::softplus;

// A penalised fit on standardised columns, of which the last is 1 for the bias.
class Newton {
 public:
  Newton(const MatrixD& columns, Span<const int> yes, Span<const double> weights, double penalty)
      : columns_(columns), yes_(yes), weights_(weights) {
    penalty_ = VectorD::Constant(columns.cols(), penalty);
    penalty_[columns.cols() - 1] = 1e-9;  // holds the bias finite where classes are far apart
  }

  [[nodiscard]] double loss(const VectorD& w) const {
    const VectorD x = columns_ * w;
    double sum = 0.5 * (penalty_.array() * w.array().square()).sum();
    for (Eigen::Index r = 0; r < x.size(); ++r) {
      const auto i = static_cast<std::size_t>(r);
      sum += weights_[i] * softplus(yes_[i] != 0 ? -x[r] : x[r]);
    }
    return sum;
  }

  [[nodiscard]] VectorD step(const VectorD& w) const {
    const VectorD x = columns_ * w;
    VectorD residual(x.size());
    VectorD curvature(x.size());
    for (Eigen::Index r = 0; r < x.size(); ++r) {
      const auto i = static_cast<std::size_t>(r);
      const double p = 1.0 / (1.0 + std::exp(-x[r]));
      residual[r] = weights_[i] * (p - (yes_[i] != 0 ? 1.0 : 0.0));
      curvature[r] = weights_[i] * p * (1.0 - p);
    }
    const VectorD gradient =
        columns_.transpose() * residual + (penalty_.array() * w.array()).matrix();
    MatrixD hessian = columns_.transpose() * curvature.asDiagonal() * columns_;
    hessian.diagonal() += penalty_;
    return hessian.ldlt().solve(gradient);
  }

 private:
  const MatrixD& columns_;
  Span<const int> yes_;
  Span<const double> weights_;
  VectorD penalty_;
};

}  // namespace

LogisticRegression LogisticRegression::train(ConstMatrixRefD rows, Span<const int> yes,
                                             Span<const double> row_weights,
                                             const LogisticRegressionOptions& options) {
  check(rows, yes, row_weights, options);
  const Eigen::Index dim = rows.cols();
  const VectorD mean = rows.colwise().mean();
  MatrixD columns(rows.rows(), dim + 1);
  columns.leftCols(dim) = rows.rowwise() - mean.transpose();
  columns.col(dim).setOnes();
  VectorD scale(dim);
  for (Eigen::Index c = 0; c < dim; ++c) {
    const double deviation =
        std::sqrt(columns.col(c).squaredNorm() / static_cast<double>(rows.rows()));
    scale[c] = deviation > kConstant * (1.0 + std::abs(mean[c])) ? 1.0 / deviation : 0.0;
    columns.col(c) *= scale[c];
  }
  const Newton newton(columns, yes, row_weights, options.penalty);
  VectorD w = VectorD::Zero(dim + 1);
  double loss = newton.loss(w);
  for (int i = 0; i < options.max_iterations; ++i) {
    VectorD step = newton.step(w);
    // Far from the optimum a whole step can overshoot; half of it, or less, does not.
    double next = newton.loss(w - step);
    for (int halved = 0; halved < 30 && !(next <= loss); ++halved) {
      step *= 0.5;
      next = newton.loss(w - step);
    }
    if (!(next <= loss)) break;
    w -= step;
    loss = next;
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  LogisticRegression result;
  result.weights_ = w.head(dim).cwiseProduct(scale);
  result.bias_ = w[dim] - result.weights_.dot(mean);
  return result;
}

double LogisticRegression::log_odds(Span<const double> row) const {
  require(static_cast<Eigen::Index>(row.size()) == weights_.size(),
          "row must have as many values as the model");
  return std::inner_product(row.begin(), row.end(), weights_.data(), bias_);
}

void LogisticRegression::write(ModelFile& file, const std::string& prefix) const {
  file.set_vector(prefix + "weights", weights_);
  file.set_number(prefix + "bias", bias_);
}

LogisticRegression LogisticRegression::read(const ModelFile& file, const std::string& prefix) {
  LogisticRegression result;
  result.weights_ = file.vector_d(prefix + "weights");
  result.bias_ = file.number(prefix + "bias");
  return result;
}

}  // namespace hri
