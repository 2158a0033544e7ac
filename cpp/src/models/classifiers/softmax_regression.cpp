// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/softmax_regression.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/lbfgs.hpp"
#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr double kConstantColumn = 1e-6;  // deviation below which a column counts as constant
constexpr double kUsualDeviation = 1e-3;
constexpr double kLeastDeviation = 1e-37;  // the inverse of it is a float
constexpr double kTolerance = 1e-6;        // of the value, that an iteration has to gain

using Parameters = Eigen::Map<const MatrixD>;  // a row a class: weights, then the bias

// Minus the penalised log-likelihood of the labels of standardised rows.
class Loss {
 public:
  Loss(const MatrixF& rows, Span<const int> classes, int num_classes, double penalty)
      : rows_(rows), classes_(classes), num_classes_(num_classes), penalty_(penalty) {}

  double operator()(const VectorD& x, VectorD* gradient) const {
    const Eigen::Index dim = rows_.cols();
    const Parameters all(x.data(), num_classes_, dim + 1);
    const MatrixF weights = all.leftCols(dim).cast<float>();
    MatrixF scores = rows_ * weights.transpose();
    Eigen::Map<MatrixD> result(gradient->data(), num_classes_, dim + 1);
    double sum = 0.5 * penalty_ * all.leftCols(dim).squaredNorm();
    VectorD errors = VectorD::Zero(num_classes_);
    // From scores to what the probabilities are too large by.
    for (Eigen::Index r = 0; r < scores.rows(); ++r) {
      const int label = classes_[static_cast<std::size_t>(r)];
      VectorD row = scores.row(r).transpose().cast<double>() + all.col(dim);
      const double best = row.maxCoeff();
      row.array() -= best;
      const double own = row[label];
      row = row.array().exp();
      const double total = row.sum();
      sum += std::log(total) - own;
      row /= total;
      row[label] -= 1;
      errors += row;
      scores.row(r) = row.transpose().cast<float>();
    }
    const MatrixF slopes = scores.transpose() * rows_;
    result.leftCols(dim) = slopes.cast<double>() + penalty_ * all.leftCols(dim);
    result.col(dim) = errors;
    return sum;
  }

 private:
  const MatrixF& rows_;
  Span<const int> classes_;
  int num_classes_;
  double penalty_;
};

using detail::softplus;

// The same where one class is new: x are its weights, then its bias; `rivals` is the log of the sum
// over the other classes, of every row.
struct NewClassLoss {
  const MatrixD& rows;
  const VectorD& rivals;
  const VectorD& row_weights;
  Eigen::Index num_own;  // the first rows are of the new class
  double penalty;

  double operator()(const VectorD& x, VectorD* gradient) const {
    const Eigen::Index dim = rows.cols();
    const auto weights = x.head(dim);
    const VectorD odds = ((rows * weights - rivals).array() + x[dim]).matrix();
    VectorD errors(odds.size());
    double sum = 0.5 * penalty * weights.squaredNorm();
    for (Eigen::Index r = 0; r < odds.size(); ++r) {
      const bool own = r < num_own;
      sum += row_weights[r] * softplus(own ? -odds[r] : odds[r]);
      errors[r] = row_weights[r] * (1.0 / (1.0 + std::exp(-odds[r])) - (own ? 1.0 : 0.0));
    }
    gradient->head(dim) = rows.transpose() * errors + penalty * weights;
    (*gradient)[dim] = errors.sum();
    return sum;
  }
};

double log_sum_exp(const VectorF& scores) {
  const auto best = static_cast<double>(scores.maxCoeff());
  return best + std::log((scores.cast<double>().array() - best).exp().sum());
}

}  // namespace

MatrixF SoftmaxRegression::standardised(ConstMatrixRefF rows) const {
  require(rows.cols() == dim(), "the row does not fit the model");
  return (rows.rowwise() - mean_.transpose()) * scale_.asDiagonal();
}

SoftmaxRegression SoftmaxRegression::train(ConstMatrixRefF rows, Span<const int> classes,
                                           int num_classes, const SoftmaxRegressionOptions& options,
                                           const StopCheck& should_stop) {
  validate(options);
  validate_rows(rows, classes, num_classes);
  const Eigen::Index dim = rows.cols();
  const auto count = static_cast<double>(rows.rows());
  SoftmaxRegression result;
  const VectorD mean = rows.cast<double>().colwise().sum().transpose() / count;
  result.mean_ = mean.cast<float>();
  result.scale_.resize(dim);
  VectorD deviations(dim);
  for (Eigen::Index c = 0; c < dim; ++c) {
    deviations[c] =
        std::sqrt((rows.col(c).cast<double>().array() - mean[c]).square().sum() / count);
  }
  // 1, but less where all columns are in so small a unit that none varies by more.
  const double unit = std::min(1.0, deviations.maxCoeff() / kUsualDeviation);
  for (Eigen::Index c = 0; c < dim; ++c) {
    const double deviation = deviations[c];
    const bool constant =
        deviation <= std::max(kConstantColumn * (unit + std::abs(mean[c])), kLeastDeviation);
    result.scale_[c] = constant ? 0.0F : static_cast<float>(1.0 / deviation);
  }
  result.weights_ = MatrixF::Zero(num_classes, dim);
  const MatrixF standard = result.standardised(rows);
  const VectorD best = detail::minimise(Loss(standard, classes, num_classes, options.penalty),
                                        VectorD::Zero(num_classes * (dim + 1)),
                                        options.max_iterations, kTolerance, should_stop);
  const Parameters found(best.data(), num_classes, dim + 1);
  result.weights_ = found.leftCols(dim).cast<float>();
  result.bias_ = found.col(dim).cast<float>();
  return result;
}

SoftmaxRegression SoftmaxRegression::of(ConstMatrixRefF weights, const VectorF& bias) {
  require(weights.size() > 0 && bias.size() == weights.rows(), "the bias does not fit the weights");
  validate_finite(weights, "weights");
  validate_finite(bias.transpose(), "bias");
  SoftmaxRegression result;
  result.mean_ = VectorF::Zero(weights.cols());
  result.scale_ = VectorF::Ones(weights.cols());
  result.weights_ = weights;
  result.bias_ = bias;
  return result;
}

VectorF SoftmaxRegression::scores(Span<const float> row) const {
  require(static_cast<Eigen::Index>(row.size()) == weights_.cols(),
          "the row does not fit the model");
  const Eigen::Map<const VectorF> values(row.data(), static_cast<Eigen::Index>(row.size()));
  const VectorF standard = (values - mean_).cwiseProduct(scale_);
  VectorF result(weights_.rows());
  for (Eigen::Index c = 0; c < result.size(); ++c)
    result[c] = weights_.row(c).dot(standard) + bias_[c];
  return result;
}

SoftmaxRegression SoftmaxRegression::with_class(int index, ConstMatrixRefF rows,
                                                ConstMatrixRefF others, double rows_per_other,
                                                const SoftmaxRegressionOptions& options,
                                                const StopCheck& should_stop) const {
  validate(options);
  require(index >= 0 && index <= num_classes(), "the index of the class is out of range");
  require(rows.rows() > 0, "a class has no row");
  require(rows_per_other > 0, "rows_per_other must be positive");
  validate_finite(rows, "rows");
  validate_finite(others, "others");
  const Eigen::Index num_own = rows.rows();
  MatrixD all(num_own + others.rows(), dim());
  all.topRows(num_own) = standardised(rows).cast<double>();
  all.bottomRows(others.rows()) = standardised(others).cast<double>();
  VectorD rivals(all.rows());
  for (Eigen::Index r = 0; r < all.rows(); ++r)
    rivals[r] = log_sum_exp(weights_ * all.row(r).transpose().cast<float>() + bias_);
  VectorD row_weights = VectorD::Constant(all.rows(), rows_per_other);
  row_weights.head(num_own) /= static_cast<double>(num_own);
  const NewClassLoss loss{all, rivals, row_weights, num_own, options.penalty};
  const VectorD found = detail::minimise(loss, VectorD::Zero(dim() + 1), options.max_iterations,
                                         kTolerance, should_stop);
  SoftmaxRegression result = *this;
  const Eigen::Index after = weights_.rows() - index;
  result.weights_.resize(weights_.rows() + 1, weights_.cols());
  result.weights_ << weights_.topRows(index), found.head(dim()).cast<float>().transpose(),
      weights_.bottomRows(after);
  result.bias_.resize(bias_.size() + 1);
  result.bias_ << bias_.head(index), static_cast<float>(found[dim()]), bias_.tail(after);
  return result;
}

SoftmaxRegression SoftmaxRegression::without_class(int index) const {
  require(index >= 0 && index < num_classes(), "the index of the class is out of range");
  SoftmaxRegression result = *this;
  const Eigen::Index after = weights_.rows() - index - 1;
  result.weights_.resize(weights_.rows() - 1, weights_.cols());
  result.weights_ << weights_.topRows(index), weights_.bottomRows(after);
  result.bias_.resize(bias_.size() - 1);
  result.bias_ << bias_.head(index), bias_.tail(after);
  return result;
}

SoftmaxRegression SoftmaxRegression::moved(Span<const float> shift) const {
  require(static_cast<int>(shift.size()) == dim(), "the shift does not fit the model");
  SoftmaxRegression result = *this;
  result.mean_ += Eigen::Map<const VectorF>(shift.data(), static_cast<Eigen::Index>(shift.size()));
  return result;
}

void SoftmaxRegression::write(ModelFile& file, const std::string& prefix) const {
  file.set_vector(prefix + "mean", mean_);
  file.set_vector(prefix + "scale", scale_);
  file.set_matrix(prefix + "weights", weights_);
  file.set_vector(prefix + "bias", bias_);
}

SoftmaxRegression SoftmaxRegression::read(const ModelFile& file, const std::string& prefix) {
  SoftmaxRegression result;
  result.mean_ = file.vector_f(prefix + "mean");
  result.scale_ = file.vector_f(prefix + "scale");
  result.weights_ = file.matrix_f(prefix + "weights");
  result.bias_ = file.vector_f(prefix + "bias");
  const Eigen::Index dim = result.weights_.cols();
  if (result.weights_.size() == 0 || result.mean_.size() != dim || result.scale_.size() != dim ||
      result.bias_.size() != result.weights_.rows()) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "weights' does not fit mean, scale and bias");
  }
  return result;
}

}  // namespace hri
