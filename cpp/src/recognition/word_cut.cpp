// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "word_cut.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hri/core/random.hpp"

namespace hri::detail {

std::vector<float> cut_word(Span<const float> audio, const SpeechBounds& speech,
                            std::size_t padding, double floor_db) {
  constexpr std::uint64_t kSeed = 1;
  constexpr double kRangeOfUnitPower = 3.4641016151377544;  // sqrt(12)
  const std::size_t before = std::min(padding, speech.first);
  const std::size_t after = std::min(padding, audio.size() - speech.last);
  std::vector<float> word(speech.last - speech.first + 2 * padding, 0.0F);
  std::copy(audio.begin() + static_cast<std::ptrdiff_t>(speech.first - before),
            audio.begin() + static_cast<std::ptrdiff_t>(speech.last + after),
            word.begin() + static_cast<std::ptrdiff_t>(padding - before));
  float peak = 0;
  for (std::size_t i = speech.first; i < speech.last; ++i)
    peak = std::max(peak, std::abs(audio[i]));
  const double gain =
      kRangeOfUnitPower * static_cast<double>(peak) * std::pow(10.0, -floor_db / 20);
  Random random(kSeed);
  for (float& x : word) x += static_cast<float>(gain * (random.uniform() - 0.5));
  return word;
}

}  // namespace hri::detail
