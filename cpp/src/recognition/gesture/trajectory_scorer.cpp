// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Resampled-trajectory classifier, for dynamic gestures with few examples: a gesture is a
// trajectory through shapes and places, one vector for a linear support vector machine. A gesture
// that begins at rest, pauses and moves again is also learned from its final stroke alone, as a
// signer in a stream may take up its starting pose long before. Copies with the hand turned stand
// for the angles at which others hold theirs. Clips held at their first frame are negative
// examples, so that shape and light at the beginning count for nothing. Planes know only how the
// trained gestures differ, so a verifier weighs them, of the whole and of the final stroke, beside
// the distances to the mean trajectory of the best class: of how the shape changes, and of the way
// of the hand. Hands that rest are learned from gestures and the rests before them.
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
#include "recognition/gesture/trajectory.hpp"
#include "recognition/gesture/trajectory_centres.hpp"
#include "recognition/gesture/turned_trajectories.hpp"

namespace hri::detail {
namespace {

constexpr const char* kMotion = "path.movement.";
constexpr const char* kStartsAtRest = "path.starts_at_rest";
constexpr const char* kPauses = "path.pauses";
constexpr const char* kWeight = "path.distance_weight";
// Of the log of a squared distance, beside a margin; and in files that do not say.
constexpr float kDistanceWeight = 1.0F;
constexpr float kFormerDistanceWeight = 0.5F;

// How far gestures (1) and the rests before them (0) get.
class Distances {
 public:
  void add(int moved, double distance) {
    moved_.push_back(moved);
    distances_.push_back(distance);
  }
  // Separates gestures from rests, equally weighted; empty without rests.
  [[nodiscard]] LogisticRegression motion() const {
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

class TrajectoryScorer : public GestureScorer {
 public:
  TrajectoryScorer(LinearSvm svm, TrajectoryCentres centres, float shape_scale,
                   float distance_weight, bool starts_at_rest, bool pauses,
                   LogisticRegression motion)
      : svm_(std::move(svm)),
        centres_(std::move(centres)),
        shape_scale_(shape_scale),
        distance_weight_(distance_weight),
        starts_at_rest_(starts_at_rest),
        pauses_(pauses),
        motion_(std::move(motion)) {}

  [[nodiscard]] VectorF scores(ConstMatrixRefF rows) const override {
    require(rows.cols() * kNumPoints == svm_.dim(),
            "features do not have as many columns as the model was trained on");
    const VectorF trajectory = trajectory_vector(rows, shape_scale_);
    return svm_.decision_values({trajectory.data(), static_cast<std::size_t>(trajectory.size())});
  }
  [[nodiscard]] float verification_score(ConstMatrixRefF rows,
                                         const VectorF& scores) const override {
    const VectorF trajectory = trajectory_vector(rows, shape_scale_);
    Eigen::Index best = 0;
    return scores.maxCoeff(&best) - distance_weight_ * centres_.log_distance(trajectory, best);
  }
  [[nodiscard]] float movement_score(ConstMatrixRefF rows) const override {
    if (motion_.dim() == 0) return 0;
    const double distance = max_displacement(trajectory_vector(rows, shape_scale_));
    return static_cast<float>(std::min(motion_.log_odds({&distance, 1}), 0.0));
  }
  [[nodiscard]] Eigen::Index num_confidence_features() const override {
    return kNumConfidenceFeatures;
  }
  [[nodiscard]] VectorD confidence_features(ConstMatrixRefF rows,
                                            const VectorF& scores) const override {
    Eigen::Index best = 0;
    scores.maxCoeff(&best);
    const Eigen::Index final_stroke = find_rests(rows, shape_scale_).final_stroke;
    const VectorF of_final =
        final_stroke > 0 ? this->scores(rows.bottomRows(rows.rows() - final_stroke)) : scores;
    const TrajectoryCentres::Distances distances =
        centres_.log_distances(trajectory_vector(rows, shape_scale_), best);
    VectorD result(kNumConfidenceFeatures);
    result[kScore] = static_cast<double>(scores[best]);
    result[kMargin] = margin(scores, best);
    result[kFinalScore] = static_cast<double>(of_final[best]);
    result[kFinalMargin] = margin(of_final, best);
    result[kShape] = -distances.shape;
    result[kWay] = -distances.way;
    return result;
  }
  void write(ModelFile& file) const override {
    svm_.write(file, "path.svm.");
    centres_.write(file);
    file.set_number("path.shape_scale", shape_scale_);
    file.set_number(kWeight, distance_weight_);
    file.set_integer(kStartsAtRest, starts_at_rest_ ? 1 : 0);
    file.set_integer(kPauses, pauses_ ? 1 : 0);
    if (motion_.dim() > 0) motion_.write(file, kMotion);
  }
  [[nodiscard]] bool starts_at_rest() const override { return starts_at_rest_; }
  [[nodiscard]] bool pauses() const override { return pauses_; }
  [[nodiscard]] std::shared_ptr<const GestureScorer> with_class(
      int index, const std::vector<MatrixF>& gestures, const GestureRecognizerOptions& options,
      const StopCheck& should_stop) const;

 private:
  // What a verifier weighs of the best class.
  enum ConfidenceFeature : Eigen::Index {
    kScore,
    kMargin,       // over the second class
    kFinalScore,   // of the final stroke alone; of the whole where there is but one
    kFinalMargin,  // and its margin
    kShape,        // -log of the distance to the mean change of the shape
    kWay,          // and to the mean way of the hand
    kNumConfidenceFeatures,
  };

  LinearSvm svm_;
  TrajectoryCentres centres_;
  float shape_scale_;
  float distance_weight_;
  bool starts_at_rest_;
  bool pauses_;
  LogisticRegression motion_;  // against rest; empty where nothing was learned
};

// What separates the trajectories of classes from each other, and from hands that stay as they are:
// `train` gets rows and their classes.
template <class Train>
LinearSvm separate(const std::vector<KnownTrajectory>& trajectories,
                   const std::vector<VectorF>& still, const Train& train) {
  MatrixF rows(static_cast<Eigen::Index>(trajectories.size() + still.size()), still.front().size());
  std::vector<int> classes(static_cast<std::size_t>(rows.rows()), kNoClass);
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = trajectories[i].trajectory.transpose();
    classes[i] = trajectories[i].klass;
  }
  for (std::size_t i = 0; i < still.size(); ++i)
    rows.row(static_cast<Eigen::Index>(trajectories.size() + i)) = still[i].transpose();
  return train(rows, classes);
}

LinearSvmOptions svm_options(const GestureRecognizerOptions& options,
                             const StopCheck& should_stop) {
  LinearSvmOptions svm;
  svm.cost = options.svm_cost;
  svm.seed = options.seed;
  svm.should_stop = should_stop;
  return svm;
}

// Appends a gesture of class `klass`, and its final stroke where it has several.
void append_trajectories(const MatrixF& gesture, int klass, const Rests& rests, float shape_scale,
                         std::vector<KnownTrajectory>* trajectories) {
  trajectories->push_back({trajectory_vector(gesture, shape_scale), klass, false});
  if (rests.final_stroke == 0) return;
  const MatrixF last = gesture.bottomRows(gesture.rows() - rests.final_stroke);
  trajectories->push_back({trajectory_vector(last, shape_scale), klass, true});
}

// The gestures that the others were trained on are not kept; their means stand for them.
std::shared_ptr<const GestureScorer> TrajectoryScorer::with_class(
    int index, const std::vector<MatrixF>& gestures, const GestureRecognizerOptions& options,
    const StopCheck& should_stop) const {
  const Eigen::Index num_columns = svm_.dim() / kNumPoints;
  std::vector<KnownTrajectory> trajectories;
  std::vector<VectorF> still;
  for (const MatrixF& g : gestures) {
    require(g.cols() == num_columns,
            "features do not have as many columns as the model was trained on");
    append_trajectories(g, index, find_rests(g, shape_scale_), shape_scale_, &trajectories);
    still.push_back(trajectory_vector(g.topRows(1), shape_scale_));
  }
  TrajectoryCentres centres = centres_.with_class(index, trajectories);
  for (const KnownTrajectory& known : centres.trajectories()) {
    if (known.klass != index) trajectories.push_back(known);
  }
  append_turned(options, num_columns, &trajectories);
  return std::make_shared<TrajectoryScorer>(
      separate(trajectories, still,
               [&](const MatrixF& rows, const std::vector<int>& classes) {
                 return svm_.with_class(index, rows, classes, svm_options(options, should_stop));
               }),
      std::move(centres), shape_scale_, distance_weight_, starts_at_rest_, pauses_, motion_);
}

}  // namespace

std::shared_ptr<const GestureScorer> train_trajectory_scorer(
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
  std::vector<KnownTrajectory> trajectories;
  std::vector<VectorF> still;
  Eigen::Index num_at_rest = 0;
  Eigen::Index num_pausing = 0;
  Distances distances;
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& g : per_class[c]) {
      const Rests rests = find_rests(g, shape_scale);
      num_at_rest += rests.first_stroke > 0 ? 1 : 0;
      const std::size_t first = trajectories.size();
      append_trajectories(g, static_cast<int>(c), rests, shape_scale, &trajectories);
      distances.add(1, max_displacement(trajectories[first].trajectory));
      still.push_back(trajectory_vector(g.topRows(1), shape_scale));
      if (rests.first_stroke >= kFewRows)
        distances.add(
            0, max_displacement(trajectory_vector(g.topRows(rests.first_stroke), shape_scale)));
      num_pausing += rests.final_stroke > 0 ? 1 : 0;
    }
  }
  const auto num_classes = static_cast<int>(per_class.size());
  // Of gestures as they were shown: turned copies would make far movements look usual.
  TrajectoryCentres centres = TrajectoryCentres::train(trajectories, num_classes);
  append_turned(options, num_columns, &trajectories);
  LinearSvm svm =
      separate(trajectories, still, [&](const MatrixF& rows, const std::vector<int>& classes) {
        return LinearSvm::train(rows, classes, num_classes, svm_options(options, should_stop));
      });
  return std::make_shared<TrajectoryScorer>(std::move(svm), std::move(centres), shape_scale,
                                            kDistanceWeight, 2 * num_at_rest > num_gestures,
                                            2 * num_pausing > num_gestures, distances.motion());
}

std::shared_ptr<const GestureScorer> extend_trajectory_scorer(
    const GestureScorer& scorer, int index, const std::vector<MatrixF>& gestures,
    const GestureRecognizerOptions& options, const StopCheck& should_stop) {
  return static_cast<const TrajectoryScorer&>(scorer).with_class(index, gestures, options,
                                                                 should_stop);
}

std::shared_ptr<const GestureScorer> read_trajectory_scorer(const ModelFile& file,
                                                            int num_classes) {
  LinearSvm svm = LinearSvm::read(file, "path.svm.");
  const auto shape_scale = static_cast<float>(file.number("path.shape_scale"));
  if (svm.num_classes() != num_classes || svm.dim() % kNumPoints != 0 ||
      svm.dim() / kNumPoints <= kNumTrackColumns) {
    fail(ErrorKind::format,
         file.name() + ": the classifier does not fit the labels or the features");
  }
  if (!(shape_scale > 0) || !std::isfinite(shape_scale))
    fail(ErrorKind::format, file.name() + ": field 'path.shape_scale' is out of range");
  const float weight =
      file.has(kWeight) ? static_cast<float>(file.number(kWeight)) : kFormerDistanceWeight;
  if (!(weight >= 0 && weight <= 1e6F))
    fail(ErrorKind::format, file.name() + ": field '" + kWeight + "' is out of range");
  LogisticRegression motion;  // written where training clips began at rest
  if (file.has(std::string(kMotion) + "weights")) motion = LogisticRegression::read(file, kMotion);
  if (motion.dim() > 1)
    fail(ErrorKind::format, file.name() + ": field '" + kMotion + "weights' is too long");
  TrajectoryCentres centres = TrajectoryCentres::read(file, svm.dim(), num_classes);
  return std::make_shared<TrajectoryScorer>(std::move(svm), std::move(centres), shape_scale, weight,
                                            file.integer(kStartsAtRest) != 0,
                                            file.integer(kPauses) != 0, std::move(motion));
}

}  // namespace hri::detail
