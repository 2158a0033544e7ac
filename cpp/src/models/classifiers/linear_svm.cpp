// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/linear_svm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/simd.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"
#include "hri/models/row_checks.hpp"
#include "models/classifiers/row_kernels.hpp"

namespace hri {
namespace {

HRI_SIMD_CLONES
void add_scaled(const float* x, float scale, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += scale * x[i];
}

struct Hyperplane {
  VectorF weights;
  float bias = 0;
};

// One class against the rest, by the plane that is nearest to `h`. Algorithm 1 of the paper for the
// L2 loss: D_ii = 1 / (2 C), no upper bound on alpha. The paper begins at zero; from another plane
// the same steps minimise the distance to that one in place of the length of the weights.
Hyperplane separate(ConstMatrixRefF rows, Span<const int> classes, int positive,
                    const LinearSvmOptions& options, Hyperplane h) {
  const Eigen::Index count = rows.rows();
  const int dim = static_cast<int>(rows.cols());
  const auto bias_feature = static_cast<float>(options.bias_feature);
  const double diagonal = 0.5 / options.cost;
  std::vector<double> alpha(static_cast<std::size_t>(count), 0.0);
  std::vector<double> curvature(alpha.size());
  for (Eigen::Index r = 0; r < count; ++r) {
    curvature[static_cast<std::size_t>(r)] = static_cast<double>(rows.row(r).squaredNorm()) +
                                             options.bias_feature * options.bias_feature + diagonal;
  }
  std::vector<std::size_t> order(alpha.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  h.bias /= bias_feature;
  Random random(options.seed + static_cast<std::uint64_t>(positive));
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    poll(options.should_stop);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    double highest = -std::numeric_limits<double>::infinity();
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
      const float* x = rows.data() + static_cast<Eigen::Index>(i) * rows.outerStride();
      const float y = classes[i] == positive ? 1.0F : -1.0F;
      const double margin =
          static_cast<double>(dot(x, h.weights.data(), dim) + h.bias * bias_feature);
      const double gradient = static_cast<double>(y) * margin - 1.0 + diagonal * alpha[i];
      const double projected = alpha[i] == 0.0 ? std::min(gradient, 0.0) : gradient;
      highest = std::max(highest, projected);
      lowest = std::min(lowest, projected);
      if (projected == 0.0) continue;
      const double updated = std::max(alpha[i] - gradient / curvature[i], 0.0);
      const float step = y * static_cast<float>(updated - alpha[i]);
      alpha[i] = updated;
      add_scaled(x, step, dim, h.weights.data());
      h.bias += step * bias_feature;
    }
    if (highest - lowest < options.tolerance) break;
  }
  h.bias *= bias_feature;
  return h;
}

}  // namespace

LinearSvm LinearSvm::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                           const LinearSvmOptions& options) {
  validate_rows(rows, classes, num_classes, kNoClass);
  validate(options);
  MatrixF weights(num_classes, rows.cols());
  VectorF biases(num_classes);
  for (int c = 0; c < num_classes; ++c) {
    const Hyperplane h = separate(rows, classes, c, options, {VectorF::Zero(rows.cols()), 0});
    weights.row(c) = h.weights.transpose();
    biases[c] = h.bias;
  }
  return {std::move(weights), std::move(biases)};
}

LinearSvm LinearSvm::with_class(int index, ConstMatrixRefF rows, Span<const int> classes,
                                const LinearSvmOptions& options) const {
  require(index >= 0 && index <= num_classes(), "index must be a class or the next one");
  validate_width(rows, dim());
  validate_rows(rows, classes, num_classes() + 1, kNoClass);
  validate(options);
  MatrixF weights(num_classes() + 1, dim());
  VectorF biases(num_classes() + 1);
  for (int c = 0; c <= num_classes(); ++c) {
    Hyperplane before{VectorF::Zero(dim()), 0};
    const int old = c < index ? c : c - 1;
    if (c != index) before = {weights_.row(old).transpose(), biases_[old]};
    const Hyperplane h = separate(rows, classes, c, options, std::move(before));
    weights.row(c) = h.weights.transpose();
    biases[c] = h.bias;
  }
  return {std::move(weights), std::move(biases)};
}

void LinearSvm::margins(const float* row, float* out) const {
  for (int c = 0; c < num_classes(); ++c) {
    out[c] = dot(row, weights_.data() + static_cast<Eigen::Index>(c) * dim(), dim()) + biases_[c];
  }
}

VectorF LinearSvm::decision_values(Span<const float> row) const {
  validate_row(row, dim());
  VectorF result(num_classes());
  margins(row.data(), result.data());
  return result;
}

MatrixF LinearSvm::decision_values(ConstMatrixRefF rows) const {
  validate_width(rows, dim());
  validate_finite(rows, "rows");
  constexpr Eigen::Index kFewRows = 4;  // below, the table would take longer than it saves
  constexpr Eigen::Index kRowsAtOnce = 64;
  MatrixF values(rows.rows(), num_classes());
  if (rows.rows() < kFewRows) {
    for (Eigen::Index r = 0; r < rows.rows(); ++r)
      margins(rows.data() + r * rows.outerStride(), values.row(r).data());
    return values;
  }
  const detail::RowTable table(weights_);
  MatrixF products(std::min(kRowsAtOnce, rows.rows()), table.padded_rows());
  for (Eigen::Index first = 0; first < rows.rows(); first += kRowsAtOnce) {
    const Eigen::Index now = std::min(kRowsAtOnce, rows.rows() - first);
    detail::row_kernels().dots(rows.data() + first * rows.outerStride(), rows.outerStride(), now,
                               table.layout(), products.data(), products.cols());
    values.middleRows(first, now) =
        products.topLeftCorner(now, num_classes()).rowwise() + biases_.transpose();
  }
  return values;
}

void LinearSvm::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "weights", weights_);
  file.set_vector(prefix + "biases", biases_);
}

LinearSvm LinearSvm::read(const ModelFile& file, const std::string& prefix) {
  MatrixF weights = file.matrix_f(prefix + "weights");
  VectorF biases = file.vector_f(prefix + "biases");
  if (weights.rows() < 2 || weights.cols() < 1 || weights.rows() != biases.size()) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' does not fit biases");
  }
  return {std::move(weights), std::move(biases)};
}

}  // namespace hri
