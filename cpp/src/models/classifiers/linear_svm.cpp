// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/linear_svm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
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

// Margins of training rows by a plane that changes.
class DirectMargins {
 public:
  DirectMargins(ConstMatrixRefF rows, float bias_feature, Hyperplane start)
      : rows_(rows), bias_feature_(bias_feature), plane_(std::move(start)) {
    plane_.bias /= bias_feature_;
  }
  [[nodiscard]] float of(std::size_t i) const {
    return dot(row(i), plane_.weights.data(), dim()) + plane_.bias * bias_feature_;
  }
  // Adds `step` times row i to the plane.
  void add(std::size_t i, float step) {
    add_scaled(row(i), step, dim(), plane_.weights.data());
    plane_.bias += step * bias_feature_;
  }
  [[nodiscard]] Hyperplane plane() const { return {plane_.weights, plane_.bias * bias_feature_}; }

 private:
  [[nodiscard]] const float* row(std::size_t i) const {
    return rows_.data() + static_cast<Eigen::Index>(i) * rows_.outerStride();
  }
  [[nodiscard]] int dim() const { return static_cast<int>(rows_.cols()); }

  ConstMatrixRefF rows_;
  float bias_feature_;
  Hyperplane plane_;
};

// The products of all rows with one another. A block of rows is multiplied with the table from its
// own place on, the rest is its mirror image: either way, products are added up in the same order.
MatrixF products_of(ConstMatrixRefF rows) {
  const detail::RowTable table(rows);
  const detail::RowLayout layout = table.layout();
  const Eigen::Index count = rows.rows();
  MatrixF products(count, table.padded_rows());
  for (Eigen::Index first = 0; first < count; first += detail::kRowBlock) {
    const detail::RowLayout rest{count - first, layout.dim, layout.values + first * layout.dim};
    const Eigen::Index now = std::min<Eigen::Index>(detail::kRowBlock, count - first);
    detail::row_kernels().dots(rows.data() + first * rows.outerStride(), rows.outerStride(), now,
                               rest, &products(first, first), products.cols());
    const Eigen::Index below = count - first - now;
    products.block(first + now, first, below, now) =
        products.block(first, first + now, now, below).transpose();
  }
  return products;
}

// The same where rows are longer than they are many: by their products, which all classes share,
// in steps as short as there are rows.
class ProductMargins {
 public:
  ProductMargins(ConstMatrixRefF rows, const MatrixF& products, float bias_feature,
                 Hyperplane start)
      : products_(products), direct_(rows, bias_feature, std::move(start)) {
    const auto count = static_cast<std::size_t>(rows.rows());
    steps_.assign(count, 0.0F);
    margins_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) margins_.push_back(direct_.of(i));
    bias_square_ = bias_feature * bias_feature;
  }
  [[nodiscard]] float of(std::size_t i) const { return margins_[i] + bias_margin_; }
  void add(std::size_t i, float step) {
    add_scaled(products_.row(static_cast<Eigen::Index>(i)).data(), step,
               static_cast<int>(margins_.size()), margins_.data());
    bias_margin_ += step * bias_square_;
    steps_[i] += step;
  }
  [[nodiscard]] Hyperplane plane() const {
    DirectMargins result = direct_;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i] != 0) result.add(i, steps_[i]);
    }
    return result.plane();
  }

 private:
  const MatrixF& products_;
  DirectMargins direct_;  // of the plane at the start
  float bias_square_ = 1;
  float bias_margin_ = 0;  // what the bias adds to all
  std::vector<float> margins_;
  std::vector<float> steps_;
};

// One class against the rest, by the plane that is nearest to that of `margins`. Algorithm 1 of the
// paper for the L2 loss: D_ii = 1 / (2 C), no upper bound on alpha. The paper begins at zero; from
// another plane the same steps minimise the distance to that one in place of the length of the
// weights.
template <class Margins>
Hyperplane separate(ConstMatrixRefF rows, Span<const int> classes, int positive,
                    const LinearSvmOptions& options, Margins margins) {
  const Eigen::Index count = rows.rows();
  const double diagonal = 0.5 / options.cost;
  std::vector<double> alpha(static_cast<std::size_t>(count), 0.0);
  std::vector<double> curvature(alpha.size());
  for (Eigen::Index r = 0; r < count; ++r) {
    curvature[static_cast<std::size_t>(r)] = static_cast<double>(rows.row(r).squaredNorm()) +
                                             options.bias_feature * options.bias_feature + diagonal;
  }
  std::vector<std::size_t> order(alpha.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(options.seed + static_cast<std::uint64_t>(positive));
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    poll(options.should_stop);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    double highest = -std::numeric_limits<double>::infinity();
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
      const float y = classes[i] == positive ? 1.0F : -1.0F;
      const auto margin = static_cast<double>(margins.of(i));
      const double gradient = static_cast<double>(y) * margin - 1.0 + diagonal * alpha[i];
      const double projected = alpha[i] == 0.0 ? std::min(gradient, 0.0) : gradient;
      highest = std::max(highest, projected);
      lowest = std::min(lowest, projected);
      if (projected == 0.0) continue;
      const double updated = std::max(alpha[i] - gradient / curvature[i], 0.0);
      margins.add(i, y * static_cast<float>(updated - alpha[i]));
      alpha[i] = updated;
    }
    if (highest - lowest < options.tolerance) break;
  }
  return margins.plane();
}

// Every class against the rest, from planes to start with, which the result takes the place of.
void separate_all(ConstMatrixRefF rows, Span<const int> classes, const LinearSvmOptions& options,
                  MatrixF* weights, VectorF* biases) {
  const auto bias_feature = static_cast<float>(options.bias_feature);
  const bool wide = rows.rows() < rows.cols();
  const MatrixF products = wide ? products_of(rows) : MatrixF();
  for (Eigen::Index c = 0; c < weights->rows(); ++c) {
    Hyperplane start{weights->row(c).transpose(), (*biases)[c]};
    const auto positive = static_cast<int>(c);
    const Hyperplane h =
        wide ? separate(rows, classes, positive, options,
                        ProductMargins(rows, products, bias_feature, std::move(start)))
             : separate(rows, classes, positive, options,
                        DirectMargins(rows, bias_feature, std::move(start)));
    weights->row(c) = h.weights.transpose();
    (*biases)[c] = h.bias;
  }
}

}  // namespace

LinearSvm LinearSvm::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                           const LinearSvmOptions& options) {
  validate_rows(rows, classes, num_classes, kNoClass);
  validate(options);
  MatrixF weights = MatrixF::Zero(num_classes, rows.cols());
  VectorF biases = VectorF::Zero(num_classes);
  separate_all(rows, classes, options, &weights, &biases);
  return {std::move(weights), std::move(biases)};
}

LinearSvm LinearSvm::with_class(int index, ConstMatrixRefF rows, Span<const int> classes,
                                const LinearSvmOptions& options) const {
  require(index >= 0 && index <= num_classes(), "index must be a class or the next one");
  validate_width(rows, dim());
  validate_rows(rows, classes, num_classes() + 1, kNoClass);
  validate(options);
  MatrixF weights = MatrixF::Zero(num_classes() + 1, dim());
  VectorF biases = VectorF::Zero(num_classes() + 1);
  for (int old = 0; old < num_classes(); ++old) {
    const int c = old < index ? old : old + 1;
    weights.row(c) = weights_.row(old);
    biases[c] = biases_[old];
  }
  separate_all(rows, classes, options, &weights, &biases);
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
