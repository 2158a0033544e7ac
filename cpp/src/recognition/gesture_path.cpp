// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Movements from few examples: a gesture is a path through shapes and places. It is resampled at
// a few points, spaced by how much changes rather than by time, so that pauses and tempo matter
// little; the points together are one vector for a linear support vector machine. A gesture that
// begins at rest, pauses and moves again is also learned from that last movement alone, as somebody
// who is watched may take up the pose of its start long before. From how far the hand gets in
// gestures and in the rests before them is learned what is no movement at all.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gesture_scorer.hpp"
#include "hri/core/error.hpp"
#include "hri/models/linear_svm.hpp"
#include "hri/models/logistic_regression.hpp"

namespace hri {
namespace {

constexpr const char* kMovement = "path.movement.";
constexpr const char* kStartsAtRest = "path.starts_at_rest";
constexpr const char* kPauses = "path.pauses";
constexpr Eigen::Index kMaxRows = 32;     // more frames than that only add noise to the steps
constexpr Eigen::Index kNumPoints = 8;    // of the resampled path
constexpr Eigen::Index kFewRows = 8;      // in which no rest is looked for
constexpr double kStillQuantile = 0.25;   // the stillest steps tell the noise of the shapes
constexpr float kNoiseMargin = 1.5F;      // times that, which does not count as change
constexpr float kTimeShare = 0.5F;        // weight of even spacing in time beside change
constexpr float kStepTrackScale = 4.0F;   // of the hand's place beside its shape, in a step
constexpr float kTrackScale = 0.5F;       // and in the vector
constexpr double kPauseShare = 0.08;      // of a gesture's frames that a pause takes at least
constexpr float kPauseChange = 0.05F;     // share of all change that may lie in a pause
constexpr float kMovementChange = 0.15F;  // and that makes a movement
constexpr float kReturned = 0.5F;  // of the way out: a hand that ends closer to its start came back
constexpr float kVectorLength = 3.0F;  // of an average vector, to suit a cost of 1
constexpr float kTrackUnits[detail::kNumTrackColumns] = {1.0F, 0.75F, 0.25F};  // x, y, log area

MatrixF thinned(ConstMatrixRefF rows) {
  if (rows.rows() <= kMaxRows) return rows;
  MatrixF result(kMaxRows, rows.cols());
  for (Eigen::Index i = 0; i < kMaxRows; ++i) {
    const auto at = static_cast<double>(i * (rows.rows() - 1)) / (kMaxRows - 1);
    result.row(i) = rows.row(static_cast<Eigen::Index>(std::lround(at)));
  }
  return result;
}

// Mean of every row and its neighbours; the ends repeat.
MatrixF smoothed(const MatrixF& rows) {
  MatrixF result(rows.rows(), rows.cols());
  const Eigen::Index last = rows.rows() - 1;
  for (Eigen::Index t = 0; t <= last; ++t) {
    result.row(t) = (rows.row(std::max<Eigen::Index>(t - 1, 0)) + rows.row(t) +
                     rows.row(std::min(t + 1, last))) /
                    3.0F;
  }
  return result;
}

// Which share of all change lies before every row, 0 to 1; all 0 where nothing changes.
std::vector<float> change_before(const MatrixF& rows) {
  const Eigen::Index num_steps = rows.rows() - 1;
  const MatrixF smooth = smoothed(rows);
  std::vector<float> steps(static_cast<std::size_t>(num_steps));
  for (Eigen::Index t = 0; t < num_steps; ++t)
    steps[static_cast<std::size_t>(t)] = (smooth.row(t + 1) - smooth.row(t)).norm();
  std::vector<float> sorted = steps;
  const auto still = sorted.begin() + static_cast<std::ptrdiff_t>(
                                          kStillQuantile * static_cast<double>(num_steps - 1));
  std::nth_element(sorted.begin(), still, sorted.end());
  std::vector<float> result{0};
  for (const float s : steps)
    result.push_back(result.back() + std::max(s - kNoiseMargin * *still, 0.0F));
  const float sum = result.back();
  if (sum > 0) {
    for (float& c : result) c /= sum;
  }
  return result;
}

// How far along the path every row lies, from 0 to 1.
std::vector<float> positions(const MatrixF& rows) {
  std::vector<float> result = change_before(rows);
  const float step = kTimeShare / static_cast<float>(rows.rows() - 1);
  for (std::size_t t = 0; t < result.size(); ++t) result[t] += step * static_cast<float>(t);
  const float length = result.back();
  for (float& p : result) p /= length;
  return result;
}

// kNumPoints rows, evenly spaced along `at`, between which rows are interpolated.
MatrixF resampled(const MatrixF& rows, const std::vector<float>& at) {
  MatrixF result(kNumPoints, rows.cols());
  std::size_t next = 1;
  for (Eigen::Index i = 0; i < kNumPoints; ++i) {
    const float wanted = static_cast<float>(i) / (kNumPoints - 1);
    while (next + 1 < at.size() && at[next] < wanted) ++next;
    const float width = at[next] - at[next - 1];
    const float share = width > 0 ? std::clamp((wanted - at[next - 1]) / width, 0.0F, 1.0F) : 0.0F;
    const auto right = static_cast<Eigen::Index>(next);
    result.row(i) = (1 - share) * rows.row(right - 1) + share * rows.row(right);
  }
  return result;
}

// Shapes brought to unit length by `shape_scale`, beside the track in units of its own.
MatrixF scaled(MatrixF rows, float shape_scale) {
  constexpr Eigen::Index kTrack = detail::kNumTrackColumns;
  const Eigen::Index num_shapes = rows.cols() - kTrack;
  rows.leftCols(num_shapes) *= shape_scale;
  for (Eigen::Index c = 0; c < kTrack; ++c)
    rows.col(num_shapes + c) *= kStepTrackScale * kTrackUnits[c];
  return rows;
}

// The path as one row.
VectorF path_vector(ConstMatrixRefF gesture, float shape_scale) {
  constexpr Eigen::Index kTrack = detail::kNumTrackColumns;
  const MatrixF rows = scaled(thinned(gesture), shape_scale);
  MatrixF points(kNumPoints, rows.cols());
  if (rows.rows() == 1) {
    points.rowwise() = rows.row(0);
  } else {
    points = resampled(rows, positions(rows));
  }
  MatrixF track = points.rightCols(kTrack);
  track.rowwise() -= points.rightCols(kTrack).row(0);
  points.rightCols(kTrack) = kTrackScale / kStepTrackScale * track;
  points *= kVectorLength / std::sqrt(static_cast<float>(kNumPoints));
  return Eigen::Map<const VectorF>(points.data(), points.size());
}

// Where a gesture rests, by its rows.
struct Rests {
  Eigen::Index first_movement = 0;  // its first row; 0 where it does not begin at rest
  Eigen::Index last_movement = 0;   // its first row; 0 where there is but one movement
};

Rests find_rests(ConstMatrixRefF gesture, float shape_scale) {
  if (gesture.rows() < kFewRows) return {};
  const MatrixF rows = scaled(gesture, shape_scale);
  const std::vector<float> before = change_before(rows);
  const auto pause = std::max<std::size_t>(
      2, static_cast<std::size_t>(kPauseShare * static_cast<double>(before.size())));
  Rests found;
  if (before.back() <= 0 || before[pause] > kPauseChange) return found;
  found.first_movement =
      std::upper_bound(before.begin(), before.end(), kPauseChange) - before.begin();
  const VectorF away =
      (smoothed(rows).rowwise() - rows.topRows(3).colwise().mean()).rowwise().norm();
  if (away[away.size() - 1] < kReturned * away.maxCoeff()) return found;
  for (std::size_t t = before.size() - 1; t >= pause; --t) {
    if (1 - before[t] < kMovementChange || before[t] - before[t - pause] > kPauseChange) continue;
    // A pause before which nothing moved is the rest at the start.
    if (before[t] >= kMovementChange) found.last_movement = static_cast<Eigen::Index>(t);
    break;
  }
  return found;
}

// Log of how far the path gets from its first point.
double farthest(const VectorF& path) {
  constexpr float kLeast = 0.05F;  // at which noise alone decides
  const Eigen::Map<const MatrixF> points(path.data(), kNumPoints, path.size() / kNumPoints);
  const float most = (points.rowwise() - points.row(0)).rowwise().norm().maxCoeff();
  return std::log(static_cast<double>(most + kLeast));
}

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
  PathScorer(LinearSvm svm, float shape_scale, bool starts_at_rest, bool pauses,
             LogisticRegression movement)
      : svm_(std::move(svm)),
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
  [[nodiscard]] float evidence(ConstMatrixRefF rows, const VectorF& scores) const override {
    if (movement_.dim() == 0) return scores.maxCoeff();
    const double distance = farthest(path_vector(rows, shape_scale_));
    const double odds = movement_.log_odds({&distance, 1});
    return scores.maxCoeff() + static_cast<float>(std::min(odds, 0.0));
  }
  void write(ModelFile& file) const override {
    svm_.write(file, "path.svm.");
    file.set_number("path.shape_scale", shape_scale_);
    file.set_integer(kStartsAtRest, starts_at_rest_ ? 1 : 0);
    file.set_integer(kPauses, pauses_ ? 1 : 0);
    if (movement_.dim() > 0) movement_.write(file, kMovement);
  }
  [[nodiscard]] bool starts_at_rest() const override { return starts_at_rest_; }
  [[nodiscard]] bool pauses() const override { return pauses_; }

 private:
  LinearSvm svm_;
  float shape_scale_;
  bool starts_at_rest_;
  bool pauses_;
  LogisticRegression movement_;  // against rest; empty where nothing was learned
};

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
  std::vector<VectorF> paths;
  std::vector<int> classes;
  Eigen::Index num_at_rest = 0;
  Eigen::Index num_pausing = 0;
  Distances distances;
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& g : per_class[c]) {
      const Rests rests = find_rests(g, shape_scale);
      num_at_rest += rests.first_movement > 0 ? 1 : 0;
      paths.push_back(path_vector(g, shape_scale));
      distances.add(1, farthest(paths.back()));
      if (rests.first_movement >= kFewRows)
        distances.add(0, farthest(path_vector(g.topRows(rests.first_movement), shape_scale)));
      if (rests.last_movement > 0) {
        ++num_pausing;
        paths.push_back(path_vector(g.bottomRows(g.rows() - rests.last_movement), shape_scale));
      }
      classes.resize(paths.size(), static_cast<int>(c));
    }
  }
  MatrixF vectors(static_cast<Eigen::Index>(paths.size()), num_columns * kNumPoints);
  for (std::size_t i = 0; i < paths.size(); ++i)
    vectors.row(static_cast<Eigen::Index>(i)) = paths[i].transpose();
  LinearSvmOptions svm;
  svm.cost = options.svm_cost;
  svm.seed = options.seed;
  svm.should_stop = should_stop;
  return std::make_shared<PathScorer>(
      LinearSvm::train(vectors, classes, static_cast<int>(per_class.size()), svm), shape_scale,
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
  return std::make_shared<PathScorer>(std::move(svm), shape_scale, file.integer(kStartsAtRest) != 0,
                                      file.integer(kPauses) != 0, std::move(movement));
}

}  // namespace detail
}  // namespace hri
