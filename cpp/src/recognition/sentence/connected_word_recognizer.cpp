// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/connected_word_recognizer.hpp"

#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "recognition/sentence/sentence_front_end.hpp"

namespace hri {
namespace {

constexpr int kMaxLength = 1000;

ConnectedWordRecognizerOptions with_rate(ConnectedWordRecognizerOptions options) {
  require(options.words.cepstra.sample_rate_hz != 0, "words.cepstra.sample_rate_hz is not set");
  return options;
}

}  // namespace

const char* ConnectedWordRecognizerOptions::conflict() const {
  if (words.model != SequenceModelKind::hmm) return "words.model must be hmm";
  if (words.front_end != FrontEndKind::cepstra) return "words.front_end must be cepstra";
  if (words.use_network) return "words.use_network must be false";
  return nullptr;
}

std::string Transcript::text() const {
  std::string text;
  for (const TranscribedWord& word : words) text += (text.empty() ? "" : " ") + word.label;
  return text;
}

ConnectedWordRecognizer::ConnectedWordRecognizer(const ConnectedWordRecognizerOptions& options,
                                                 std::vector<std::string> labels,
                                                 std::vector<GaussianMixtureHmm> models,
                                                 const VectorD& final_stays)
    : options_(with_rate(validated(options))),
      labels_(std::move(labels)),
      final_stays_(final_stays),
      front_end_(std::make_shared<const detail::SentenceFrontEnd>(options.words)),
      emissions_(std::make_shared<const GaussianEmissions>(std::move(models))) {
  require(labels_ == sorted_labels(labels_), "labels are not sorted");
  const std::size_t num_models = this->models().size();
  require(num_models == labels_.size() + 1, "models must be one a label, and one of silence");
  require(static_cast<std::size_t>(final_stays_.size()) == num_models,
          "final_stays must have a value for each model");
  require(emissions_->dim() == front_end_->num_features(),
          "the models and the front end differ in their features");
  for (std::size_t m = 0; m < num_models; ++m) {
    chains_.push_back(WordChain::of(this->models()[m].chain(),
                                    final_stays_[static_cast<Eigen::Index>(m)],
                                    m + 1 == num_models));
  }
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_language(NGramModel language) const {
  ConnectedWordRecognizer result = *this;
  result.language_ = std::make_shared<const NGramModel>(std::move(language));
  (void)result.network(0);  // refuses what cannot be decoded with
  return result;
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_decoder(
    const ConnectedDecoderOptions& decoder) const {
  ConnectedWordRecognizer result = *this;
  result.options_.decoder = validated(decoder);
  return result;
}

WordNetwork ConnectedWordRecognizer::network(int num_words) const {
  const auto num_labels = static_cast<int>(labels_.size());
  if (num_words != 0) return WordNetwork::sequence(num_labels, num_words, num_labels);
  if (language_ != nullptr) return WordNetwork::bigram(*language_, labels_, num_labels);
  return WordNetwork::loop(num_labels, num_labels);
}

Transcript ConnectedWordRecognizer::recognise(Span<const float> audio, int sample_rate_hz,
                                              int num_words) const {
  require(num_words >= 0 && num_words <= kMaxLength, "num_words must lie in 0..1000");
  detail::CutSentence sentence = front_end_->cut(audio, sample_rate_hz);
  Transcript transcript;
  transcript.notes = std::move(sentence.notes);
  if (sentence.samples.empty()) return transcript;
  const MatrixF frames = front_end_->frames(std::move(sentence.samples));
  MatrixF log_emissions(frames.rows(), emissions_->num_states());
  emissions_->compute(frames, log_emissions);
  ConnectedDecoder decoder(chains_, network(num_words), options_.decoder);
  for (Eigen::Index t = 0; t < frames.rows(); ++t) decoder.push(row_span(log_emissions, t));
  const DecodedSentence decoded = decoder.finish();
  transcript.complete = decoded.complete;
  transcript.log_score = decoded.log_score;
  // A word begins and ends in the middle between two frames.
  const auto seconds_of = [&](std::int64_t frame) {
    const double sample = static_cast<double>(sentence.offset) +
                          front_end_->middle_of(static_cast<double>(frame) - 0.5);
    return std::max(0.0, sample) / front_end_->sample_rate_hz();
  };
  for (const DecodedWord& word : decoded.words) {
    if (word.model == static_cast<int>(labels_.size())) continue;
    transcript.words.push_back({labels_[static_cast<std::size_t>(word.model)],
                                seconds_of(word.first_frame), seconds_of(word.last_frame),
                                word.log_score});
  }
  return transcript;
}

}  // namespace hri
