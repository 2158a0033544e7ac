// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/simd.hpp"
#include "hri/core/error.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/gesture_verifier.hpp"

namespace hri {
namespace {

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

bool GestureRecognizer::starts_at_rest() const { return scorer_->starts_at_rest(); }
bool GestureRecognizer::pauses() const { return scorer_->pauses(); }

VectorF GestureRecognizer::scores(ConstMatrixRefF features) const {
  require(features.rows() > 0, "features must have at least one row");
  return scorer_->scores(features);
}

Decision GestureRecognizer::recognise_features(ConstMatrixRefF features) const {
  if (features.rows() == 0) return {};
  const VectorF s = scores(features);
  const float score = verifier_.dim() == 0 ? scorer_->verification_score(features, s)
                                           : log_odds(verifier_, scorer_->marks(features, s));
  return calibration_.decide(s, score, labels_);
}

Decision GestureRecognizer::recognise(const std::vector<HandImage>& frames) const {
  return recognise_features(features(frames, options_.features));
}

void GestureRecognizer::save(const std::string& path) const { to_model_file().write(path); }

GestureRecognizer GestureRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

}  // namespace hri
