// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Dynamic gestures: principal components of the hand's shape, its track from where it began, and
// their changes, scored whole by one sequence model a gesture.
#include "hri/models/sequence_scorer.hpp"

#include "hri/core/error.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/models/classifiers/pca.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri::detail {
namespace {

constexpr int kDeltaWindow = 2;
constexpr float kTrackScale = 10.0F;  // a tenth of the picture counts as much as one unit of shape

// Shape components and track, with their deltas behind them.
MatrixF sequence_rows(ConstMatrixRefF rows, const Pca& pca) {
  const int track = kNumTrackColumns;
  const int width = pca.num_components() + track;
  require(rows.cols() == pca.dim() + track,
          "features do not have as many columns as the model was trained on");
  MatrixF result(rows.rows(), 2 * width);
  result.leftCols(pca.num_components()) = pca.transform(rows.leftCols(pca.dim()));
  const MatrixF place = rows.rightCols(track);
  result.middleCols(pca.num_components(), track) = kTrackScale * (place.rowwise() - place.row(0));
  append_deltas(result, 0, width, kDeltaWindow);
  return result;
}

SequenceModelOptions model_options(const GestureRecognizerOptions& options) {
  SequenceModelOptions o;
  o.model = options.model == GestureModel::hmm ? SequenceModelKind::hmm : SequenceModelKind::ptbhmm;
  o.num_states = options.num_states;
  o.num_codewords = options.num_codewords;
  o.garbage_mixtures = 4;
  o.max_iterations = options.max_iterations;
  o.seed = options.seed;
  return o;
}

class SequenceGestureScorer : public GestureScorer {
 public:
  SequenceGestureScorer(Pca pca, std::shared_ptr<const SequenceScorer> models)
      : pca_(std::move(pca)), models_(std::move(models)) {}

  [[nodiscard]] VectorF scores(ConstMatrixRefF rows) const override {
    return models_->scores(sequence_rows(rows, pca_));
  }
  [[nodiscard]] float verification_score(ConstMatrixRefF rows,
                                         const VectorF& scores) const override {
    return (scores.maxCoeff() - models_->garbage_score(sequence_rows(rows, pca_))) /
           static_cast<float>(rows.rows());
  }
  void write(ModelFile& file) const override {
    pca_.write(file, "pca.");
    models_->write(file, "movement.");
  }
  [[nodiscard]] std::shared_ptr<const GestureScorer> with_class(
      int index, const std::vector<MatrixF>& gestures, const StopCheck& should_stop) const {
    std::vector<MatrixF> sequences;
    sequences.reserve(gestures.size());
    for (const MatrixF& g : gestures) sequences.push_back(sequence_rows(g, pca_));
    return std::make_shared<SequenceGestureScorer>(
        pca_,
        models_->with_class(index, sequences, static_cast<int>(gestures.size()), should_stop));
  }

 private:
  Pca pca_;
  std::shared_ptr<const SequenceScorer> models_;
};

}  // namespace

std::shared_ptr<const GestureScorer> train_sequence_gesture_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop) {
  const StackedRows all = stack_rows(per_class);
  require(all.rows.cols() > kNumTrackColumns, "features need columns besides the hand's track");
  Pca pca =
      Pca::train(all.rows.leftCols(all.rows.cols() - kNumTrackColumns), options.num_components);
  std::vector<std::vector<MatrixF>> sequences(per_class.size());
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& g : per_class[c]) sequences[c].push_back(sequence_rows(g, pca));
  }
  auto models = train_sequence_scorer(sequences, model_options(options), should_stop);
  return std::make_shared<SequenceGestureScorer>(std::move(pca), std::move(models));
}

std::shared_ptr<const GestureScorer> extend_sequence_gesture_scorer(
    const GestureScorer& scorer, int index, const std::vector<MatrixF>& gestures,
    const StopCheck& should_stop) {
  return static_cast<const SequenceGestureScorer&>(scorer).with_class(index, gestures, should_stop);
}

std::shared_ptr<const GestureScorer> read_sequence_gesture_scorer(
    const ModelFile& file, const GestureRecognizerOptions& options, int num_classes) {
  Pca pca = Pca::read(file, "pca.");
  auto models = read_sequence_scorer(file, "movement.", model_options(options), num_classes,
                                     2 * (pca.num_components() + kNumTrackColumns));
  return std::make_shared<SequenceGestureScorer>(std::move(pca), std::move(models));
}

}  // namespace hri::detail
