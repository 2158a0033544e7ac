// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/trajectory_centres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/trajectory.hpp"

namespace hri::detail {
namespace {

constexpr const char* kCentres = "path.centres";
constexpr const char* kUsual = "path.usual_distance";
constexpr float kLeast = 1e-3F;  // of a trajectory that lies on its centre
constexpr float kLeastOfPart = 1e-6F;

Eigen::Index centre_of(const KnownTrajectory& known) {
  return 2 * Eigen::Index{known.klass} + (known.final_stroke ? 1 : 0);
}

// Two rows a class, of which every one has a whole gesture.
MatrixF means(const std::vector<KnownTrajectory>& trajectories, int num_classes) {
  MatrixF result =
      MatrixF::Zero(2 * Eigen::Index{num_classes}, trajectories.front().trajectory.size());
  VectorF counts = VectorF::Zero(result.rows());
  for (const KnownTrajectory& known : trajectories) {
    result.row(centre_of(known)) += known.trajectory.transpose();
    counts[centre_of(known)] += 1;
  }
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0)
      result.row(i) /= counts[i];
    else
      result.row(i) = result.row(i - 1);
  }
  return result;
}

}  // namespace

TrajectoryCentres TrajectoryCentres::train(const std::vector<KnownTrajectory>& trajectories,
                                           int num_classes) {
  TrajectoryCentres result;
  result.centres_ = means(trajectories, num_classes);
  double sum = 0;
  for (const KnownTrajectory& known : trajectories) {
    const auto centre = result.centres_.row(centre_of(known));
    sum += static_cast<double>((known.trajectory.transpose() - centre).squaredNorm());
  }
  // One example a class says nothing of how far others may lie.
  if (sum > 0) result.usual_ = sum / static_cast<double>(trajectories.size());
  return result;
}

TrajectoryCentres TrajectoryCentres::with_class(
    int index, const std::vector<KnownTrajectory>& trajectories) const {
  std::vector<KnownTrajectory> alone = trajectories;
  for (KnownTrajectory& known : alone) known.klass = 0;
  const Eigen::Index at = 2 * Eigen::Index{index};
  TrajectoryCentres result;
  result.usual_ = usual_;
  result.centres_.resize(centres_.rows() + 2, centres_.cols());
  result.centres_ << centres_.topRows(at), means(alone, 1),
      centres_.bottomRows(centres_.rows() - at);
  return result;
}

std::vector<KnownTrajectory> TrajectoryCentres::trajectories() const {
  std::vector<KnownTrajectory> result;
  result.reserve(static_cast<std::size_t>(centres_.rows()));
  for (Eigen::Index i = 0; i < centres_.rows(); ++i)
    result.push_back({centres_.row(i).transpose(), static_cast<int>(i / 2), i % 2 == 1});
  return result;
}

float TrajectoryCentres::log_distance(const VectorF& trajectory, Eigen::Index klass) const {
  const float whole = (centres_.row(2 * klass) - trajectory.transpose()).squaredNorm();
  const float last = (centres_.row(2 * klass + 1) - trajectory.transpose()).squaredNorm();
  return std::log(std::min(whole, last) / static_cast<float>(usual_) + kLeast);
}

TrajectoryCentres::Distances TrajectoryCentres::log_distances(const VectorF& trajectory,
                                                              Eigen::Index klass) const {
  const Eigen::Index num_columns = trajectory.size() / kNumPoints;
  float shape = std::numeric_limits<float>::infinity();
  float way = shape;
  for (Eigen::Index kind = 0; kind < 2; ++kind) {
    const VectorF away = trajectory - centres_.row(2 * klass + kind).transpose();
    const Eigen::Map<const MatrixF> points(away.data(), kNumPoints, num_columns);
    const auto shapes = points.leftCols(num_columns - kNumTrackColumns);
    const float stays = shapes.colwise().mean().squaredNorm() * static_cast<float>(kNumPoints);
    shape = std::min(shape, std::max(shapes.squaredNorm() - stays, 0.0F));
    way = std::min(way, points.rightCols(kNumTrackColumns).squaredNorm());
  }
  return {static_cast<double>(std::log(shape + kLeastOfPart)),
          static_cast<double>(std::log(way + kLeastOfPart))};
}

void TrajectoryCentres::write(ModelFile& file) const {
  file.set_matrix(kCentres, centres_);
  file.set_number(kUsual, usual_);
}

TrajectoryCentres TrajectoryCentres::read(const ModelFile& file, int dim, int num_classes) {
  TrajectoryCentres result;
  result.centres_ = file.matrix_f(kCentres);
  result.usual_ = file.number(kUsual);
  if (result.centres_.cols() != dim || result.centres_.rows() != 2 * Eigen::Index{num_classes})
    fail(ErrorKind::format, file.name() + ": field '" + kCentres + "' does not fit the classifier");
  if (!(result.usual_ > 0) || !std::isfinite(result.usual_))
    fail(ErrorKind::format, file.name() + ": field '" + kUsual + "' is out of range");
  return result;
}

}  // namespace hri::detail
