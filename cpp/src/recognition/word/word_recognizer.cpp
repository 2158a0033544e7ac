// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_recognizer.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "hri/signal/stream/endpointer.hpp"

namespace hri {

const char* WordRecognizerOptions::conflict() const {
  if (min_snr_db > max_snr_db) return "min_snr_db must not exceed max_snr_db";
  return nullptr;
}

WordRecognizer::WordRecognizer(const WordRecognizerOptions& options,
                               std::vector<std::string> labels, MultiStreamScorer scorer,
                               WordVerifier verifier, const Calibration& calibration,
                               std::shared_ptr<const SpeechEmbedding> embedding,
                               HeldOutReport held_out)
    : options_(validated(options)),
      labels_(std::move(labels)),
      front_end_(options, 1, std::move(embedding)),
      scorer_(std::move(scorer)),
      verifier_(std::move(verifier)),
      calibration_(calibration),
      held_out_(std::move(held_out)) {
  require(labels_ == sorted_labels(labels_), "labels are not sorted");
  require(static_cast<std::size_t>(scorer_.num_classes()) == labels_.size(),
          "labels and the scorer's classes differ in number");
  require(scorer_.streams().size() == static_cast<std::size_t>(front_end_.num_streams()),
          "the scorer and the front end differ in their streams");
  require((scorer_.vectors() != nullptr) == (front_end_.embedding() != nullptr),
          "the scorer and the front end differ in their embedding");
  require(scorer_.vectors() == nullptr ||
              scorer_.vectors()->dim() == front_end_.embedding()->vector_size(),
          "the scorer and the embedding differ in the size of their vectors");
  require((scorer_.network() != nullptr) == options_.use_network,
          "the scorer and the options differ in their network");
}

WordRecognizer WordRecognizer::with_scorer(MultiStreamScorer scorer) const {
  return {options_, labels_, std::move(scorer), verifier_, calibration_, front_end_.embedding(),
          held_out_};
}

Decision WordRecognizer::recognise(Span<const float> audio, int sample_rate_hz) const {
  return decide(front_end_.process(audio, sample_rate_hz));
}

Decision WordRecognizer::decide(const WordFeatures& word) const {
  Decision decision;
  if (word.has_speech()) {
    const VectorF scores = scorer_.scores(word.streams);
    decision = calibration_.decide(scores, verification_score(word.streams, scores), labels_);
  }
  decision.notes = word.notes;
  return decision;
}

std::vector<UtteranceDecision> WordRecognizer::recognise_utterances(Span<const float> audio,
                                                                    int sample_rate_hz) const {
  EndpointerOptions options;
  options.activity = options_.activity;
  Endpointer endpointer(sample_rate_hz, options);
  std::vector<UtteranceDecision> result;
  const auto add = [&](const Endpoint& event) {
    if (event.kind != EndpointKind::speech_end) return;
    // With the noise around it, from which the front end finds the end points as in training.
    const auto segment =
        audio.subspan(event.segment_first, event.segment_last - event.segment_first);
    result.push_back({static_cast<double>(event.first) / sample_rate_hz,
                      static_cast<double>(event.last) / sample_rate_hz,
                      recognise(segment, sample_rate_hz)});
  };
  Endpoint event;
  for (std::size_t at = 0; at < audio.size();) {
    at += endpointer.consume(audio.subspan(at, audio.size() - at), &event);
    add(event);
  }
  while ((event = endpointer.finish()).kind != EndpointKind::none) add(event);
  return result;
}

VectorF WordRecognizer::scores(Span<const float> audio, int sample_rate_hz) const {
  const WordFeatures word = front_end_.process(audio, sample_rate_hz);
  if (!word.has_speech()) fail(ErrorKind::invalid_argument, "audio has no speech in it");
  return scorer_.scores(word.streams);
}

float WordRecognizer::verification_score(const StreamFrames& frames, const VectorF& scores) const {
  const WordEvidence evidence = WordVerifier::evidence(scorer_, frames, scores);
  return verifier_.verification_score(WordVerifier::features(scorer_, frames, evidence));
}

void WordRecognizer::save(const std::string& path) const { to_model_file().write(path); }

WordRecognizer WordRecognizer::load(const std::string& path,
                                    std::shared_ptr<const SpeechEmbedding> embedding) {
  return from_model_file(ModelFile::read(path), std::move(embedding));
}

}  // namespace hri
