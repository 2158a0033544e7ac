// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/connected_word_stream.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"

namespace hri {
namespace {

constexpr double kShortestMs = 100;  // of an utterance that is searched before its end

void drop_first(std::size_t count, std::vector<TranscribedWord>* words) {
  const auto used = static_cast<std::ptrdiff_t>(std::min(count, words->size()));
  words->erase(words->begin(), words->begin() + used);
}

std::size_t samples_of(double ms, int rate_hz) {
  return static_cast<std::size_t>(ms * rate_hz / 1000);
}

}  // namespace

ConnectedWordStream::ConnectedWordStream(ConnectedWordRecognizer recognizer, int sample_rate_hz,
                                         const ConnectedWordStreamOptions& options,
                                         std::string wake_word)
    : recognizer_(std::move(recognizer)),
      sample_rate_hz_(sample_rate_hz),
      options_(validated(options)),
      wake_word_(std::move(wake_word)),
      endpointer_(sample_rate_hz, options.endpointer) {
  const std::vector<std::string>& labels = recognizer_.labels();
  if (!wake_word_.empty() && std::find(labels.begin(), labels.end(), wake_word_) == labels.end()) {
    fail(ErrorKind::invalid_argument, "wake_word is '" + wake_word_ + "', which is no label");
  }
}

std::vector<ConnectedWordResult> ConnectedWordStream::process(Span<const float> samples) {
  // Before any of them is taken: what ends within them would be lost.
  const std::size_t bad = first_not_finite(samples.data(), samples.size());
  if (bad < samples.size()) {
    fail(ErrorKind::invalid_argument,
         "audio is not finite at sample " + std::to_string(num_samples() + bad));
  }
  std::vector<ConnectedWordResult> results;
  while (!samples.empty()) {
    // Not beyond the next search, so that blocks of any size give the same.
    std::size_t count = samples.size();
    if (in_speech_ && next_search_ > num_samples())
      count = std::min(count, next_search_ - num_samples());
    Endpoint event;
    const std::size_t used = endpointer_.consume(samples.subspan(0, count), &event);
    kept_.insert(kept_.end(), samples.begin(), samples.begin() + used);
    samples = samples.subspan(used, samples.size() - used);
    handle(event, &results);
    if (in_speech_ && num_samples() >= next_search_) search_so_far(&results);
    drop_old();
  }
  return results;
}

std::vector<ConnectedWordResult> ConnectedWordStream::finish() {
  std::vector<ConnectedWordResult> results;
  for (Endpoint event = endpointer_.finish(); event.kind != EndpointKind::none;
       event = endpointer_.finish())
    handle(event, &results);
  kept_.clear();
  first_kept_ = 0;
  in_speech_ = false;
  return results;
}

void ConnectedWordStream::handle(const Endpoint& event, std::vector<ConnectedWordResult>* results) {
  if (event.kind == EndpointKind::none || event.kind == EndpointKind::speech_pause) return;
  in_speech_ = event.kind == EndpointKind::speech_start;
  last_decided_.clear();
  stable_.clear();
  if (in_speech_) {
    speech_first_ = event.first;
    next_search_ = num_samples() + samples_of(options_.partial_ms, sample_rate_hz_);
  }
  if (event.kind != EndpointKind::speech_end) return;
  ConnectedWordResult result;
  result.is_final = true;
  result.transcript = recognizer_.recognise(kept(event.segment_first, event.segment_last),
                                            sample_rate_hz_, {0, options_.num_alternatives});
  result.num_stable = static_cast<int>(result.transcript.words.size());
  result.last_s = static_cast<double>(event.last) / sample_rate_hz_;
  if (!place(event.segment_first, &result)) return;
  result.first_s = static_cast<double>(event.first) / sample_rate_hz_;
  result.num_stable = static_cast<int>(result.transcript.words.size());
  results->push_back(std::move(result));
}

void ConnectedWordStream::search_so_far(std::vector<ConnectedWordResult>* results) {
  const std::size_t now = num_samples();
  const std::size_t context = samples_of(options_.endpointer.context_ms, sample_rate_hz_);
  const std::size_t first = std::max(first_kept_, speech_first_ - std::min(context, speech_first_));
  const double length_ms = 1000.0 * static_cast<double>(now - first) / sample_rate_hz_;
  next_search_ = now + samples_of(std::max(options_.partial_ms, options_.partial_share * length_ms),
                                  sample_rate_hz_);
  if (length_ms < kShortestMs) return;
  ConnectedWordResult result;
  const ScoredRecording scored = recognizer_.score_begun(kept(first, now), sample_rate_hz_);
  if (scored.log_emissions.rows() == 0) return;
  std::size_t num_decided = 0;
  result.transcript = recognizer_.recognise_begun(scored, &num_decided);
  std::vector<std::string> decided;
  // NOLINTNEXTLINE(performance-inefficient-vector-operation): a sentence is short
  for (std::size_t i = 0; i < num_decided; ++i) decided.push_back(result.transcript.words[i].label);
  // What was decided twice, behind what was stable before.
  const auto same =
      std::mismatch(decided.begin(), decided.end(), last_decided_.begin(), last_decided_.end());
  const auto num_same = static_cast<std::size_t>(same.first - decided.begin());
  if (num_same > stable_.size() && std::equal(stable_.begin(), stable_.end(), decided.begin()))
    stable_.assign(decided.begin(), same.first);
  last_decided_ = std::move(decided);
  std::vector<TranscribedWord>& words = result.transcript.words;
  const bool agrees = words.size() >= stable_.size() &&
                      std::equal(stable_.begin(), stable_.end(), words.begin(),
                                 [](const std::string& label, const TranscribedWord& word) {
                                   return label == word.label;
                                 });
  if (!agrees) return;  // what was given last still stands
  result.num_stable = static_cast<int>(stable_.size());
  result.last_s = static_cast<double>(now) / sample_rate_hz_;
  if (!place(first, &result)) return;
  result.first_s = static_cast<double>(speech_first_) / sample_rate_hz_;
  results->push_back(std::move(result));
}

Span<const float> ConnectedWordStream::kept(std::size_t first, std::size_t last) const {
  first = std::max(first, first_kept_);
  last = std::max(first, std::min(last, first_kept_ + kept_.size()));
  return Span<const float>(kept_).subspan(first - first_kept_, last - first);
}

bool ConnectedWordStream::place(std::size_t first, ConnectedWordResult* result) const {
  const double first_s = static_cast<double>(std::max(first, first_kept_)) / sample_rate_hz_;
  Transcript& transcript = result->transcript;
  const auto shift = [first_s](std::vector<TranscribedWord>* words) {
    for (TranscribedWord& word : *words) {
      word.first_s += first_s;
      word.last_s += first_s;
    }
  };
  shift(&transcript.words);
  for (TranscriptAlternative& alternative : transcript.alternatives) shift(&alternative.words);
  if (!wake_word_.empty()) {
    const std::size_t num_dropped = num_to_wake_word(transcript.words);
    drop_first(num_dropped, &transcript.words);
    result->num_stable = std::max(0, result->num_stable - static_cast<int>(num_dropped));
    keep_behind_wake_word(num_dropped, &transcript.alternatives);
  }
  return !transcript.words.empty();
}

std::size_t ConnectedWordStream::num_to_wake_word(const std::vector<TranscribedWord>& words) const {
  const auto wake = std::find_if(words.begin(), words.end(), [this](const TranscribedWord& word) {
    return !word.unknown && word.label == wake_word_;
  });
  return static_cast<std::size_t>(wake - words.begin()) + (wake == words.end() ? 0 : 1);
}

void ConnectedWordStream::keep_behind_wake_word(
    std::size_t num_dropped_of_best, std::vector<TranscriptAlternative>* alternatives) const {
  const auto same_word = [](const TranscribedWord& a, const TranscribedWord& b) {
    return a.label == b.label;
  };
  std::vector<TranscriptAlternative> kept;
  for (TranscriptAlternative& alternative : *alternatives) {
    // The best is what was understood, cut where that is: it knows which words are unsure.
    const bool is_best = &alternative == &alternatives->front();
    std::vector<TranscribedWord>& words = alternative.words;
    drop_first(is_best ? num_dropped_of_best : num_to_wake_word(words), &words);
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const auto& other) {
      return std::equal(words.begin(), words.end(), other.words.begin(), other.words.end(),
                        same_word);
    });
    if (!words.empty() && is_new) kept.push_back(std::move(alternative));
  }
  *alternatives = std::move(kept);
}

// Before an utterance its context is needed, and the sounds that are not yet known to be one.
void ConnectedWordStream::drop_old() {
  const EndpointerOptions& options = options_.endpointer;
  const double longest_ms =
      options.max_utterance_ms + options.context_ms + 2 * options.hangover_ms + 2000;
  const std::size_t longest = samples_of(longest_ms, sample_rate_hz_);
  if (kept_.size() < 2 * longest) return;
  const std::size_t num_old = kept_.size() - longest;
  kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(num_old));
  first_kept_ += num_old;
}

}  // namespace hri
