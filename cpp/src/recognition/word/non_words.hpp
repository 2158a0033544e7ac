// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sounds that are no words, made from the words of a training: a recogniser has to turn them down.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

class NonWords {
 public:
  NonWords(int sample_rate_hz, std::uint64_t seed) : rate_hz_(sample_rate_hz), random_(seed) {}

  /// Noise with the loudness of `word` over time, and a burst of noise.
  std::vector<std::vector<float>> sounds(const std::vector<float>& word);

  /// Once the same group has said another word, halves of both in one.
  std::vector<std::vector<float>> speech(const std::vector<float>& word, const std::string& label,
                                         const std::string& group);

 private:
  struct Said {
    std::string label;
    std::vector<float> word;
  };

  std::vector<float> noise(std::size_t size);
  std::vector<float> burst();
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(rate_hz_ / 50); }

  int rate_hz_;
  Random random_;
  std::map<std::string, std::vector<Said>> said_;  // by group: the last two labels
};

}  // namespace hri::detail
