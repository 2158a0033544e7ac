// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/training_noise.hpp"

#include <cmath>

namespace hri::detail {

std::vector<float> with_noise(Span<const float> word, double snr_db, Random* random) {
  const double pole = 0.97 * random->uniform();
  std::vector<double> noise(word.size());
  double state = 0;
  double noise_power = 0;
  double power = 0;
  for (std::size_t n = 0; n < noise.size(); ++n) {
    state = pole * state + random->normal();
    noise[n] = state;
    noise_power += state * state;
    power += static_cast<double>(word[n]) * word[n];
  }
  const double gain =
      noise_power > 0 ? std::sqrt(power / noise_power * std::pow(10.0, -snr_db / 10.0)) : 0.0;
  std::vector<float> result(word.size());
  for (std::size_t n = 0; n < noise.size(); ++n)
    result[n] = word[n] + static_cast<float>(gain * noise[n]);
  return result;
}

}  // namespace hri::detail
