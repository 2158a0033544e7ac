// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/sentence_front_end.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/word/word_trimming.hpp"

namespace hri::detail {
namespace {

ActivityOptions without_padding(ActivityOptions activity) {
  activity.padding_ms = 0;
  return activity;
}

// An embedding reads whole words, and no frames.
WordRecognizerOptions of_cepstra(WordRecognizerOptions options) {
  options.front_end = FrontEndKind::cepstra;
  return options;
}

}  // namespace

void check_recording(Span<const float> audio, int sample_rate_hz) {
  if (sample_rate_hz < 1000 || sample_rate_hz > 384000) {
    fail(ErrorKind::invalid_argument,
         "sample_rate_hz is " + std::to_string(sample_rate_hz) + ", must lie in 1000..384000");
  }
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size())
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
}

SentenceFrontEnd::SentenceFrontEnd(const WordRecognizerOptions& options, double warp_factor)
    : words_(of_cepstra(options), warp_factor),
      activity_(without_padding(options.activity)),
      noise_floor_db_(options.noise_floor_db),
      frame_shift_(options.cepstra.samples_of(options.cepstra.frame_shift_ms)),
      frame_length_(options.cepstra.samples_of(options.cepstra.frame_length_ms)),
      is_centred_(options.cepstra.padding == FramePadding::centred) {}

std::size_t SentenceFrontEnd::samples_of(double ms) const {
  return static_cast<std::size_t>(ms * sample_rate_hz() / 1000);
}

double SentenceFrontEnd::middle_of(double t) const {
  return t * frame_shift_ + (is_centred_ ? 0.0 : 0.5 * frame_length_);
}

CutSentence SentenceFrontEnd::cut(Span<const float> audio, int sample_rate_hz) const {
  check_recording(audio, sample_rate_hz);
  CutSentence result;
  const int rate_hz = this->sample_rate_hz();
  std::vector<float> resampled;
  if (sample_rate_hz != rate_hz) {
    resampled = resample(audio, sample_rate_hz, rate_hz);
    audio = resampled;
    result.notes.push_back("resampled from " + std::to_string(sample_rate_hz) + " to " +
                           std::to_string(rate_hz) + " Hz");
  }
  const SpeechBounds speech = find_speech(audio, rate_hz, activity_);
  if (!speech.found) return result;
  const std::size_t edge = samples_of(kEdgeMs);
  const std::size_t first = speech.first - std::min(edge, speech.first);
  const std::size_t last = std::min(audio.size(), speech.last + edge);
  result.offset = static_cast<std::int64_t>(speech.first) - static_cast<std::int64_t>(edge);
  result.samples.assign(speech.last - speech.first + 2 * edge, 0.0F);
  std::copy(audio.begin() + static_cast<std::ptrdiff_t>(first),
            audio.begin() + static_cast<std::ptrdiff_t>(last),
            result.samples.begin() + static_cast<std::ptrdiff_t>(edge - (speech.first - first)));
  add_floor(&result.samples);
  const std::size_t around = samples_of(kAroundMs);
  result.recorded_offset = speech.first - std::min(around, speech.first);
  result.recorded.assign(
      audio.begin() + static_cast<std::ptrdiff_t>(result.recorded_offset),
      audio.begin() + static_cast<std::ptrdiff_t>(std::min(audio.size(), speech.last + around)));
  return result;
}

void SentenceFrontEnd::add_floor(std::vector<float>* audio) const {
  float peak = 0;
  for (const float x : *audio) peak = std::max(peak, std::abs(x));
  add_noise_floor(static_cast<double>(peak) * std::pow(10.0, -noise_floor_db_ / 20), audio);
}

MatrixF SentenceFrontEnd::frames(std::vector<float> audio) const {
  const StreamFrames streams = words_.frames(words_.untrimmed(std::move(audio)));
  MatrixF result(streams.front().rows(), num_features());
  Eigen::Index column = 0;
  for (const MatrixF& stream : streams) {
    result.middleCols(column, stream.cols()) = stream;
    column += stream.cols();
  }
  return result;
}

}  // namespace hri::detail
