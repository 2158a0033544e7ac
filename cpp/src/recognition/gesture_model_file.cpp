// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// GestureRecognizer to and from a model file.
#include "gesture_scorer.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/gesture_recognizer.hpp"
#include "option_fields.hpp"
#include "reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "gesture_recognizer";

// Only models of that kind, which older files have not, need these.
template <class V, class O>
void visit_rbf(V&& v, O& o) {
  v("rbf_cost", o.rbf_cost);
  v("rbf_sharpness", o.rbf_sharpness);
}

}  // namespace

ModelFile GestureRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::visit_gesture(detail::FieldWriter{file}, options_);
  detail::visit_descriptors(detail::FieldWriter{file}, options_);
  detail::FieldWriter{file}("source", options_.source);
  if (options_.model == GestureModel::rbf) visit_rbf(detail::FieldWriter{file}, options_);
  calibration_.write(file);
  scorer_->write(file);
  return file;
}

GestureRecognizer GestureRecognizer::from_model_file(const ModelFile& file) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  return detail::blaming(file, [&] { return read(file); });
}

GestureRecognizer GestureRecognizer::read(const ModelFile& file) {
  GestureRecognizer result;
  detail::visit_gesture(detail::FieldReader{file}, result.options_);
  if (file.has("features.use_wavelet"))
    detail::visit_descriptors(detail::FieldReader{file}, result.options_);
  // Files from before there was a choice are of silhouettes.
  if (file.has("source")) detail::FieldReader{file}("source", result.options_.source);
  if (result.options_.source > GestureSource::landmarks)
    fail(ErrorKind::format, file.name() + ": field 'source' is out of range");
  if (result.options_.model > GestureModel::rbf)
    fail(ErrorKind::format, file.name() + ": field 'model' is out of range");
  if (result.options_.model == GestureModel::rbf)
    visit_rbf(detail::FieldReader{file}, result.options_);
  static_cast<void>(HandFeatureComputer(result.options_.features));  // refuses options out of range
  result.labels_ = sorted_labels(file.text_list("labels"));
  if (result.labels_ != file.text_list("labels"))
    fail(ErrorKind::format, file.name() + ": labels are not sorted");
  result.calibration_ = Calibration::read(file);
  result.scorer_ =
      read_gesture_scorer(file, result.options_, static_cast<int>(result.labels_.size()));
  return result;
}

}  // namespace hri
