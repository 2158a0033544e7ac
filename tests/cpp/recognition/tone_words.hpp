// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gliding tones that stand for words.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri::testing_data {

constexpr int kRateHz = 16000;

// A gliding tone between pauses.
inline std::vector<float> tone(double base_hz, double slope_hz_per_s, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> x(kRateHz);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double t = static_cast<double>(n) / kRateHz - 0.25;
    const bool sounds = t >= 0 && t < 0.5;
    const double phase = 6.283185307 * (base_hz * t + 0.5 * slope_hz_per_s * t * t);
    x[n] = static_cast<float>((sounds ? 0.3 * std::sin(phase) : 0.0) + 0.001 * random.normal());
  }
  return x;
}

struct Clips {
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
};

// Rising and falling tones by three persons, three takes each.
inline Clips tone_clips() {
  Clips result;
  result.audio.reserve(18);
  std::uint64_t seed = 0;
  for (const char* person : {"low", "middle", "high"}) {
    const double base_hz = 500 + 50.0 * static_cast<double>(seed / 6);
    for (int take = 0; take < 3; ++take) {
      for (const bool rises : {true, false}) {
        result.audio.push_back(tone(base_hz, rises ? 800 : -350, seed++));
        result.samples.push_back({result.audio.back(), kRateHz, rises ? "rise" : "fall", person});
      }
    }
  }
  return result;
}

}  // namespace hri::testing_data
