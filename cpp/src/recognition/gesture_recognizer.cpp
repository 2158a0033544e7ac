// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gesture_scorer.hpp"
#include "hri/core/error.hpp"
#include "hri/core/simd.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 5;

struct RowSums {
  int count = 0;
  int places = 0;  // of what is set
};

HRI_SIMD_CLONES RowSums sums_of(const std::uint8_t* row, int width) {
  RowSums s;
  for (int x = 0; x < width; ++x) {
    s.count += row[x] != 0 ? 1 : 0;
    s.places += row[x] != 0 ? x : 0;
  }
  return s;
}

// Centre (0..1 of the frame) and log of the share of the frame that the mask covers; false for an
// empty mask.
bool track_point(ImageView mask, float* out) {
  double sum = 0;
  double sum_x = 0;
  double sum_y = 0;
  for (int y = 0; y < mask.height_px; ++y) {
    const RowSums row = sums_of(mask.row(y), mask.width_px);
    sum += row.count;
    sum_x += row.places;
    sum_y += static_cast<double>(row.count) * y;
  }
  if (sum == 0) return false;
  out[0] = static_cast<float>((sum_x / sum + 0.5) / mask.width_px);
  out[1] = static_cast<float>((sum_y / sum + 0.5) / mask.height_px);
  out[2] =
      static_cast<float>(std::log(sum / (static_cast<double>(mask.width_px) * mask.height_px)));
  return true;
}

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
  if (most) return GestureModel::path;
  // The time of rbf grows with the cube of the frames.
  constexpr Eigen::Index kMostFrames = 3000;
  Eigen::Index num_frames = 0;
  for (const GestureSample& s : samples) num_frames += s.features.rows();
  return num_frames > kMostFrames ? GestureModel::svm : GestureModel::rbf;
}

bool any_empty(const std::vector<std::vector<MatrixF>>& per_class) {
  return std::any_of(per_class.begin(), per_class.end(),
                     [](const auto& list) { return list.empty(); });
}

}  // namespace

MatrixF GestureRecognizer::features(const std::vector<HandImage>& frames,
                                    const HandFeatureOptions& options) {
  const HandFeatureComputer computer(options);
  const auto shape_columns = static_cast<std::size_t>(computer.num_features());
  MatrixF rows(static_cast<Eigen::Index>(frames.size()),
               static_cast<Eigen::Index>(shape_columns) + detail::kNumTrackColumns);
  Eigen::Index used = 0;
  for (const HandImage& frame : frames) {
    if (frame.mask.empty()) continue;
    float* row = rows.data() + used * rows.cols();
    if (!track_point(frame.mask, row + shape_columns)) continue;
    computer.compute(frame.grey, frame.mask, Span<float>(row, shape_columns));
    ++used;
  }
  return rows.topRows(used);
}

GestureRecognizer GestureRecognizer::train(const std::vector<GestureSample>& samples,
                                           const GestureRecognizerOptions& options,
                                           const TrainingProgress& progress,
                                           const StopCheck& should_stop) {
  GestureRecognizer result;
  result.options_ = options;
  if (options.model == GestureModel::automatic) result.options_.model = model_for(samples);
  result.labels_ = labels_of(samples);
  std::vector<int> classes;
  std::vector<std::string> groups;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    require_finite(samples[i].features, i);
    classes.push_back(label_index(result.labels_, samples[i].label));
    groups.push_back(samples[i].group);
  }
  const std::vector<int> folds = held_out_folds(classes, groups, kMaxFolds);
  const auto all = by_class(samples, classes, folds, result.labels_.size(), -1);
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (all[c].empty()) {
      fail(ErrorKind::invalid_argument, "label '" + result.labels_[c] + "': no frame shows a hand");
    }
  }
  const int num_folds = *std::max_element(folds.begin(), folds.end()) + 1;
  std::vector<HeldOut> held_out;
  for (int fold = 0; fold < num_folds; ++fold) {
    if (progress) progress(fold, num_folds + 1);
    const auto rest = by_class(samples, classes, folds, result.labels_.size(), fold);
    if (any_empty(rest)) continue;  // without every class there is nothing to calibrate on
    const auto scorer = train_gesture_scorer(rest, result.options_, should_stop);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (folds[i] != fold || samples[i].features.rows() == 0) continue;
      const VectorF scores = scorer->scores(samples[i].features);
      held_out.push_back({scores, classes[i], scorer->evidence(samples[i].features, scores)});
    }
  }
  if (progress) progress(num_folds, num_folds + 1);
  result.scorer_ = train_gesture_scorer(all, result.options_, should_stop);
  result.calibration_ = Calibration::fit(held_out, options.false_reject_rate);
  if (progress) progress(num_folds + 1, num_folds + 1);
  return result;
}

bool GestureRecognizer::starts_at_rest() const { return scorer_->starts_at_rest(); }
bool GestureRecognizer::pauses() const { return scorer_->pauses(); }

VectorF GestureRecognizer::scores(ConstMatrixRefF features) const {
  require(features.rows() > 0, "features must have at least one row");
  return scorer_->scores(features);
}

Decision GestureRecognizer::recognise_features(ConstMatrixRefF features) const {
  if (features.rows() == 0) return {};
  const VectorF s = scores(features);
  return calibration_.decide(s, scorer_->evidence(features, s), labels_);
}

Decision GestureRecognizer::recognise(const std::vector<HandImage>& frames) const {
  return recognise_features(features(frames, options_.features));
}

void GestureRecognizer::save(const std::string& path) const { to_model_file().write(path); }

GestureRecognizer GestureRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

}  // namespace hri
