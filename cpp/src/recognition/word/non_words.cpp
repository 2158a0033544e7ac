// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/non_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/normal_kernels.hpp"

namespace hri::detail {
namespace {

// The first half of `head`, then the second of `tail`, faded into each other.
std::vector<float> spliced(const std::vector<float>& head, const std::vector<float>& tail,
                           std::size_t fade) {
  const std::size_t half = head.size() / 2;
  const std::size_t from = tail.size() / 2;
  fade = std::min({fade, half, tail.size() - from});
  std::vector<float> result(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(half));
  for (std::size_t i = 0; i < fade; ++i) {
    const auto share = static_cast<float>(i + 1) / static_cast<float>(fade + 1);
    float& x = result[half - fade + i];
    x = (1 - share) * x + share * tail[from + i];
  }
  result.insert(result.end(), tail.begin() + static_cast<std::ptrdiff_t>(from + fade), tail.end());
  return result;
}

// Loudness around every sample: the root of the mean square over `width` samples.
std::vector<float> envelope(const std::vector<float>& word, std::size_t width) {
  std::vector<double> sums(word.size() + 1, 0.0);
  for (std::size_t i = 0; i < word.size(); ++i)
    sums[i + 1] = sums[i] + static_cast<double>(word[i]) * static_cast<double>(word[i]);
  std::vector<float> result(word.size());
  for (std::size_t i = 0; i < word.size(); ++i) {
    const std::size_t first = i < width / 2 ? 0 : i - width / 2;
    const std::size_t last = std::min(word.size(), i + width / 2 + 1);
    result[i] = static_cast<float>(
        std::sqrt((sums[last] - sums[first]) / static_cast<double>(last - first)));
  }
  return result;
}

}  // namespace

// White noise through one pole, drawn anew each time: from hiss to rumble. Unit power.
std::vector<float> NonWords::noise(std::size_t size) {
  const double pole = -0.5 + 1.45 * random_.uniform();
  const double gain = std::sqrt(1.0 - pole * pole);
  std::vector<double> steps(size);
  fill_normals(&random_, {steps.data(), steps.size()});
  std::vector<float> result(size);
  double y = 0;
  for (std::size_t i = 0; i < size; ++i) {
    y = gain * steps[i] + pole * y;
    result[i] = static_cast<float>(y);
  }
  return result;
}

std::vector<float> NonWords::burst() {
  constexpr double kLevel = 0.1;
  constexpr double kEdge = 0.1;  // share of the burst in which it swells, and in which it dies
  const double seconds = 0.15 + 0.65 * random_.uniform();
  std::vector<float> result = noise(static_cast<std::size_t>(seconds * rate_hz_));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(result.size());
    const double swell = std::min(1.0, std::min(place, 1.0 - place) / kEdge);
    result[i] *= static_cast<float>(kLevel * swell);
  }
  return result;
}

std::vector<std::vector<float>> NonWords::sounds(const std::vector<float>& word) {
  std::vector<std::vector<float>> result{noise(word.size()), burst()};
  const std::vector<float> loudness = envelope(word, width());
  for (std::size_t i = 0; i < word.size(); ++i) result.front()[i] *= loudness[i];
  return result;
}

std::vector<std::vector<float>> NonWords::speech(const std::vector<float>& word,
                                                 const std::string& label,
                                                 const std::string& group) {
  std::vector<std::vector<float>> result;
  std::vector<Said>& said = said_[group];
  const auto other =
      std::find_if(said.rbegin(), said.rend(), [&](const Said& s) { return s.label != label; });
  if (other != said.rend()) {
    result.push_back(spliced(word, other->word, width() / 2));
    result.push_back(spliced(other->word, word, width() / 2));
  }
  said.erase(
      std::remove_if(said.begin(), said.end(), [&](const Said& s) { return s.label == label; }),
      said.end());
  said.push_back({label, word});
  if (said.size() > 2) said.erase(said.begin());
  return result;
}

}  // namespace hri::detail
