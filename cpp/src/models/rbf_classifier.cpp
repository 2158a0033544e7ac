// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/rbf_classifier.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kMaxRows = 20000;
constexpr double kConstant = 1;  // of the kernel, in place of a bias

VectorF squared_lengths(const MatrixF& rows) { return rows.rowwise().squaredNorm(); }

}  // namespace

RbfClassifier RbfClassifier::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                   const RbfClassifierOptions& options) {
  validate_rows(rows, classes, num_classes);
  require(options.cost > 0, "cost must be positive");
  require(options.sharpness > 0, "sharpness must be positive");
  const Eigen::Index count = rows.rows();
  require(count <= kMaxRows, "rows must not be more than 20000");
  RbfClassifier model;
  model.rows_ = rows;
  model.squares_ = squared_lengths(model.rows_);
  model.sharpness_ = options.sharpness;
  Eigen::MatrixXd kernel(count, count);
  for (Eigen::Index r = 0; r < count; ++r) {
    poll(options.should_stop);
    for (Eigen::Index s = 0; s <= r; ++s) {
      const float product = dot(model.rows_.row(r).data(), model.rows_.row(s).data(), model.dim());
      const float square = model.squares_[r] + model.squares_[s] - 2 * product;
      kernel(r, s) = kernel(s, r) = r == s ? 0.0 : static_cast<double>(std::max(square, 0.0F));
    }
  }
  const double mean = kernel.sum() / static_cast<double>(count * count);
  model.spread_ = mean > 0 ? mean : 1.0;
  kernel = (kernel.array() * (-model.sharpness_ / model.spread_)).exp() + kConstant;
  kernel.diagonal().array() += 1.0 / options.cost;
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Constant(count, num_classes, -1.0);
  for (Eigen::Index r = 0; r < count; ++r) wanted(r, classes[static_cast<std::size_t>(r)]) = 1.0;
  poll(options.should_stop);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(kernel);
  model.weights_ = factors.solve(wanted).transpose().cast<float>();
  return model;
}

VectorF RbfClassifier::squared_distances(Span<const float> row) const {
  validate_row(row, dim());
  const float square = dot(row.data(), row.data(), dim());
  VectorF result(rows_.rows());
  for (Eigen::Index r = 0; r < rows_.rows(); ++r) {
    const float product = dot(row.data(), rows_.row(r).data(), dim());
    result[r] = std::max(square + squares_[r] - 2 * product, 0.0F);
  }
  return result;
}

VectorF RbfClassifier::decision_values(Span<const float> row) const {
  const auto scale = static_cast<float>(-sharpness_ / spread_);
  const VectorF kernel =
      (squared_distances(row).array() * scale).exp() + static_cast<float>(kConstant);
  return weights_ * kernel;
}

float RbfClassifier::nearness(Span<const float> row, int count) const {
  require(count >= 1, "count must be at least 1");
  VectorF squares = squared_distances(row);
  const auto used = std::min<Eigen::Index>(count, squares.size());
  std::partial_sort(squares.data(), squares.data() + used, squares.data() + squares.size());
  return squares.head(used).mean() / static_cast<float>(spread_);
}

void RbfClassifier::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "rows", rows_);
  file.set_matrix(prefix + "weights", weights_);
  file.set_number(prefix + "spread", spread_);
  file.set_number(prefix + "sharpness", sharpness_);
}

RbfClassifier RbfClassifier::read(const ModelFile& file, const std::string& prefix) {
  RbfClassifier model;
  model.rows_ = file.matrix_f(prefix + "rows");
  model.weights_ = file.matrix_f(prefix + "weights");
  model.spread_ = file.number(prefix + "spread");
  model.sharpness_ = file.number(prefix + "sharpness");
  if (model.rows_.size() == 0 || model.weights_.rows() < 2 ||
      model.weights_.cols() != model.rows_.rows()) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' does not fit rows");
  }
  for (const auto& [name, value] :
       {std::pair("spread", model.spread_), std::pair("sharpness", model.sharpness_)}) {
    if (!(value > 0) || !std::isfinite(value))
      fail(ErrorKind::format, file.name() + ": field '" + prefix + name + "' is out of range");
  }
  model.squares_ = squared_lengths(model.rows_);
  return model;
}

}  // namespace hri
