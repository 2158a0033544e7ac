// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/speaker_adapter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kUpdateShare = 8;  // an update is due when one word in so many is new
constexpr int kNoLabel = -1;

// How far the best score lies above the second.
float margin_of(const VectorF& scores, Eigen::Index best) {
  float second = -1e30F;
  for (Eigen::Index c = 0; c < scores.size(); ++c) {
    if (c != best) second = std::max(second, scores[c]);
  }
  return scores[best] - second;
}

}  // namespace

SpeakerAdapter::SpeakerAdapter(WordRecognizer recognizer, const SpeakerAdapterOptions& options)
    : options_(validated(options)), base_(std::move(recognizer)), adapted_(base_) {
  require(base_.scorer().adapts(), "only recognisers of the model hmm adapt, this one is ptbhmm");
}

Decision SpeakerAdapter::recognise(Span<const float> audio, int sample_rate_hz) {
  WordFeatures word = adapted_.front_end().process(audio, sample_rate_hz);
  Decision decision = adapted_.decide(word);
  if (word.has_speech()) remember({std::move(word.streams), kNoLabel});
  return decision;
}

void SpeakerAdapter::learn(Span<const float> audio, int sample_rate_hz, const std::string& label) {
  const std::vector<std::string>& labels = base_.labels();
  const auto found = std::lower_bound(labels.begin(), labels.end(), label);
  if (found == labels.end() || *found != label)
    fail(ErrorKind::invalid_argument, "label '" + label + "' is not in the vocabulary");
  WordFeatures word = base_.front_end().process(audio, sample_rate_hz);
  if (!word.has_speech()) fail(ErrorKind::invalid_argument, "audio has no speech in it");
  remember({std::move(word.streams), static_cast<int>(found - labels.begin())});
}

void SpeakerAdapter::remember(Word word) {
  words_.push_back(std::move(word));
  if (num_words() > options_.max_words) words_.pop_front();
  ++num_new_;
}

bool SpeakerAdapter::update_due() const {
  return num_new_ * kUpdateShare >= std::max(1, num_words());
}

// The adapted recogniser's label of a word without one, and its margin a frame (of the embedding
// alone, whose only row is a vector, the margin itself); no label where it is rejected.
SpeakerAdapter::Guess SpeakerAdapter::guess(const Word& word) const {
  const VectorF scores = adapted_.scorer().scores(word.frames);
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  const bool accepted = adapted_.verification_score(word.frames, scores) >=
                        static_cast<float>(base_.calibration().threshold());
  return {accepted ? static_cast<int>(best) : kNoLabel,
          margin_of(scores, best) / static_cast<float>(word.frames.front().rows())};
}

// What every word is learned as: its label, or what it is recognised as if its margin is among the
// largest.
std::vector<int> SpeakerAdapter::trusted_labels() const {
  std::vector<Guess> guesses;
  std::vector<float> margins;  // of words without a label, falling
  for (const Word& word : words_) {
    guesses.push_back(word.label == kNoLabel ? guess(word) : Guess{word.label, 0});
    if (word.label == kNoLabel) margins.push_back(guesses.back().margin);
  }
  std::sort(margins.begin(), margins.end(), std::greater<>());
  const auto num_trusted = static_cast<std::size_t>(
      std::lround(options_.trusted_share * static_cast<double>(margins.size())));
  std::vector<int> labels;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const bool trusted = words_[i].label != kNoLabel ||
                         (num_trusted > 0 && guesses[i].margin >= margins[num_trusted - 1]);
    labels.push_back(trusted ? guesses[i].label : kNoLabel);
  }
  return labels;
}

void SpeakerAdapter::update(const StopCheck& should_stop) {
  const std::vector<int> labels = trusted_labels();
  ClassStreams sequences(base_.labels().size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != kNoLabel)
      sequences[static_cast<std::size_t>(labels[i])].push_back(&words_[i].frames);
  }
  // Models adapted to a word or two each, beside others that saw none, are worse than before.
  const bool each_class = static_cast<double>(words_.size()) >=
                          options_.words_per_label * static_cast<double>(base_.labels().size());
  const AdaptationOptions adaptation{options_.shared_frames, options_.prior_frames,
                                     options_.num_iterations, each_class, should_stop};
  adapted_ = base_.with_scorer(base_.scorer().adapted(sequences, adaptation));
  num_new_ = 0;
  num_learned_ = static_cast<int>(
      std::count_if(labels.begin(), labels.end(), [](int label) { return label != kNoLabel; }));
}

void SpeakerAdapter::reset() {
  words_.clear();
  num_learned_ = 0;
  num_new_ = 0;
  adapted_ = base_;
}

}  // namespace hri
