// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_trimming.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hri/core/random.hpp"

namespace hri::detail {
namespace {

constexpr double kMarginMs =
    100;  // beyond the padding, in which the detector measures the noise floor

// Samples [bounds.first - margin, bounds.last + margin), zero where there are none.
std::vector<float> around(Span<const float> audio, const SpeechBounds& bounds, std::size_t margin) {
  const std::size_t before = std::min(margin, bounds.first);
  const std::size_t after = std::min(margin, audio.size() - bounds.last);
  std::vector<float> result(bounds.last - bounds.first + 2 * margin, 0.0F);
  std::copy(audio.begin() + static_cast<std::ptrdiff_t>(bounds.first - before),
            audio.begin() + static_cast<std::ptrdiff_t>(bounds.last + after),
            result.begin() + static_cast<std::ptrdiff_t>(margin - before));
  return result;
}

}  // namespace

void add_noise_floor(double deviation, std::vector<float>* audio) {
  constexpr std::uint64_t kSeed = 1;
  constexpr double kRangeOfUnitPower = 3.4641016151377544;  // sqrt(12)
  Random random(kSeed);
  for (float& x : *audio)
    x += static_cast<float>(kRangeOfUnitPower * deviation * (random.uniform() - 0.5));
}

std::vector<float> trim_to_word(Span<const float> audio, const SpeechBounds& speech,
                                int sample_rate_hz, const ActivityOptions& activity,
                                double noise_floor_db) {
  float peak = 0;
  for (std::size_t i = speech.first; i < speech.last; ++i)
    peak = std::max(peak, std::abs(audio[i]));
  const auto margin =
      static_cast<std::size_t>((activity.padding_ms + kMarginMs) * sample_rate_hz / 1000);
  std::vector<float> word = around(audio, speech, margin);
  add_noise_floor(static_cast<double>(peak) * std::pow(10.0, -noise_floor_db / 20), &word);
  // End points depend on the noise around the word, which is the noise floor from here on.
  SpeechBounds bounds = find_speech(word, sample_rate_hz, activity);
  if (!bounds.found) bounds = {margin, word.size() - margin, true, 1};
  word.erase(word.begin() + static_cast<std::ptrdiff_t>(bounds.last), word.end());
  word.erase(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(bounds.first));
  return word;
}

}  // namespace hri::detail
