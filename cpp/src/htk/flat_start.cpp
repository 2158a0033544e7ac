// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/flat_start.hpp"

#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/shared_parameters.hpp"

namespace hri::htk {
namespace {

void require_positive(const VectorD& variance) {
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    if (!(variance[i] > 0)) {
      fail(ErrorKind::invalid_argument,
           "column " + std::to_string(i) + " has the same value in every frame");
    }
  }
}

}  // namespace

void FlatStart::add(ConstMatrixRefF frames) {
  require(frames.allFinite(), "the frames have values that are not finite");
  if (frames.rows() == 0) return;
  if (num_frames_ == 0) {
    origin_ = frames.row(0).transpose().cast<double>();
    sum_ = squares_ = VectorD::Zero(frames.cols());
  }
  require(frames.cols() == origin_.size(), "the frames have another number of columns than before");
  const MatrixD differences = frames.cast<double>().rowwise() - origin_.transpose();
  sum_ += differences.colwise().sum().transpose();
  squares_ += differences.cwiseAbs2().colwise().sum().transpose();
  num_frames_ += frames.rows();
}

VectorD FlatStart::mean() const {
  require(num_frames_ > 0, "there is no frame");
  return origin_ + sum_ / static_cast<double>(num_frames_);
}

VectorD FlatStart::variance() const {
  require(num_frames_ > 0, "there is no frame");
  const auto count = static_cast<double>(num_frames_);
  return (squares_ / count - (sum_ / count).cwiseAbs2()).cwiseMax(0);
}

ModelSet FlatStart::apply(const ModelSet& models, bool update_means, double min_variance) const {
  require(min_variance >= 0, "min_variance must not be negative");
  const VectorD all_means = mean();
  const VectorD all_variances = variance().cwiseMax(min_variance);
  require(models.vector_size == all_means.size(),
          "the models have another number of columns than the frames");
  require(models.num_codewords() == 0, "discrete models have no means and variances");
  require_positive(all_variances);
  detail::SharedParameters parameters(models);
  // The floors of a file that was read beside the prototype stay as they are.
  for (const detail::SharedComponent& one : parameters.components) {
    parameters.variances[static_cast<std::size_t>(one.variance)] = all_variances;
    if (update_means) parameters.means[static_cast<std::size_t>(one.mean)] = all_means;
  }
  return parameters.applied_to(models);
}

ModelSet FlatStart::variance_floors(double share) const {
  require(share > 0, "the share of the variance must be above 0");
  MacroDefinition macro;
  macro.type = 'v';
  macro.name = "varFloor1";
  macro.vector.values = share * variance();
  require_positive(macro.vector.values);
  ModelSet set;
  set.macros.push_back(std::move(macro));
  return set;
}

}  // namespace hri::htk
