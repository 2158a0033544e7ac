// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Movements from few examples: a gesture is a path through shapes and places, one vector for a
// linear support vector machine. A gesture that begins at rest, pauses and moves again is also
// learned from that last movement alone, as somebody who is watched may take up the pose of its
// start long before. That a hand which stays as it began shows none of the gestures is learned too,
// so that shape and light at the beginning count for nothing. What was seen speaks for a gesture by
// its margin, by how near it comes to the mean path, and by how far the hand gets: from gestures
// and the rests before them is learned what is no movement at all.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/models/row_checks.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/movement_path.hpp"
#include "recognition/gesture/path_centres.hpp"

namespace hri {
namespace {

using detail::KnownPath;
using detail::kNumPoints;
using detail::max_displacement;
using detail::path_vector;
using detail::PathCentres;
using detail::Rests;

constexpr const char* kMovement = "path.movement.";
constexpr const char* kStartsAtRest = "path.starts_at_rest";
constexpr const char* kPauses = "path.pauses";
constexpr float kDistanceWeight = 0.5F;  // of the log of a squared distance, beside a margin

// How far gestures (1) and the rests before them (0) get.
class Distances {
 public:
  void add(int moved, double distance) {
    moved_.push_back(moved);
    distances_.push_back(distance);
  }
  // Tells them apart, both as often as the other; empty without rests.
  [[nodiscard]] LogisticRegression movement() const {
    const auto count = static_cast<double>(moved_.size());
    const auto gestures = static_cast<double>(std::count(moved_.begin(), moved_.end(), 1));
    if (gestures == count) return {};
    std::vector<double> weights;
    weights.reserve(moved_.size());
    for (const int m : moved_)
      weights.push_back(count / 2 / (m == 1 ? gestures : count - gestures));
    const Eigen::Map<const MatrixD> rows(distances_.data(),
                                         static_cast<Eigen::Index>(moved_.size()), 1);
    return LogisticRegression::train(rows, moved_, weights, {});
  }

 private:
  std::vector<int> moved_;
  std::vector<double> distances_;
};

class PathScorer : public GestureScorer {
 public:
  PathScorer(LinearSvm svm, PathCentres centres, float shape_scale, bool starts_at_rest,
             bool pauses, LogisticRegression movement)
      : svm_(std::move(svm)),
        centres_(std::move(centres)),
        shape_scale_(shape_scale),
        starts_at_rest_(starts_at_rest),
        pauses_(pauses),
        movement_(std::move(movement)) {}

  [[nodiscard]] VectorF scores(ConstMatrixRefF rows) const override {
    require(rows.cols() * kNumPoints == svm_.dim(),
            "features do not have as many columns as the model was trained on");
    const VectorF path = path_vector(rows, shape_scale_);
    return svm_.decision_values({path.data(), static_cast<std::size_t>(path.size())});
  }
  [[nodiscard]] float verification_score(ConstMatrixRefF rows,
                                         const VectorF& scores) const override {
    const VectorF path = path_vector(rows, shape_scale_);
    Eigen::Index best = 0;
    const float nearness =
        scores.maxCoeff(&best) - kDistanceWeight * centres_.log_distance(path, best);
    if (movement_.dim() == 0) return nearness;
    const double distance = max_displacement(path);
    const double odds = movement_.log_odds({&distance, 1});
    return nearness + static_cast<float>(std::min(odds, 0.0));
  }
  void write(ModelFile& file) const override {
    svm_.write(file, "path.svm.");
    centres_.write(file);
    file.set_number("path.shape_scale", shape_scale_);
    file.set_integer(kStartsAtRest, starts_at_rest_ ? 1 : 0);
    file.set_integer(kPauses, pauses_ ? 1 : 0);
    if (movement_.dim() > 0) movement_.write(file, kMovement);
  }
  [[nodiscard]] bool starts_at_rest() const override { return starts_at_rest_; }
  [[nodiscard]] bool pauses() const override { return pauses_; }

 private:
  LinearSvm svm_;
  PathCentres centres_;
  float shape_scale_;
  bool starts_at_rest_;
  bool pauses_;
  LogisticRegression movement_;  // against rest; empty where nothing was learned
};

// Tells the paths of classes from one another, and from hands that stay as they are.
LinearSvm separate(const std::vector<KnownPath>& paths, const std::vector<VectorF>& still,
                   int num_classes, const LinearSvmOptions& options) {
  MatrixF rows(static_cast<Eigen::Index>(paths.size() + still.size()), still.front().size());
  std::vector<int> classes(static_cast<std::size_t>(rows.rows()), kNoClass);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = paths[i].path.transpose();
    classes[i] = paths[i].klass;
  }
  for (std::size_t i = 0; i < still.size(); ++i)
    rows.row(static_cast<Eigen::Index>(paths.size() + i)) = still[i].transpose();
  return LinearSvm::train(rows, classes, num_classes, options);
}

}  // namespace

namespace detail {

std::shared_ptr<const GestureScorer> train_path_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop) {
  const Eigen::Index num_columns = per_class.front().front().cols();
  require(num_columns > kNumTrackColumns, "features need columns besides the hand's track");
  double squares = 0;
  double num_rows = 0;
  Eigen::Index num_gestures = 0;
  for (const auto& gestures : per_class) {
    for (const MatrixF& g : gestures) {
      require(g.cols() == num_columns, "all gestures need the same number of features");
      squares += g.leftCols(num_columns - kNumTrackColumns).squaredNorm();
      num_rows += static_cast<double>(g.rows());
      ++num_gestures;
    }
  }
  const auto shape_scale = squares > 0 ? static_cast<float>(std::sqrt(num_rows / squares)) : 1.0F;
  std::vector<KnownPath> paths;
  std::vector<VectorF> still;
  Eigen::Index num_at_rest = 0;
  Eigen::Index num_pausing = 0;
  Distances distances;
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& g : per_class[c]) {
      const Rests rests = find_rests(g, shape_scale);
      num_at_rest += rests.first_movement > 0 ? 1 : 0;
      paths.push_back({path_vector(g, shape_scale), static_cast<int>(c), false});
      distances.add(1, max_displacement(paths.back().path));
      still.push_back(path_vector(g.topRows(1), shape_scale));
      if (rests.first_movement >= kFewRows)
        distances.add(0,
                      max_displacement(path_vector(g.topRows(rests.first_movement), shape_scale)));
      if (rests.last_movement > 0) {
        ++num_pausing;
        paths.push_back({path_vector(g.bottomRows(g.rows() - rests.last_movement), shape_scale),
                         static_cast<int>(c), true});
      }
    }
  }
  const auto num_classes = static_cast<int>(per_class.size());
  LinearSvmOptions svm;
  svm.cost = options.svm_cost;
  svm.seed = options.seed;
  svm.should_stop = should_stop;
  return std::make_shared<PathScorer>(
      separate(paths, still, num_classes, svm), PathCentres::train(paths, num_classes), shape_scale,
      2 * num_at_rest > num_gestures, 2 * num_pausing > num_gestures, distances.movement());
}

std::shared_ptr<const GestureScorer> read_path_scorer(const ModelFile& file, int num_classes) {
  LinearSvm svm = LinearSvm::read(file, "path.svm.");
  const auto shape_scale = static_cast<float>(file.number("path.shape_scale"));
  if (svm.num_classes() != num_classes || svm.dim() % kNumPoints != 0 ||
      svm.dim() / kNumPoints <= kNumTrackColumns) {
    fail(ErrorKind::format,
         file.name() + ": the classifier does not fit the labels or the features");
  }
  if (!(shape_scale > 0) || !std::isfinite(shape_scale))
    fail(ErrorKind::format, file.name() + ": field 'path.shape_scale' is out of range");
  LogisticRegression movement;  // written where training clips began at rest
  if (file.has(std::string(kMovement) + "weights"))
    movement = LogisticRegression::read(file, kMovement);
  if (movement.dim() > 1)
    fail(ErrorKind::format, file.name() + ": field '" + kMovement + "weights' is too long");
  PathCentres centres = PathCentres::read(file, svm.dim(), num_classes);
  return std::make_shared<PathScorer>(std::move(svm), std::move(centres), shape_scale,
                                      file.integer(kStartsAtRest) != 0, file.integer(kPauses) != 0,
                                      std::move(movement));
}

}  // namespace detail
}  // namespace hri
