// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_front_end.hpp"

#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/word/word_trimming.hpp"

namespace hri {
namespace {

std::string resampling_note(int from_hz, int to_hz) {
  return "resampled from " + std::to_string(from_hz) + " to " + std::to_string(to_hz) + " Hz";
}

std::string utterances_note(int count) {
  return std::to_string(count) + " utterances, recognised as one word";
}

// Before resampling, after which neither the index nor the rate would be the caller's.
void check(Span<const float> audio, int sample_rate_hz) {
  if (sample_rate_hz < 1000 || sample_rate_hz > 384000) {
    fail(ErrorKind::invalid_argument,
         "sample_rate_hz is " + std::to_string(sample_rate_hz) + ", must lie in 1000..384000");
  }
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size())
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
}

}  // namespace

WordFrontEnd::WordFrontEnd(const WordRecognizerOptions& options, double warp_factor,
                           std::shared_ptr<const SpeechEmbedding> embedding)
    : sample_rate_hz_(options.cepstra.sample_rate_hz),
      activity_(options.activity),
      trim_(options.trim),
      noise_floor_db_(options.noise_floor_db),
      embedding_(std::move(embedding)) {
  if (has_embedding(options.front_end) && embedding_ == nullptr) {
    fail(ErrorKind::invalid_argument, std::string("front_end ") + enum_name(options.front_end) +
                                          " needs the weights of a speech embedding");
  }
  require(has_embedding(options.front_end) || embedding_ == nullptr,
          "front_end cepstra takes no speech embedding");
  if (options.use_network) spectrogram_ = std::make_shared<const WordSpectrogram>(sample_rate_hz_);
  if (!has_cepstra(options.front_end)) return;
  CepstraOptions cepstra = options.cepstra;
  cepstra.warp *= warp_factor;
  streams_.emplace_back(cepstra);
  if (!options.level_stream) return;
  cepstra.normalisation = Normalisation::level;
  streams_.emplace_back(cepstra);
}

WordFeatures WordFrontEnd::process(Span<const float> audio, int sample_rate_hz) const {
  TrimmedWord word = trim(audio, sample_rate_hz);
  WordFeatures features;
  if (word.has_speech()) features.streams = frames(word);
  features.notes = std::move(word.notes);
  return features;
}

TrimmedWord WordFrontEnd::trim(Span<const float> audio, int sample_rate_hz) const {
  TrimmedWord word;
  std::vector<float> resampled;
  if (sample_rate_hz != sample_rate_hz_) {
    check(audio, sample_rate_hz);
    resampled = resample(audio, sample_rate_hz, sample_rate_hz_);
    audio = resampled;
    word.notes.push_back(resampling_note(sample_rate_hz, sample_rate_hz_));
  }
  ActivityOptions unpadded = activity_;
  unpadded.padding_ms = 0;
  const SpeechBounds speech = find_speech(audio, sample_rate_hz_, unpadded);
  if (!speech.found) return word;
  if (speech.num_utterances > 1) word.notes.push_back(utterances_note(speech.num_utterances));
  word.samples = cut(audio, speech, activity_.padding_ms);
  if (embedding_ != nullptr)
    word.wide = cut(audio, speech, embedding_->options().activity.padding_ms);
  // End points in noise come closer to the middle of the word; what lies around it is read, too.
  if (spectrogram_ != nullptr)
    word.window = spectrogram_->window(audio, (speech.first + speech.last) / 2);
  return word;
}

std::vector<float> WordFrontEnd::cut(Span<const float> audio, const SpeechBounds& speech,
                                     double padding_ms) const {
  if (!trim_) return {audio.begin(), audio.end()};
  ActivityOptions activity = activity_;
  activity.padding_ms = padding_ms;
  return detail::trim_to_word(audio, speech, sample_rate_hz_, activity, noise_floor_db_);
}

TrimmedWord WordFrontEnd::untrimmed(std::vector<float> audio) const {
  TrimmedWord word;
  if (spectrogram_ != nullptr) word.window = spectrogram_->window(audio, audio.size() / 2);
  if (embedding_ != nullptr) {
    const double beyond_ms = embedding_->options().activity.padding_ms - activity_.padding_ms;
    const auto beyond = static_cast<std::size_t>(std::max(0.0, beyond_ms) * sample_rate_hz_ / 1000);
    word.wide.assign(audio.size() + 2 * beyond, 0.0F);
    std::copy(audio.begin(), audio.end(), word.wide.begin() + static_cast<std::ptrdiff_t>(beyond));
  }
  word.samples = std::move(audio);
  return word;
}

StreamFrames WordFrontEnd::frames(const TrimmedWord& word) const {
  StreamFrames result;
  result.reserve(streams_.size());
  for (const CepstraComputer& stream : streams_) result.push_back(stream.compute(word.samples));
  if (embedding_ != nullptr)
    result.emplace_back(embedding_->vector_of(word.wide, sample_rate_hz_).transpose());
  if (spectrogram_ != nullptr) result.push_back(WordSpectrogram::input(word.window));
  return result;
}

bool WordFrontEnd::is_long_enough(std::size_t num_samples) const {
  return num_samples > 0 && (streams_.empty() || streams_.front().num_frames(num_samples) > 0);
}

}  // namespace hri
