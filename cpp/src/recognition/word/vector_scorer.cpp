// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/vector_scorer.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kMaxClassWeight = 1e6;
constexpr double kMaxVectors = 1e9;
constexpr double kMaxPenalty = 1e12;

MatrixF stacked(const std::vector<MatrixF>& vectors, Eigen::Index columns) {
  MatrixF rows(static_cast<Eigen::Index>(vectors.size()), columns);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    require(vectors[i].rows() == 1 && vectors[i].cols() == columns, "vectors differ in size");
    rows.row(static_cast<Eigen::Index>(i)) = vectors[i];
  }
  return rows;
}

// Those of all lists, and the number of the list of each.
MatrixF stacked(const ClassSequences& lists, Eigen::Index columns, std::vector<int>* numbers) {
  std::vector<MatrixF> all;
  for (std::size_t c = 0; c < lists.size(); ++c) {
    all.insert(all.end(), lists[c].begin(), lists[c].end());
    numbers->insert(numbers->end(), lists[c].size(), static_cast<int>(c));
  }
  return stacked(all, columns);
}

VectorF mean_of(const std::vector<MatrixF>& vectors) {
  VectorD sum = VectorD::Zero(vectors.front().cols());
  for (const MatrixF& vector : vectors) sum += vector.row(0).transpose().cast<double>();
  return (sum / static_cast<double>(vectors.size())).cast<float>();
}

MatrixF means_of(const ClassSequences& lists, Eigen::Index columns) {
  MatrixF means(static_cast<Eigen::Index>(lists.size()), columns);
  for (std::size_t c = 0; c < lists.size(); ++c)
    means.row(static_cast<Eigen::Index>(c)) = mean_of(lists[c]).transpose();
  return means;
}

// A row among the discriminants, without the matrix products that Lda::transform() brings into
// programs that only recognise.
VectorF place_of(const Lda& lda, ConstMatrixRefF vector) {
  require(vector.rows() == 1 && vector.cols() == lda.dim(), "the vector does not fit the model");
  const VectorF off_mean = vector.row(0).transpose() - lda.mean();
  VectorF place(lda.num_components());
  for (Eigen::Index k = 0; k < place.size(); ++k) place[k] = lda.components().row(k).dot(off_mean);
  return place;
}

MatrixF places_of(const Lda& lda, const MatrixF& rows) {
  MatrixF places(rows.rows(), lda.num_components());
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    places.row(r) = place_of(lda, rows.middleRows(r, 1)).transpose();
  return places;
}

VectorF distances_to(const MatrixF& places, const VectorF& place) {
  VectorF result(places.rows());
  for (Eigen::Index c = 0; c < places.rows(); ++c)
    result[c] = (places.row(c).transpose() - place).squaredNorm();
  return result;
}

SoftmaxRegressionOptions softmax_options(double penalty) {
  SoftmaxRegressionOptions result;
  result.penalty = penalty;
  return result;
}

}  // namespace

VectorScorer::VectorScorer(SoftmaxRegression softmax, Lda lda, MatrixF means, MatrixF fillers)
    : softmax_(std::move(softmax)),
      lda_(std::move(lda)),
      means_(std::move(means)),
      fillers_(std::move(fillers)) {
  place_means();
}

void VectorScorer::place_means() {
  mean_places_ = places_of(lda_, means_);
  filler_places_ = places_of(lda_, fillers_);
}

VectorScorer VectorScorer::train(const ClassSequences& classes, const ClassSequences& fillers,
                                 const VectorScoring& options, const StopCheck& should_stop) {
  for (const auto& list : classes) require(!list.empty(), "a class has no vector");
  require(!classes.empty(), "training needs at least one class");
  const Eigen::Index columns = classes.front().front().cols();
  std::vector<int> numbers;
  const MatrixF rows = stacked(classes, columns, &numbers);
  const auto num_classes = static_cast<int>(classes.size());
  SoftmaxRegression softmax = SoftmaxRegression::train(
      rows, numbers, num_classes, softmax_options(options.penalty), should_stop);
  std::vector<int> filler_numbers;
  const MatrixF filler_rows = stacked(fillers, columns, &filler_numbers);
  for (const int number : filler_numbers) numbers.push_back(num_classes + number);
  MatrixF all(rows.rows() + filler_rows.rows(), columns);
  all << rows, filler_rows;
  LdaOptions of_lda;
  of_lda.shrinkage = options.shrinkage;
  Lda lda = Lda::train(all, numbers, num_classes + static_cast<int>(fillers.size()), of_lda);
  VectorScorer result(std::move(softmax), std::move(lda), means_of(classes, columns),
                      means_of(fillers, columns));
  result.penalty_ = options.penalty;
  result.vectors_per_class_ = static_cast<double>(rows.rows()) / num_classes;
  return result;
}

VectorF VectorScorer::scores(ConstMatrixRefF vector) const {
  require(vector.rows() == 1, "the vector does not fit the model");
  return static_cast<float>(weight_) * softmax_.scores(row_span(vector, 0));
}

VectorF VectorScorer::squared_distances(ConstMatrixRefF vector) const {
  return distances_to(mean_places_, place_of(lda_, vector));
}

VectorF VectorScorer::filler_squared_distances(ConstMatrixRefF vector) const {
  return distances_to(filler_places_, place_of(lda_, vector));
}

VectorScorer VectorScorer::adapted(const ClassSequences& classes, double prior_vectors) const {
  require(static_cast<Eigen::Index>(classes.size()) == means_.rows(),
          "vectors need one list a class");
  VectorD sum = VectorD::Zero(means_.cols());
  double count = prior_vectors;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (const MatrixF& vector : classes[c]) {
      require(vector.rows() == 1 && vector.cols() == means_.cols(), "vectors differ in size");
      sum += (vector.row(0) - means_.row(static_cast<Eigen::Index>(c))).transpose().cast<double>();
      count += 1;
    }
  }
  VectorScorer result = *this;
  if (count <= 0) return result;
  const VectorF shift = (sum / count).cast<float>();
  result.softmax_ = softmax_.moved({shift.data(), static_cast<std::size_t>(shift.size())});
  result.means_.rowwise() += shift.transpose();
  result.fillers_.rowwise() += shift.transpose();
  result.place_means();
  return result;
}

VectorScorer VectorScorer::with_class(int index, const std::vector<MatrixF>& vectors,
                                      const StopCheck& should_stop) const {
  require(!vectors.empty(), "a class has no vector");
  VectorScorer result = *this;
  // Fillers take no part, as in training: beside hundreds of them a few vectors of one speaker
  // would win over the other classes for that speaker alone.
  result.softmax_ = softmax_.with_class(index, stacked(vectors, means_.cols()), means_,
                                        vectors_per_class_, softmax_options(penalty_), should_stop);
  result.means_.resize(means_.rows() + 1, means_.cols());
  result.means_ << means_.topRows(index), mean_of(vectors).transpose(),
      means_.bottomRows(means_.rows() - index);
  result.place_means();
  return result;
}

VectorScorer VectorScorer::without_class(int index) const {
  VectorScorer result = *this;
  result.softmax_ = softmax_.without_class(index);
  result.means_.resize(means_.rows() - 1, means_.cols());
  result.means_ << means_.topRows(index), means_.bottomRows(means_.rows() - index - 1);
  result.place_means();
  return result;
}

VectorScorer VectorScorer::with_weight(double weight) const {
  require(weight > 0 && weight <= kMaxClassWeight, "weight must lie in 0..1e6");
  VectorScorer result = *this;
  result.weight_ = weight;
  return result;
}

void VectorScorer::write(ModelFile& file, const std::string& prefix) const {
  softmax_.write(file, prefix + "softmax.");
  lda_.write(file, prefix + "lda.");
  file.set_matrix(prefix + "means", means_);
  if (fillers_.rows() > 0) file.set_matrix(prefix + "fillers", fillers_);
  file.set_number(prefix + "penalty", penalty_);
  file.set_number(prefix + "vectors_per_class", vectors_per_class_);
  file.set_number(prefix + "weight", weight_);
}

VectorScorer VectorScorer::read(const ModelFile& file, const std::string& prefix, int num_classes) {
  SoftmaxRegression softmax = SoftmaxRegression::read(file, prefix + "softmax.");
  Lda lda = Lda::read(file, prefix + "lda.");
  MatrixF means = file.matrix_f(prefix + "means");
  MatrixF fillers(0, lda.dim());
  if (file.has(prefix + "fillers")) fillers = file.matrix_f(prefix + "fillers");
  const double penalty = file.number(prefix + "penalty");
  const double per_class = file.number(prefix + "vectors_per_class");
  const double weight = file.number(prefix + "weight");
  if (means.rows() != num_classes || means.cols() != lda.dim() || fillers.cols() != lda.dim() ||
      softmax.num_classes() != num_classes || softmax.dim() != lda.dim() ||
      !(weight > 0 && weight <= kMaxClassWeight) || !(per_class > 0 && per_class <= kMaxVectors) ||
      !(penalty > 0 && penalty <= kMaxPenalty)) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "means' does not fit");
  }
  VectorScorer result(std::move(softmax), std::move(lda), std::move(means), std::move(fillers));
  result.penalty_ = penalty;
  result.vectors_per_class_ = per_class;
  result.weight_ = weight;
  return result;
}

}  // namespace hri
