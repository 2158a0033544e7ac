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
constexpr int kNotTrusted = -1;

void check(const SpeakerAdapterOptions& o) {
  require(o.words_per_label >= 0 && o.words_per_label <= 1000,
          "words_per_label must lie in 0..1000");
  require(o.shared_frames > 0 && std::isfinite(o.shared_frames),
          "shared_frames must be finite and positive");
  require(o.prior_frames > 0 && std::isfinite(o.prior_frames),
          "prior_frames must be finite and positive");
  require(o.num_iterations >= 1 && o.num_iterations <= 1000, "num_iterations must lie in 1..1000");
  require(o.trusted_share >= 0 && o.trusted_share <= 1, "trusted_share must lie in 0..1");
  require(o.max_words >= 1 && o.max_words <= 100000, "max_words must lie in 1..100000");
}

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
    : options_(options), base_(std::move(recognizer)), adapted_(base_) {
  check(options);
  require(base_.options().models.model == SequenceModelKind::hmm,
          "only recognisers of the model hmm adapt, this one is ptbhmm");
}

Decision SpeakerAdapter::recognise(Span<const float> samples, int sample_rate_hz) {
  std::vector<MatrixF> frames;
  Decision decision = adapted_.recognise(samples, sample_rate_hz, &frames);
  if (!frames.empty()) remember({std::move(frames), kNotTrusted});
  return decision;
}

void SpeakerAdapter::learn(Span<const float> samples, int sample_rate_hz,
                           const std::string& label) {
  const std::vector<std::string>& labels = base_.labels();
  const auto found = std::lower_bound(labels.begin(), labels.end(), label);
  if (found == labels.end() || *found != label)
    fail(ErrorKind::invalid_argument, "the recogniser has no word '" + label + "'");
  const std::vector<float> word = base_.locate(samples, sample_rate_hz, nullptr);
  if (word.empty()) fail(ErrorKind::invalid_argument, "no speech found in the audio");
  remember({base_.frames(word), static_cast<int>(found - labels.begin())});
}

void SpeakerAdapter::remember(Word word) {
  words_.push_back(std::move(word));
  if (num_words() > options_.max_words) words_.pop_front();
  ++num_new_;
}

bool SpeakerAdapter::update_due() const {
  return num_new_ * kUpdateShare >= std::max(1, num_words());
}

// What every word is learned as: the name it was given, or what it is recognised as now if it is
// accepted and among the clearest.
std::vector<int> SpeakerAdapter::trusted_labels() const {
  std::vector<int> labels;
  std::vector<float> margins;  // a frame; of words not named
  std::vector<float> sorted;
  for (const Word& word : words_) {
    int label = word.label;
    float margin = 0;
    if (label < 0) {
      const VectorF scores = adapted_.score(word.frames);
      Eigen::Index best = 0;
      scores.maxCoeff(&best);
      const bool accepted = adapted_.verification_score(word.frames, scores) >=
                            static_cast<float>(base_.calibration().threshold());
      label = accepted ? static_cast<int>(best) : kNotTrusted;
      margin = margin_of(scores, best) / static_cast<float>(word.frames.front().rows());
      sorted.push_back(margin);
    }
    labels.push_back(label);
    margins.push_back(margin);
  }
  if (sorted.empty()) return labels;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const auto num_trusted = static_cast<std::size_t>(
      std::lround(options_.trusted_share * static_cast<double>(sorted.size())));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool named = words_[i].label >= 0;
    if (!named && (num_trusted == 0 || margins[i] < sorted[num_trusted - 1]))
      labels[i] = kNotTrusted;
  }
  return labels;
}

void SpeakerAdapter::update(const StopCheck& should_stop) {
  const std::vector<int> labels = trusted_labels();
  // Models adapted to a word or two each, beside others that heard none, are worse than before.
  const bool each_word = static_cast<double>(words_.size()) >=
                         options_.words_per_label * static_cast<double>(base_.labels().size());
  const AdaptationOptions adaptation{options_.shared_frames, options_.prior_frames,
                                     options_.num_iterations, each_word, should_stop};
  WordRecognizer next = base_;
  for (std::size_t s = 0; s < next.streams_.size(); ++s) {
    std::vector<std::vector<MatrixF>> per_label(base_.labels().size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] >= 0)
        per_label[static_cast<std::size_t>(labels[i])].push_back(words_[i].frames[s]);
    }
    next.streams_[s].models = base_.streams_[s].models.adapted(per_label, adaptation);
  }
  adapted_ = std::move(next);
  num_new_ = 0;
  num_learned_ = static_cast<int>(
      std::count_if(labels.begin(), labels.end(), [](int label) { return label != kNotTrusted; }));
}

void SpeakerAdapter::reset() {
  words_.clear();
  num_learned_ = 0;
  num_new_ = 0;
  adapted_ = base_;
}

}  // namespace hri
