// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gestures added to a trained GestureRecognizer.
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kFewestFrames = 8;  // of a dynamic gesture

[[noreturn]] void refuse(std::size_t sample, const std::string& why) {
  fail(ErrorKind::invalid_argument, "samples[" + std::to_string(sample) + "]: " + why);
}

// The rows of the samples, checked to be of one gesture that is new.
std::vector<MatrixF> rows_of_new(const std::vector<GestureSample>& samples,
                                 const std::vector<std::string>& labels, bool dynamic) {
  require(!samples.empty(), "a new gesture needs at least one sample");
  const std::string& label = samples.front().label;
  require(!label.empty(), "label must not be empty");
  if (std::binary_search(labels.begin(), labels.end(), label))
    fail(ErrorKind::invalid_argument, "label '" + label + "' is in the vocabulary already");
  std::vector<MatrixF> result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const MatrixF& rows = samples[i].features;
    if (samples[i].label != label)
      refuse(i, "label '" + samples[i].label + "' differs from '" + label + "'");
    if (rows.rows() == 0) refuse(i, "no frame shows a hand");
    if (dynamic && rows.rows() < kFewestFrames) {
      refuse(i, std::to_string(rows.rows()) + " frames show a hand, a dynamic gesture needs " +
                    std::to_string(kFewestFrames));
    }
    validate_finite(rows, ("samples[" + std::to_string(i) + "]").c_str());
    result.push_back(rows);
  }
  return result;
}

}  // namespace

GestureRecognizer GestureRecognizer::with_gesture(const std::vector<GestureSample>& samples,
                                                  const StopCheck& should_stop) const {
  const std::vector<MatrixF> gestures = rows_of_new(samples, labels_, is_dynamic());
  GestureRecognizer result = *this;
  result.labels_.push_back(samples.front().label);
  result.labels_ = sorted_labels(result.labels_);
  const int index = label_index(result.labels_, samples.front().label);
  result.scorer_ = detail::extend_gesture_scorer(*scorer_, index, gestures, options_, should_stop);
  result.calibration_ = calibration_.with_class(index);
  return result;
}

}  // namespace hri
