// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What tests of recognisers with a speech embedding have in common.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"
#include "recognition/word/small_embedding.hpp"

namespace hri::testing_data {

// Vectors of 12 values.
inline std::shared_ptr<const SpeechEmbedding> embedding(int window = 9) {
  SpeechEmbeddingOptions options;
  options.num_pieces = 3;
  return std::make_shared<const SpeechEmbedding>(small_embedding(options, 32, window));
}

// Words outside the vocabulary, in two takes.
struct Fillers {
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
};
inline Fillers fillers() {
  Fillers result;
  result.audio.reserve(4);
  for (std::uint64_t take = 0; take < 2; ++take) {
    for (const bool high : {true, false}) {
      result.audio.push_back(tone(high ? 2000 : 1500, high ? -2000 : 3000, 50 + take));
      result.samples.push_back({result.audio.back(), kRateHz, high ? "high" : "low", ""});
    }
  }
  return result;
}

template <class E, class Action>
void expect_error(const Action& action, const std::string& what) {
  try {
    action();
    FAIL() << what;
  } catch (const E& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

}  // namespace hri::testing_data
