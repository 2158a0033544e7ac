// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_recognizer.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/gesture_verifier.hpp"

namespace hri {
MatrixF GestureRecognizer::features(const std::vector<HandImage>& frames,
                                    const HandFeatureOptions& options) {
  return GestureFeatureComputer(options, 0).compute(frames);
}

bool GestureRecognizer::is_dynamic() const {
  return options_.model == GestureModel::trajectory || options_.model == GestureModel::hmm ||
         options_.model == GestureModel::ptbhmm;
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
  const float score = verifier_.dim() == 0
                          ? scorer_->verification_score(features, s)
                          : detail::log_odds(verifier_, scorer_->confidence_features(features, s));
  return calibration_.decide(s, score, labels_);
}

Decision GestureRecognizer::recognise(Span<const HandObservation> hands) const {
  return recognise_features(front_end_->compute(hands));
}

Decision GestureRecognizer::recognise(Span<const ImageView> clip, const HandSource& source) const {
  return recognise(source.find(clip));
}

void GestureRecognizer::save(const std::string& path) const { to_model_file().write(path); }

GestureRecognizer GestureRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

}  // namespace hri
