// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How GestureRecognizer scores the feature rows of one gesture. Three families: frames that vote
// (still signs), sequence models and resampled trajectories (dynamic gestures).
#pragma once

#include <memory>
#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"

namespace hri::detail {

class GestureScorer {
 public:
  GestureScorer() = default;
  GestureScorer(const GestureScorer&) = delete;
  GestureScorer& operator=(const GestureScorer&) = delete;
  virtual ~GestureScorer() = default;

  /// Score of every class for the rows of one gesture (at least one row).
  [[nodiscard]] virtual VectorF scores(ConstMatrixRefF rows) const = 0;
  /// What the rejection threshold is compared with where no verifier was learned; larger is surer.
  [[nodiscard]] virtual float verification_score(ConstMatrixRefF rows,
                                                 const VectorF& scores) const = 0;
  /// Log odds that the hand moves as gestures do, not rests, at most 0; 0 where nothing is known of
  /// rests.
  [[nodiscard]] virtual float movement_score(ConstMatrixRefF /*rows*/) const { return 0; }
  /// How many values confidence_features() gives; 0 where score says it all.
  [[nodiscard]] virtual Eigen::Index num_confidence_features() const { return 0; }
  /// What a verifier weighs; larger values are surer.
  [[nodiscard]] virtual VectorD confidence_features(ConstMatrixRefF /*rows*/,
                                                    const VectorF& /*scores*/) const {
    return {};
  }
  virtual void write(ModelFile& file) const = 0;
  /// Whether most training gestures began with a hand that rested in view.
  [[nodiscard]] virtual bool starts_at_rest() const { return false; }
  /// Whether most were made of several strokes with pauses between them.
  [[nodiscard]] virtual bool pauses() const { return false; }
};

/// `options.model` must not be automatic. `per_class[c]` holds the rows of every gesture of class
/// c; no class is empty.
std::shared_ptr<const GestureScorer> train_gesture_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop);
/// `scorer` with one class more, of number `index`, from the rows of few gestures. `options` are
/// those that it was trained with. Throws InvalidArgument for the models that keep too little of
/// what they were trained on (svm, bayes).
std::shared_ptr<const GestureScorer> extend_gesture_scorer(const GestureScorer& scorer, int index,
                                                           const std::vector<MatrixF>& gestures,
                                                           const GestureRecognizerOptions& options,
                                                           const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> read_gesture_scorer(const ModelFile& file,
                                                         const GestureRecognizerOptions& options,
                                                         int num_classes);

std::shared_ptr<const GestureScorer> train_vote_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> extend_vote_scorer(const GestureScorer& scorer, int index,
                                                        const std::vector<MatrixF>& gestures,
                                                        const GestureRecognizerOptions& options,
                                                        const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> read_vote_scorer(const ModelFile& file,
                                                      const GestureRecognizerOptions& options,
                                                      int num_classes);
std::shared_ptr<const GestureScorer> train_sequence_gesture_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> extend_sequence_gesture_scorer(
    const GestureScorer& scorer, int index, const std::vector<MatrixF>& gestures,
    const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> read_sequence_gesture_scorer(
    const ModelFile& file, const GestureRecognizerOptions& options, int num_classes);
std::shared_ptr<const GestureScorer> train_trajectory_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> extend_trajectory_scorer(
    const GestureScorer& scorer, int index, const std::vector<MatrixF>& gestures,
    const GestureRecognizerOptions& options, const StopCheck& should_stop);
std::shared_ptr<const GestureScorer> read_trajectory_scorer(const ModelFile& file, int num_classes);

/// Columns of GestureRecognizer::features behind the hand's shape: centre x, centre y, log area.
constexpr int kNumTrackColumns = 3;

/// How far the score of class `best` lies above that of the best other class.
double margin(const VectorF& scores, Eigen::Index best);

/// All rows of all gestures below each other, and the class of each row.
struct StackedRows {
  MatrixF rows;
  std::vector<int> classes;
};
StackedRows stack_rows(const std::vector<std::vector<MatrixF>>& per_class);

}  // namespace hri::detail
