// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// GestureRecognizer to and from a model file.
#include "hri/core/error.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/gesture_verifier.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "gesture_recognizer";

}  // namespace

ModelFile GestureRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  calibration_.write(file);
  held_out_.write(file);
  detail::write_gesture_verifier(verifier_, file);
  scorer_->write(file);
  return file;
}

GestureRecognizer GestureRecognizer::from_model_file(const ModelFile& file) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  return detail::with_context(file, [&] { return read(file); });
}

GestureRecognizer GestureRecognizer::read(const ModelFile& file) {
  GestureRecognizer result;
  detail::read_options(file, &result.options_);
  if (result.options_.model == GestureModel::automatic)
    fail(ErrorKind::format, file.name() + ": field 'model' is 'automatic': training decides it");
  result.front_end_.emplace(result.options_.features, result.options_.min_quality);
  result.labels_ = sorted_labels(file.text_list("labels"));
  if (result.labels_ != file.text_list("labels"))
    fail(ErrorKind::format, file.name() + ": labels are not sorted");
  result.calibration_ = Calibration::read(file);
  result.held_out_ = HeldOutReport::read(file);
  result.scorer_ =
      detail::read_gesture_scorer(file, result.options_, static_cast<int>(result.labels_.size()));
  result.verifier_ = detail::read_gesture_verifier(file, result.scorer_->num_confidence_features());
  file.require_all_read();
  return result;
}

}  // namespace hri
