// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/lda_scorer.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kMaxWeight = 1e6;

void require_weight(double weight) {
  require(weight > 0 && weight <= kMaxWeight, "weight must lie in 0..1e6");
}

MatrixF stacked(const ClassSequences& lists, std::vector<int>* classes, int first_class,
                const MatrixF& before) {
  Eigen::Index rows = before.rows();
  Eigen::Index columns = before.cols();
  for (const auto& list : lists) {
    rows += static_cast<Eigen::Index>(list.size());
    if (!list.empty()) columns = list.front().cols();
  }
  MatrixF all(rows, columns);
  if (before.rows() > 0) all.topRows(before.rows()) = before;
  Eigen::Index at = before.rows();
  for (std::size_t c = 0; c < lists.size(); ++c) {
    for (const MatrixF& vector : lists[c]) {
      require(vector.rows() == 1 && vector.cols() == columns, "vectors differ in size");
      all.row(at++) = vector;
      classes->push_back(first_class + static_cast<int>(c));
    }
  }
  return all;
}

// The vector among the discriminants, without the matrix products that Lda::transform() brings into
// programs that only recognise.
VectorF place_of(const Lda& lda, ConstMatrixRefF vector) {
  require(vector.rows() == 1 && vector.cols() == lda.dim(), "the vector does not fit the model");
  const VectorF off_mean = vector.row(0).transpose() - lda.mean();
  VectorF place(lda.num_components());
  for (Eigen::Index k = 0; k < place.size(); ++k) place[k] = lda.components().row(k).dot(off_mean);
  return place;
}

MatrixF means_of(const ClassSequences& lists, const Lda& lda) {
  MatrixF means(static_cast<Eigen::Index>(lists.size()), lda.num_components());
  for (std::size_t c = 0; c < lists.size(); ++c) {
    VectorD sum = VectorD::Zero(lda.num_components());
    for (const MatrixF& vector : lists[c]) sum += place_of(lda, vector).cast<double>();
    means.row(static_cast<Eigen::Index>(c)) =
        (sum / static_cast<double>(lists[c].size())).cast<float>().transpose();
  }
  return means;
}

}  // namespace

LdaScorer::LdaScorer(Lda lda, MatrixF means, MatrixF fillers, double weight)
    : lda_(std::move(lda)),
      means_(std::move(means)),
      fillers_(std::move(fillers)),
      weight_(weight) {}

LdaScorer LdaScorer::train(const ClassSequences& classes, const ClassSequences& fillers,
                           const VectorScoring& options) {
  require_weight(options.weight);
  for (const auto& list : classes) require(!list.empty(), "a class has no vector");
  const auto num_classes = static_cast<int>(classes.size());
  std::vector<int> numbers;
  const MatrixF vocabulary = stacked(classes, &numbers, 0, {});
  const MatrixF rows = stacked(fillers, &numbers, num_classes, vocabulary);
  LdaOptions of_lda;
  of_lda.shrinkage = options.shrinkage;
  Lda lda = Lda::train(rows, {numbers.data(), numbers.size()},
                       num_classes + static_cast<int>(fillers.size()), of_lda);
  MatrixF means = means_of(classes, lda);
  MatrixF filler_means = means_of(fillers, lda);
  return {std::move(lda), std::move(means), std::move(filler_means), options.weight};
}

VectorF LdaScorer::scores_of(const MatrixF& means, ConstMatrixRefF vector) const {
  const VectorF place = place_of(lda_, vector);
  VectorF result(means.rows());
  for (Eigen::Index c = 0; c < means.rows(); ++c) {
    const double squares = static_cast<double>((means.row(c).transpose() - place).squaredNorm());
    result[c] = static_cast<float>(-0.5 * weight_ * squares);
  }
  return result;
}

VectorF LdaScorer::scores(ConstMatrixRefF vector) const { return scores_of(means_, vector); }

VectorF LdaScorer::filler_scores(ConstMatrixRefF vector) const {
  return scores_of(fillers_, vector);
}

LdaScorer LdaScorer::adapted(const ClassSequences& classes, double prior_vectors) const {
  require(static_cast<Eigen::Index>(classes.size()) == means_.rows(),
          "vectors need one list a class");
  VectorD sum = VectorD::Zero(means_.cols());
  double count = prior_vectors;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (const MatrixF& vector : classes[c]) {
      const auto row = static_cast<Eigen::Index>(c);
      sum += (place_of(lda_, vector) - means_.row(row).transpose()).cast<double>();
      count += 1;
    }
  }
  LdaScorer result = *this;
  if (count <= 0) return result;
  const VectorF shift = (sum / count).cast<float>();
  result.means_.rowwise() += shift.transpose();
  if (result.fillers_.rows() > 0) result.fillers_.rowwise() += shift.transpose();
  return result;
}

LdaScorer LdaScorer::with_class(int index, const std::vector<MatrixF>& vectors) const {
  require(!vectors.empty(), "a class has no vector");
  LdaScorer result = *this;
  result.means_.resize(means_.rows() + 1, means_.cols());
  result.means_.topRows(index) = means_.topRows(index);
  result.means_.row(index) = means_of({vectors}, lda_);
  result.means_.bottomRows(means_.rows() - index) = means_.bottomRows(means_.rows() - index);
  return result;
}

LdaScorer LdaScorer::without_class(int index) const {
  LdaScorer result = *this;
  const Eigen::Index after = means_.rows() - index - 1;
  result.means_.resize(means_.rows() - 1, means_.cols());
  result.means_.topRows(index) = means_.topRows(index);
  result.means_.bottomRows(after) = means_.bottomRows(after);
  return result;
}

LdaScorer LdaScorer::with_weight(double weight) const {
  require_weight(weight);
  LdaScorer result = *this;
  result.weight_ = weight;
  return result;
}

void LdaScorer::write(ModelFile& file, const std::string& prefix) const {
  lda_.write(file, prefix + "lda.");
  file.set_matrix(prefix + "means", means_);
  if (fillers_.rows() > 0) file.set_matrix(prefix + "fillers", fillers_);
  file.set_number(prefix + "weight", weight_);
}

LdaScorer LdaScorer::read(const ModelFile& file, const std::string& prefix, int num_classes) {
  Lda lda = Lda::read(file, prefix + "lda.");
  MatrixF means = file.matrix_f(prefix + "means");
  MatrixF fillers(0, lda.num_components());
  if (file.has(prefix + "fillers")) fillers = file.matrix_f(prefix + "fillers");
  const double weight = file.number(prefix + "weight");
  if (means.rows() != num_classes || means.cols() != lda.num_components() ||
      fillers.cols() != lda.num_components() || !(weight > 0 && weight <= kMaxWeight)) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "means' does not fit");
  }
  return {std::move(lda), std::move(means), std::move(fillers), weight};
}

}  // namespace hri
