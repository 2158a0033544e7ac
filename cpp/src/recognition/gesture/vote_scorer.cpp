// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Still signs: every frame in which the sign is held is classified by itself, and the scores are
// averaged. The last columns (the hand's track in the picture) are left out, so that it does not
// matter where a sign is shown.
#include <algorithm>
#include <cmath>
#include <optional>

#include "hri/core/error.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/classifiers/knn.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/pca.hpp"
#include "hri/models/classifiers/rbf_classifier.hpp"
#include "hri/recognition/gesture/key_frames.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri::detail {
namespace {

constexpr float kLeastDistance = 1e-3F;  // of a frame that was trained on

bool needs_components(GestureModel model) {
  return model == GestureModel::bayes || model == GestureModel::knn;
}

MatrixF held_rows(ConstMatrixRefF rows) {
  const FrameRange held = key_frames(rows, kNumTrackColumns);
  return rows.middleRows(held.first, held.last - held.first);
}

RbfClassifierOptions rbf_options(const GestureRecognizerOptions& options,
                                 const StopCheck& should_stop) {
  RbfClassifierOptions rbf;
  rbf.cost = options.rbf_cost;
  rbf.sharpness = options.rbf_sharpness;
  rbf.should_stop = should_stop;
  return rbf;
}

class VoteScorer : public GestureScorer {
 public:
  std::optional<Pca> pca;
  std::optional<LinearSvm> svm;
  std::optional<GaussianBayes> bayes;
  std::optional<Knn> knn;
  std::optional<RbfClassifier> rbf;
  Eigen::Index num_shape_columns = 0;

  [[nodiscard]] VectorF scores(ConstMatrixRefF rows) const override {
    const MatrixF shapes = shape_rows(rows);
    VectorF sum = frame_scores(row_span(shapes, 0));
    for (Eigen::Index t = 1; t < shapes.rows(); ++t) sum += frame_scores(row_span(shapes, t));
    return sum / static_cast<float>(shapes.rows());
  }

  [[nodiscard]] float verification_score(ConstMatrixRefF rows,
                                         const VectorF& scores) const override {
    if (rbf) {
      // Of what no gesture resembles, scores alone say too little: they fade towards the average.
      const VectorD all = confidence_features(rows, scores);
      return static_cast<float>(all[kScore] + all[kNearest]);
    }
    if (!knn) return scores.maxCoeff();
    const MatrixF shapes = shape_rows(rows);
    float sum = 0;
    for (Eigen::Index t = 0; t < shapes.rows(); ++t)
      sum -= knn->nearest_distance(row_span(shapes, t));
    return sum / static_cast<float>(shapes.rows());
  }

  [[nodiscard]] Eigen::Index num_confidence_features() const override {
    return rbf ? Eigen::Index{kNumConfidenceFeatures} : 0;
  }

  [[nodiscard]] VectorD confidence_features(ConstMatrixRefF rows,
                                            const VectorF& scores) const override {
    if (!rbf) return {};
    Eigen::Index best = 0;
    const float top = scores.maxCoeff(&best);
    VectorD result = VectorD::Zero(kNumConfidenceFeatures);
    result[kScore] = static_cast<double>(top);
    result[kMargin] = margin(scores, best);
    const MatrixF shapes = shape_rows(rows);
    const auto count = static_cast<double>(shapes.rows());
    for (Eigen::Index t = 0; t < shapes.rows(); ++t) {
      const RbfPlace place = rbf->place(row_span(shapes, t), static_cast<int>(best));
      result[kNearest] -= static_cast<double>(std::log(place.nearest + kLeastDistance)) / count;
      result[kCentre] -= static_cast<double>(std::log(place.centre + kLeastDistance)) / count;
      result[kAgreement] += static_cast<double>(place.agreement) / count;
    }
    return result;
  }

  void write(ModelFile& file) const override {
    file.set_integer("num_shape_columns", num_shape_columns);
    if (pca) pca->write(file, "pca.");
    if (svm) svm->write(file, "svm.");
    if (bayes) bayes->write(file, "bayes.");
    if (knn) knn->write(file, "knn.");
    if (rbf) rbf->write(file, "rbf.");
  }

  [[nodiscard]] int num_classes() const {
    if (svm) return svm->num_classes();
    if (rbf) return rbf->num_classes();
    return bayes ? bayes->num_classes() : knn->num_classes();
  }
  [[nodiscard]] int input_dim() const {
    if (pca) return pca->dim();
    if (rbf) return rbf->dim();
    return svm ? svm->dim() : -1;
  }

 private:
  // What a verifier weighs of the radial kernel's best class.
  enum ConfidenceFeature : Eigen::Index {
    kScore,
    kMargin,     // over the second class
    kNearest,    // -log of the distance to the frames nearest to it
    kCentre,     // and to the mean of them all
    kAgreement,  // share of it among the frames nearest of all
    kNumConfidenceFeatures,
  };

  [[nodiscard]] MatrixF shape_rows(ConstMatrixRefF rows) const {
    require(rows.cols() == num_shape_columns + kNumTrackColumns,
            "features have another number of columns than the model was trained on");
    const MatrixF shapes = held_rows(rows).leftCols(num_shape_columns);
    return pca ? pca->transform(shapes) : shapes;
  }
  [[nodiscard]] VectorF frame_scores(Span<const float> row) const {
    if (svm) return svm->decision_values(row);
    if (rbf) return rbf->decision_values(row);
    return bayes ? bayes->decision_values(row) : knn->decision_values(row);
  }
};

}  // namespace

std::shared_ptr<const GestureScorer> train_vote_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop) {
  auto scorer = std::make_shared<VoteScorer>();
  std::vector<std::vector<MatrixF>> held(per_class.size());
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& rows : per_class[c]) held[c].push_back(held_rows(rows));
  }
  const StackedRows all = stack_rows(held);
  require(all.rows.cols() > kNumTrackColumns, "features need columns besides the hand's track");
  scorer->num_shape_columns = all.rows.cols() - kNumTrackColumns;
  MatrixF shapes = all.rows.leftCols(scorer->num_shape_columns);
  const auto num_classes = static_cast<int>(per_class.size());
  if (needs_components(options.model)) {
    scorer->pca = Pca::train(shapes, options.num_components);
    shapes = scorer->pca->transform(shapes);
  }
  if (options.model == GestureModel::svm) {
    LinearSvmOptions svm;
    svm.cost = options.svm_cost;
    svm.seed = options.seed;
    svm.should_stop = should_stop;
    scorer->svm = LinearSvm::train(shapes, all.classes, num_classes, svm);
  } else if (options.model == GestureModel::rbf) {
    scorer->rbf =
        RbfClassifier::train(shapes, all.classes, num_classes, rbf_options(options, should_stop));
  } else if (options.model == GestureModel::bayes) {
    scorer->bayes = GaussianBayes::train(shapes, all.classes, num_classes, {});
  } else {
    KnnOptions knn;
    knn.num_neighbours = options.num_neighbours;
    scorer->knn = Knn::train(shapes, all.classes, num_classes, knn);
  }
  return scorer;
}

std::shared_ptr<const GestureScorer> extend_vote_scorer(const GestureScorer& scorer, int index,
                                                        const std::vector<MatrixF>& gestures,
                                                        const GestureRecognizerOptions& options,
                                                        const StopCheck& should_stop) {
  const auto& before = static_cast<const VoteScorer&>(scorer);
  if (!before.rbf && !before.knn) {
    fail(ErrorKind::invalid_argument,
         "the models svm and bayes keep no training rows, to which a gesture could be added: train "
         "again with it, or with the model rbf or knn");
  }
  std::vector<MatrixF> held;
  held.reserve(gestures.size());
  for (const MatrixF& rows : gestures) held.push_back(held_rows(rows));
  const StackedRows all = stack_rows({held});
  require(all.rows.cols() == before.num_shape_columns + kNumTrackColumns,
          "features do not have as many columns as the model was trained on");
  const MatrixF shapes = all.rows.leftCols(before.num_shape_columns);
  auto result = std::make_shared<VoteScorer>();
  result->num_shape_columns = before.num_shape_columns;
  result->pca = before.pca;
  if (before.knn) {
    result->knn = before.knn->with_class(index, before.pca->transform(shapes));
    return result;
  }
  result->rbf = before.rbf->with_class(index, shapes, rbf_options(options, should_stop));
  return result;
}

std::shared_ptr<const GestureScorer> read_vote_scorer(const ModelFile& file,
                                                      const GestureRecognizerOptions& options,
                                                      int num_classes) {
  auto scorer = std::make_shared<VoteScorer>();
  scorer->num_shape_columns = file.integer("num_shape_columns");
  if (needs_components(options.model)) scorer->pca = Pca::read(file, "pca.");
  if (options.model == GestureModel::svm) scorer->svm = LinearSvm::read(file, "svm.");
  if (options.model == GestureModel::bayes) scorer->bayes = GaussianBayes::read(file, "bayes.");
  if (options.model == GestureModel::knn) scorer->knn = Knn::read(file, "knn.");
  if (options.model == GestureModel::rbf) scorer->rbf = RbfClassifier::read(file, "rbf.");
  const int reduced = scorer->pca ? scorer->pca->num_components() : 0;
  const bool fits = scorer->num_classes() == num_classes &&
                    scorer->input_dim() == scorer->num_shape_columns &&
                    (!scorer->bayes || scorer->bayes->dim() == reduced) &&
                    (!scorer->knn || scorer->knn->dim() == reduced);
  if (!fits)
    fail(ErrorKind::format,
         file.name() + ": the classifier does not fit the labels or the features");
  return scorer;
}

}  // namespace hri::detail
