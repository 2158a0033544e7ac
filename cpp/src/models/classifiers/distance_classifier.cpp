// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/distance_classifier.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "io/option_fields.hpp"
#include "models/classifiers/class_statistics.hpp"

namespace hri {

DistanceClassifier DistanceClassifier::train(ConstMatrixRefF rows, Span<const int> classes,
                                             int num_classes,
                                             const DistanceClassifierOptions& options) {
  validate(options);
  const detail::ClassStatistics statistics = detail::class_statistics(rows, classes, num_classes);
  DistanceClassifier model;
  model.metric_ = options.metric;
  model.means_ = statistics.means.cast<float>();
  const Eigen::Index dim = statistics.dim();
  const Eigen::Index count = model.num_covariances();
  model.covariances_.resize(count * dim, dim);
  for (Eigen::Index k = 0; k < count; ++k) {
    MatrixD covariance =
        k + 1 == count ? statistics.pooled() : statistics.covariance(static_cast<int>(k));
    model.covariances_.middleRows(k * dim, dim) =
        detail::regularised(std::move(covariance), options.shrinkage, statistics.floor);
  }
  if (!model.finish())
    fail(ErrorKind::invalid_argument, "rows: a class has no positive definite covariance");
  return model;
}

Eigen::Index DistanceClassifier::num_covariances() const {
  if (metric_ == ClassDistance::mahalanobis) return 1;
  return metric_ == ClassDistance::bhattacharyya ? means_.rows() + 1 : 0;
}

bool DistanceClassifier::finish() {
  const Eigen::Index n = dim();
  const Eigen::Index count = num_covariances();
  if (count == 0) return true;
  const MatrixD within = covariances_.bottomRows(n);
  detail::Whitening about_row = detail::whiten(within);
  if (!about_row.valid) return false;
  if (metric_ == ClassDistance::mahalanobis) {
    whitening_.push_back(std::move(about_row.inverse));
    return true;
  }
  for (Eigen::Index c = 0; c + 1 < count; ++c) {
    const MatrixD own = covariances_.middleRows(c * n, n);
    const detail::Whitening of_class = detail::whiten(own);
    detail::Whitening mean = detail::whiten(0.5 * (own + within));
    if (!of_class.valid || !mean.valid) return false;
    whitening_.push_back(std::move(mean.inverse));
    // 1/2 log(|S| / sqrt(|S_a| |S_b|)), with log |S| = 2 log |L|.
    offsets_.push_back(
        static_cast<float>(mean.log_root - 0.5 * (of_class.log_root + about_row.log_root)));
  }
  return true;
}

VectorF DistanceClassifier::decision_values(Span<const float> row) const {
  validate_row(row, dim());
  const Eigen::Map<const VectorF> x(row.data(), dim());
  VectorF result(num_classes());
  for (int c = 0; c < num_classes(); ++c) {
    const VectorF centred = x - means_.row(c).transpose();
    const auto k = static_cast<std::size_t>(c);
    switch (metric_) {
      case ClassDistance::euclidean:
        result[c] = -centred.norm();
        break;
      case ClassDistance::manhattan:
        result[c] = -centred.lpNorm<1>();
        break;
      case ClassDistance::mahalanobis:
        result[c] = -(whitening_[0] * centred).norm();
        break;
      case ClassDistance::bhattacharyya:
        result[c] = -0.125F * (whitening_[k] * centred).squaredNorm() - offsets_[k];
        break;
    }
  }
  return result;
}

void DistanceClassifier::write(ModelFile& file, const std::string& prefix) const {
  detail::write_enum(metric_, file, prefix + "metric");
  file.set_matrix(prefix + "means", means_);
  if (num_covariances() > 0) file.set_matrix(prefix + "covariances", covariances_);
}

DistanceClassifier DistanceClassifier::read(const ModelFile& file, const std::string& prefix) {
  DistanceClassifier model;
  model.metric_ = detail::read_enum<ClassDistance>(file, prefix + "metric");
  model.means_ = file.matrix_f(prefix + "means");
  if (model.means_.rows() < 2 || model.dim() < 1)
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "means' is empty");
  const Eigen::Index count = model.num_covariances();
  if (count == 0) return model;
  model.covariances_ = file.matrix_d(prefix + "covariances");
  if (model.covariances_.cols() != model.dim() ||
      model.covariances_.rows() != count * model.dim() || !model.finish()) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix +
                                "covariances' does not fit means, or is not positive definite");
  }
  return model;
}

}  // namespace hri
