// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/word_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

// White noise correlates with itself by less than this; voices by more, also in noise.
constexpr float kVoicedAbove = 0.45F;
constexpr float kPitchExcessDb = 5;
// What stands clearly out of the noise needs less time to be believed.
constexpr float kClearFromDb = 15;
constexpr float kClearToDb = 25;
constexpr float kClearGain = 3;
// Quantiles of the level in a band: noise is what is there even in the quieter frames.
constexpr double kNoiseQuantile = 0.1;
constexpr double kSteadyQuantile = 0.25;
// Noise varies by this between the two; a band that varies more holds sound all the time.
constexpr float kNoiseSpreadDb = 2;
constexpr float kTrimmedDb = 8;
// What a frame of silence within a word costs at most, and a frame of sound is worth.
constexpr float kGapCostDb = 2;
constexpr float kSoundGainDb = 12;

}  // namespace

void check(const ActivityOptions& o, int sample_rate_hz) {
  require(sample_rate_hz >= 1000 && sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  validate(o);
}

Excess excess(const ActivityFrame& frame, const NoiseFloor& noise, const ActivityMeter& meter) {
  Excess result;
  float sum = 0;
  for (std::size_t b = 0; b < static_cast<std::size_t>(meter.num_bands()); ++b) {
    const float over = std::max(0.0F, frame.band_db[b] - noise[b]);
    sum += over * over;
    if (b < static_cast<std::size_t>(meter.num_low_bands()))
      result.low_db = std::max(result.low_db, over);
  }
  result.all_db = std::sqrt(sum / static_cast<float>(meter.num_bands()));
  return result;
}

float add_voicing(float sum, const ActivityFrame& frame, float low_excess_db) {
  float gain = frame.voicing - kVoicedAbove;
  if (gain > 0) {
    const float clear = (low_excess_db - kClearFromDb) / (kClearToDb - kClearFromDb);
    gain *= low_excess_db < kPitchExcessDb
                ? 0.0F
                : 1 + (kClearGain - 1) * std::max(0.0F, std::min(1.0F, clear));
  }
  return std::max(0.0F, sum + gain);
}

WordFinder::WordFinder(const ActivityMeter& meter, const ActivityOptions& options)
    : meter_(&meter), options_(options) {}

void WordFinder::reserve(std::size_t num_frames) {
  sorted_.reserve(num_frames);
  excess_.reserve(num_frames);
}

void WordFinder::measure_noise(Span<const ActivityFrame> frames) {
  sorted_.resize(frames.size());
  const auto quantile = [&](double q) {
    const auto at =
        sorted_.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(sorted_.size() - 1));
    std::nth_element(sorted_.begin(), at, sorted_.end());
    return *at;
  };
  // A clip shorter than the silence that a word may hold is all word.
  const bool trimmed = static_cast<double>(frames.size()) * options_.shift_ms < options_.max_gap_ms;
  for (std::size_t b = 0; b < static_cast<std::size_t>(meter_->num_bands()); ++b) {
    for (std::size_t t = 0; t < frames.size(); ++t) sorted_[t] = frames[t].band_db[b];
    const float noise = quantile(kNoiseQuantile);
    const float spread = quantile(kSteadyQuantile) - noise;
    // Where a clip is trimmed to its word, even its quiet frames are speech.
    noise_[b] = noise - std::max(0.0F, spread - kNoiseSpreadDb) +
                0.5F * std::min(spread, kNoiseSpreadDb) - (trimmed ? kTrimmedDb : 0.0F);
  }
}

WordFrames WordFinder::find(Span<const ActivityFrame> frames) {
  WordFrames word;
  if (frames.empty()) return word;
  measure_noise(frames);
  excess_.clear();
  for (const ActivityFrame& frame : frames) excess_.push_back(excess(frame, noise_, *meter_));

  // Speech is where voicing adds up; its level is that of its voiced frames.
  float voiced = 0;
  float peak_db = -120;
  std::size_t begin = 0;
  std::size_t first_voiced = frames.size();
  std::size_t last_voiced = 0;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const float sum = frames[t].level_db < static_cast<float>(options_.silence_dbfs)
                          ? 0
                          : add_voicing(voiced, frames[t], excess_[t].low_db);
    if (voiced == 0) begin = t;
    if (sum > voiced && sum >= static_cast<float>(options_.min_voicing)) {
      first_voiced = std::min(first_voiced, begin);
      last_voiced = t;
      for (std::size_t u = begin; u <= t; ++u) peak_db = std::max(peak_db, frames[u].level_db);
      begin = t;
    }
    voiced = sum;
  }
  if (first_voiced == frames.size()) return word;

  // From the voiced core outwards as far as the sound adds up to more than the silence before it.
  const float lowest_db = std::max(static_cast<float>(options_.silence_dbfs),
                                   peak_db - static_cast<float>(options_.max_depth_db));
  const auto gain = [&](std::size_t t) {
    const float above = std::min(excess_[t].all_db - static_cast<float>(options_.margin_db),
                                 frames[t].level_db - lowest_db);
    return std::max(-kGapCostDb, std::min(kSoundGainDb, above));
  };
  const auto max_gap = static_cast<std::size_t>(options_.max_gap_ms / options_.shift_ms);
  word.first = first_voiced;
  word.last = last_voiced + 1;
  float sum = 0;
  for (std::size_t next = word.first; next > 0 && word.first - next < max_gap; --next) {
    const std::size_t t = next - 1;
    sum += gain(t);
    if (sum > 0) word.first = t;
    sum = std::min(sum, 0.0F);
  }
  sum = 0;
  for (std::size_t t = word.last; t < frames.size() && t - word.last < max_gap; ++t) {
    sum += gain(t);
    if (sum > 0) word.last = t + 1;
    sum = std::min(sum, 0.0F);
  }
  word.found = true;
  word.num_utterances = count_utterances(frames, word, lowest_db);
  return word;
}

// An utterance has voicing enough of its own; max_gap_ms of silence, but for clicks of one frame,
// ends it.
int WordFinder::count_utterances(Span<const ActivityFrame> frames, const WordFrames& word,
                                 float lowest_db) const {
  const auto max_gap = static_cast<std::size_t>(options_.max_gap_ms / options_.shift_ms);
  int count = 0;
  std::size_t loud = 0;
  std::size_t quiet = 0;
  float voiced = 0;
  bool counted = false;
  for (std::size_t t = word.first; t < word.last; ++t) {
    const bool active = excess_[t].all_db > static_cast<float>(options_.margin_db) &&
                        frames[t].level_db > lowest_db;
    loud = active ? loud + 1 : 0;
    quiet = loud >= 2 ? 0 : quiet + 1;
    if (quiet > max_gap) {
      voiced = 0;
      counted = false;
      continue;
    }
    voiced = add_voicing(voiced, frames[t], excess_[t].low_db);
    if (counted || voiced < static_cast<float>(options_.min_voicing)) continue;
    counted = true;
    ++count;
  }
  return std::max(1, count);
}

SpeechBounds to_samples(const WordFrames& word, const ActivityMeter& meter,
                        const ActivityOptions& options, int sample_rate_hz,
                        std::size_t num_samples) {
  SpeechBounds bounds;
  if (!word.found) return bounds;
  const auto padding =
      static_cast<std::size_t>(std::lround(options.padding_ms * sample_rate_hz / 1000));
  const std::size_t first = word.first * meter.frame_shift();
  const std::size_t last = (word.last - 1) * meter.frame_shift() + meter.frame_length();
  bounds.first = first > padding ? first - padding : 0;
  bounds.last = std::min(num_samples, last + padding);
  bounds.found = true;
  bounds.num_utterances = word.num_utterances;
  return bounds;
}

}  // namespace hri::detail
