// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_recognizer.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "hri/features/hand/pair_rows.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/gesture_verifier.hpp"

namespace hri {
namespace {

void require_silhouettes(const GestureRecognizerOptions& options) {
  require(options.source == GestureSource::silhouettes,
          "the recogniser is one of landmarks, which masks of hands do not give");
}

}  // namespace

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
  return calibration_.decide(s, detail::verified_score(verifier_, *scorer_, features, s), labels_);
}

MatrixF GestureRecognizer::features(Span<const ImageView> clip, const HandSource& source,
                                    const GestureRecognizerOptions& options) {
  const GestureFeatureComputer computer(options.features, options.min_quality);
  if (options.num_hands == 1)
    return computer.compute(Span<const HandObservation>(source.find(clip)));
  const auto sides = source.find_pair(clip);
  return pair_rows(computer.compute_every(sides[0]), computer.compute_every(sides[1]),
                   options.relation_weight);
}

Decision GestureRecognizer::recognise(Span<const HandObservation> hands) const {
  require(options_.num_hands == 1, "the recogniser is one of both hands: give left and right");
  require_silhouettes(options_);
  return recognise_features(front_end_->compute(hands));
}

Decision GestureRecognizer::recognise(Span<const HandObservation> left,
                                      Span<const HandObservation> right) const {
  require(options_.num_hands == 2, "the recogniser is one of one hand: give one");
  require_silhouettes(options_);
  return recognise_features(pair_rows(front_end_->compute_every(left),
                                      front_end_->compute_every(right), options_.relation_weight));
}

Decision GestureRecognizer::recognise(Span<const ImageView> clip, const HandSource& source) const {
  if (options_.num_hands == 1) return recognise(source.find(clip));
  const auto sides = source.find_pair(clip);
  return recognise(sides[0], sides[1]);
}

void GestureRecognizer::save(const std::string& path) const { to_model_file().write(path); }

GestureRecognizer GestureRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

}  // namespace hri
