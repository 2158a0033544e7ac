// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/training_noise.hpp"

#include <cmath>

#include "core/normal_kernels.hpp"

namespace hri::detail {

double mean_power(Span<const float> audio) {
  double sum = 0;
  for (const float x : audio) sum += static_cast<double>(x) * x;
  return audio.empty() ? 0 : sum / static_cast<double>(audio.size());
}

std::vector<float> with_noise(Span<const float> audio, double power, Random* random) {
  const double pole = 0.97 * random->uniform();
  std::vector<double> noise(audio.size());
  fill_normals(random, {noise.data(), noise.size()});
  double state = 0;
  double sum = 0;
  for (double& x : noise) {
    state = pole * state + x;
    x = state;
    sum += state * state;
  }
  const double gain = sum > 0 ? std::sqrt(power * static_cast<double>(noise.size()) / sum) : 0.0;
  std::vector<float> result(audio.size());
  for (std::size_t n = 0; n < noise.size(); ++n)
    result[n] = audio[n] + static_cast<float>(gain * noise[n]);
  return result;
}

}  // namespace hri::detail
