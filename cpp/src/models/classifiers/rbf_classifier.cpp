// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/rbf_classifier.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kMaxRows = 20000;
constexpr double kKernelConstant = 1;  // of the kernel, in place of a bias

constexpr Eigen::Index kNearest = 3;
constexpr Eigen::Index kMostNeighbours = 20;  // of any class

// |a|^2 + |b|^2 - 2 ab keeps too few digits in float where rows lie farther from zero than this
// many times from one another, both squared. Features of hands lie far below.
constexpr double kFar = 1000;

// Squared lengths of the rows; none where distances need the differences themselves.
VectorF squared_lengths(const MatrixF& rows) {
  const MatrixD all = rows.cast<double>();
  const Eigen::RowVectorXd mean = all.colwise().mean();
  const double variance =
      (all.rowwise() - mean).rowwise().squaredNorm().sum() / static_cast<double>(all.rows());
  if (mean.squaredNorm() > kFar * variance) return {};
  return rows.rowwise().squaredNorm();
}

// Mean of the kNearest lowest values; their order changes.
float mean_of_lowest(std::vector<float>* values) {
  const auto used = std::min<std::ptrdiff_t>(kNearest, static_cast<std::ptrdiff_t>(values->size()));
  std::partial_sort(values->begin(), values->begin() + used, values->end());
  return std::accumulate(values->begin(), values->begin() + used, 0.0F) / static_cast<float>(used);
}

// What is usual inside a class, by the squared distances of all rows.
struct Usual {
  float nearest = 0;
  float variance = 0;
};

Usual usual_of(const Eigen::MatrixXd& squares, const std::vector<Eigen::Index>& members) {
  Usual result;
  double sum = 0;
  std::vector<float> nearest;
  nearest.reserve(members.size());
  std::vector<float> others;
  for (const Eigen::Index r : members) {
    others.clear();
    for (const Eigen::Index s : members) {
      sum += squares(r, s);
      if (s != r) others.push_back(static_cast<float>(squares(r, s)));
    }
    if (!others.empty()) nearest.push_back(mean_of_lowest(&others));
  }
  // The mean squared distance to the mean is half that between rows, each with itself counted too.
  const auto count = static_cast<double>(members.size());
  result.variance = static_cast<float>(sum / (2 * count * count));
  if (!nearest.empty()) {
    const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
    std::nth_element(nearest.begin(), middle, nearest.end());
    result.nearest = *middle;
  }
  return result;
}

}  // namespace

RbfClassifier RbfClassifier::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                                   const RbfClassifierOptions& options) {
  validate_rows(rows, classes, num_classes);
  validate(options);
  const Eigen::Index count = rows.rows();
  require(count <= kMaxRows, "rows must not be more than 20000");
  RbfClassifier model;
  model.rows_ = rows;
  model.squares_ = squared_lengths(model.rows_);
  model.sharpness_ = options.sharpness;
  const auto square_of = [&](Eigen::Index r) {
    return model.squares_.size() > 0 ? model.squares_[r] : 0.0F;
  };
  Eigen::MatrixXd kernel(count, count);
  for (Eigen::Index r = 0; r < count; ++r) {
    poll(options.should_stop);
    for (Eigen::Index s = 0; s <= r; ++s) {
      const float square = model.squared_distance(model.rows_.row(r).data(), square_of(r), s);
      kernel(r, s) = kernel(s, r) = r == s ? 0.0 : static_cast<double>(square);
    }
  }
  const double mean = kernel.sum() / static_cast<double>(count * count);
  model.spread_ = mean > 0 ? mean : 1.0;
  model.classes_.resize(count);
  std::vector<std::vector<Eigen::Index>> members(static_cast<std::size_t>(num_classes));
  for (Eigen::Index r = 0; r < count; ++r) {
    const int c = classes[static_cast<std::size_t>(r)];
    model.classes_[r] = static_cast<float>(c);
    members[static_cast<std::size_t>(c)].push_back(r);
  }
  model.usual_.resize(num_classes);
  model.variances_.resize(num_classes);
  for (int c = 0; c < num_classes; ++c) {
    const Usual usual = usual_of(kernel, members[static_cast<std::size_t>(c)]);
    // A single row, or rows that are all alike, say nothing of how far others may lie.
    model.usual_[c] = usual.nearest > 0 ? usual.nearest : static_cast<float>(model.spread_);
    model.variances_[c] = usual.variance;
  }
  kernel = (kernel.array() * (-model.sharpness_ / model.spread_)).exp() + kKernelConstant;
  kernel.diagonal().array() += 1.0 / options.cost;
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Constant(count, num_classes, -1.0);
  for (Eigen::Index r = 0; r < count; ++r) wanted(r, classes[static_cast<std::size_t>(r)]) = 1.0;
  poll(options.should_stop);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(kernel);
  model.weights_ = factors.solve(wanted).transpose().cast<float>();
  return model;
}

RbfClassifier RbfClassifier::with_class(int index, ConstMatrixRefF rows,
                                        const RbfClassifierOptions& options) const {
  require(index >= 0 && index <= num_classes(), "index must be a class or the next one");
  validate_width(rows, dim());
  MatrixF all(rows_.rows() + rows.rows(), rows_.cols());
  all << rows_, rows;
  std::vector<int> classes(static_cast<std::size_t>(all.rows()), index);
  for (Eigen::Index r = 0; r < rows_.rows(); ++r) {
    const auto c = static_cast<int>(classes_[r]);
    classes[static_cast<std::size_t>(r)] = c < index ? c : c + 1;
  }
  RbfClassifier model = train(all, classes, num_classes() + 1, options);
  std::vector<float> usual(usual_.begin(), usual_.end());
  const auto middle = usual.begin() + static_cast<std::ptrdiff_t>(usual.size() / 2);
  std::nth_element(usual.begin(), middle, usual.end());
  model.usual_[index] = std::max(model.usual_[index], *middle);
  return model;
}

float RbfClassifier::squared_distance(const float* row, float square, Eigen::Index r) const {
  if (squares_.size() == 0)
    return (Eigen::Map<const Eigen::RowVectorXf>(row, dim()) - rows_.row(r)).squaredNorm();
  const float product = dot(row, rows_.row(r).data(), dim());
  return std::max(square + squares_[r] - 2 * product, 0.0F);
}

VectorF RbfClassifier::squared_distances(Span<const float> row) const {
  validate_row(row, dim());
  const float square = dot(row.data(), row.data(), dim());
  VectorF result(rows_.rows());
  for (Eigen::Index r = 0; r < rows_.rows(); ++r)
    result[r] = squared_distance(row.data(), square, r);
  return result;
}

VectorF RbfClassifier::decision_values(Span<const float> row) const {
  const auto scale = static_cast<float>(-sharpness_ / spread_);
  const VectorF kernel =
      (squared_distances(row).array() * scale).exp() + static_cast<float>(kKernelConstant);
  return weights_ * kernel;
}

RbfPlace RbfClassifier::place(Span<const float> row, int klass) const {
  require(klass >= 0 && klass < num_classes(), "klass must be one of the classes");
  const VectorF squares = squared_distances(row);
  std::vector<float> own;
  own.reserve(static_cast<std::size_t>(squares.size()));
  for (Eigen::Index r = 0; r < squares.size(); ++r) {
    if (classes_[r] == static_cast<float>(klass)) own.push_back(squares[r]);
  }
  const float mean = std::accumulate(own.begin(), own.end(), 0.0F) / static_cast<float>(own.size());
  RbfPlace place;
  const auto neighbours =
      std::min<Eigen::Index>(kMostNeighbours, static_cast<Eigen::Index>(own.size()));
  std::vector<float> nearest(squares.begin(), squares.end());
  std::nth_element(nearest.begin(), nearest.begin() + (neighbours - 1), nearest.end());
  const float reach = nearest[static_cast<std::size_t>(neighbours - 1)];
  const auto agreeing = std::count_if(own.begin(), own.end(), [&](float s) { return s <= reach; });
  place.agreement = std::min(static_cast<float>(agreeing) / static_cast<float>(neighbours), 1.0F);
  place.nearest = mean_of_lowest(&own) / usual_[klass];
  // |x - m|^2 is the mean of |x - x_i|^2 less the variance.
  place.centre = std::max(mean - variances_[klass], 0.0F) / static_cast<float>(spread_);
  return place;
}

void RbfClassifier::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "rows", rows_);
  file.set_matrix(prefix + "weights", weights_);
  file.set_vector(prefix + "classes", classes_);
  file.set_vector(prefix + "usual", usual_);
  file.set_vector(prefix + "variances", variances_);
  file.set_number(prefix + "spread", spread_);
  file.set_number(prefix + "sharpness", sharpness_);
}

RbfClassifier RbfClassifier::read(const ModelFile& file, const std::string& prefix) {
  RbfClassifier model;
  model.rows_ = file.matrix_f(prefix + "rows");
  model.weights_ = file.matrix_f(prefix + "weights");
  model.classes_ = file.vector_f(prefix + "classes");
  model.usual_ = file.vector_f(prefix + "usual");
  model.variances_ = file.vector_f(prefix + "variances");
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
  const auto refuse = [&](const char* field) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + field + "' does not fit weights");
  };
  const Eigen::Index num_classes = model.weights_.rows();
  if (model.usual_.size() != num_classes || !(model.usual_.minCoeff() > 0)) refuse("usual");
  if (model.variances_.size() != num_classes) refuse("variances");
  if (model.classes_.size() != model.rows_.rows()) refuse("classes");
  std::vector<bool> met(static_cast<std::size_t>(num_classes), false);
  for (const float c : model.classes_) {
    if (!(c >= 0 && c < static_cast<float>(num_classes)) || c != std::floor(c)) refuse("classes");
    met[static_cast<std::size_t>(c)] = true;
  }
  if (std::find(met.begin(), met.end(), false) != met.end()) refuse("classes");
  model.squares_ = squared_lengths(model.rows_);
  return model;
}

}  // namespace hri
