// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// GestureRecognizer::train.
#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/gesture_verifier.hpp"
#include "recognition/recording_folds.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 5;

void require_finite(const MatrixF& rows, std::size_t sample) {
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    for (Eigen::Index c = 0; c < rows.cols(); ++c) {
      if (std::isfinite(rows(r, c))) continue;
      fail(ErrorKind::invalid_argument, "sample " + std::to_string(sample) +
                                            ": feature is not finite at row " + std::to_string(r) +
                                            ", column " + std::to_string(c));
    }
  }
}

std::vector<std::string> labels_of(const std::vector<GestureSample>& samples) {
  std::vector<std::string> names;
  names.reserve(samples.size());
  for (const GestureSample& s : samples) names.push_back(s.label);
  return sorted_labels(names);
}

// The rows of every class outside fold `left_out`; -1 leaves nothing out.
std::vector<std::vector<MatrixF>> by_class(const std::vector<GestureSample>& samples,
                                           const std::vector<int>& classes,
                                           const std::vector<int>& folds, std::size_t num_classes,
                                           int left_out) {
  std::vector<std::vector<MatrixF>> result(num_classes);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (folds[i] == left_out || samples[i].features.rows() == 0) continue;
    result[static_cast<std::size_t>(classes[i])].push_back(samples[i].features);
  }
  return result;
}

// What GestureModel::automatic becomes.
GestureModel model_for(const std::vector<GestureSample>& samples) {
  constexpr Eigen::Index kShortestMovement = 8;
  const auto movements = std::count_if(samples.begin(), samples.end(), [](const GestureSample& s) {
    return s.features.rows() >= kShortestMovement;
  });
  const bool most = 2 * movements > static_cast<std::ptrdiff_t>(samples.size());
  if (most) return GestureModel::trajectory;
  // The time of rbf grows with the cube of the frames.
  constexpr Eigen::Index kMostFrames = 3000;
  Eigen::Index num_frames = 0;
  for (const GestureSample& s : samples) num_frames += s.features.rows();
  return num_frames > kMostFrames ? GestureModel::svm : GestureModel::rbf;
}

// Classes that a scorer is trained without, to see how it takes what it does not know.
using ClassGroup = std::vector<int>;

// Which groups to leave out in a fold, by turns: one, or as many as it takes for kEnough samples to
// be unknown once. At least two classes remain of three or more.
std::vector<ClassGroup> left_out_groups(int fold, int num_classes, std::size_t num_samples) {
  constexpr std::size_t kEnough = 30;  // of fewer, the weights would be chance
  const int num_groups = std::min(kMaxFolds, num_classes);
  const auto count = static_cast<std::size_t>(num_groups);
  const int needed = static_cast<int>((kEnough * count + num_samples - 1) / num_samples);
  std::vector<ClassGroup> groups;
  for (int i = 0; i < std::clamp(needed, 1, num_groups); ++i) {
    groups.emplace_back();
    for (int c = (fold + i) % num_groups; c < num_classes; c += num_groups)
      groups.back().push_back(c);
  }
  return groups;
}

// The same without some classes, in ascending order; those behind them move up.
std::vector<std::vector<MatrixF>> without(std::vector<std::vector<MatrixF>> per_class,
                                          const ClassGroup& left_out) {
  for (auto c = left_out.rbegin(); c != left_out.rend(); ++c)
    per_class.erase(per_class.begin() + *c);
  return per_class;
}

bool any_empty(const std::vector<std::vector<MatrixF>>& per_class) {
  return std::any_of(per_class.begin(), per_class.end(),
                     [](const auto& list) { return list.empty(); });
}

// What is learned from gestures that a scorer has not seen.
class Trials {
 public:
  Trials(const std::vector<GestureSample>& samples, const std::vector<int>& classes,
         const std::vector<int>& folds)
      : samples_(samples), classes_(classes), folds_(folds) {}

  // A scorer of all classes decides on the gestures of a fold.
  void decide(const detail::GestureScorer& scorer, int fold) {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (folds_[i] != fold || samples_[i].features.rows() == 0) continue;
      const MatrixF& rows = samples_[i].features;
      const VectorF scores = scorer.scores(rows);
      held_out_.push_back({scores, classes_[i], detail::verified_score({}, scorer, rows, scores)});
      movement_.push_back(scorer.movement_score(rows));
      confidence_features_.push_back(scorer.confidence_features(rows, scores));
    }
  }

  // A scorer that knows nothing of the classes `left_out` decides on what the fold has of them.
  void decide_unknown(const detail::GestureScorer& scorer, int fold, const ClassGroup& left_out) {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const MatrixF& rows = samples_[i].features;
      const bool unknown =
          std::find(left_out.begin(), left_out.end(), classes_[i]) != left_out.end();
      if (folds_[i] == fold && unknown && rows.rows() > 0)
        unknown_.push_back(scorer.confidence_features(rows, scorer.scores(rows)));
    }
  }

  // Weighs what speaks for right decisions; the score becomes what it says.
  LogisticRegression learn_verifier() {
    std::vector<VectorD> right;
    for (std::size_t i = 0; i < held_out_.size(); ++i) {
      Eigen::Index best = 0;
      held_out_[i].scores.maxCoeff(&best);
      if (best == held_out_[i].truth) right.push_back(confidence_features_[i]);
    }
    LogisticRegression verifier = detail::train_gesture_verifier(right, unknown_);
    if (verifier.dim() == 0) return verifier;
    for (std::size_t i = 0; i < held_out_.size(); ++i)
      held_out_[i].score = detail::log_odds(verifier, confidence_features_[i], movement_[i]);
    return verifier;
  }

  [[nodiscard]] const std::vector<HeldOut>& held_out() const { return held_out_; }

 private:
  const std::vector<GestureSample>& samples_;
  const std::vector<int>& classes_;
  const std::vector<int>& folds_;
  std::vector<HeldOut> held_out_;
  std::vector<VectorD> confidence_features_;  // of held_out_
  std::vector<float> movement_;               // the same
  std::vector<VectorD> unknown_;              // of gestures whose class was left out
};

}  // namespace

GestureRecognizer GestureRecognizer::train(const std::vector<GestureSample>& samples,
                                           const GestureRecognizerOptions& options,
                                           const TrainingProgress& progress,
                                           const StopCheck& should_stop) {
  GestureRecognizer result;
  result.options_ = validated(options);
  if (options.model == GestureModel::automatic) result.options_.model = model_for(samples);
  result.front_end_.emplace(options.features, options.min_quality);
  result.labels_ = labels_of(samples);
  std::vector<int> classes;
  std::vector<std::string> groups;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    require_finite(samples[i].features, i);
    classes.push_back(label_index(result.labels_, samples[i].label));
    groups.push_back(samples[i].group);
  }
  const std::vector<int> folds = detail::usable_folds(classes, groups, kMaxFolds);
  const auto all = by_class(samples, classes, folds, result.labels_.size(), -1);
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].empty()) {
      fail(ErrorKind::invalid_argument, "label '" + result.labels_[c] + "': no frame shows a hand");
    }
  }
  const int num_folds = *std::max_element(folds.begin(), folds.end()) + 1;
  const auto num_classes = static_cast<int>(result.labels_.size());
  Trials trials(samples, classes, folds);
  for (int fold = 0; fold < num_folds; ++fold) {
    if (progress) progress(fold, num_folds + 1);
    const auto rest = by_class(samples, classes, folds, result.labels_.size(), fold);
    if (any_empty(rest)) continue;  // without every class there is nothing to calibrate on
    const auto scorer = detail::train_gesture_scorer(rest, result.options_, should_stop);
    trials.decide(*scorer, fold);
    if (scorer->num_confidence_features() == 0 || num_classes < 3) continue;
    for (const ClassGroup& left_out : left_out_groups(fold, num_classes, samples.size())) {
      trials.decide_unknown(
          *detail::train_gesture_scorer(without(rest, left_out), result.options_, should_stop),
          fold, left_out);
    }
  }
  if (progress) progress(num_folds, num_folds + 1);
  result.scorer_ = detail::train_gesture_scorer(all, result.options_, should_stop);
  result.verifier_ = trials.learn_verifier();
  RejectionRates rates;
  rates.false_reject = options.false_reject_rate;
  rates.interpolate = true;
  result.calibration_ = Calibration::fit(trials.held_out(), rates);
  if (progress) progress(num_folds + 1, num_folds + 1);
  return result;
}

}  // namespace hri
