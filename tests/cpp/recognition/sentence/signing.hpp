// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Synthetic sentences of three signs: hands that move from rest to a sign, through it, and back.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"

namespace hri::testing_data {

constexpr int kSignFrames = 12;
constexpr int kRestFrames = 8;
constexpr int kWayFrames = 5;

/// Where a sign begins and ends: left x, y, right x, y from the head.
struct Stroke {
  const char* label;
  std::array<double, 4> first;
  std::array<double, 4> last;
};
inline const std::array<Stroke, 3> kStrokes{{
    {"ball", {-40, 40, 40, 40}, {-10, 60, 10, 60}},
    {"cat", {-30, 120, 20, 10}, {-30, 120, 60, 10}},
    {"dog", {-30, 120, 50, 60}, {-30, 120, 20, 110}},
}};
inline constexpr std::array<double, 4> kRest{-30, 120, 30, 120};

inline SignedSample signed_sentence(const std::vector<std::string>& words, std::uint64_t seed,
                                    double size = 1) {
  Random random(seed);
  std::vector<std::array<double, 4>> places;
  const auto move = [&](const std::array<double, 4>& to, int num_frames) {
    const std::array<double, 4> from = places.empty() ? to : places.back();
    for (int t = 1; t <= num_frames; ++t) {
      std::array<double, 4> place{};
      for (std::size_t i = 0; i < 4; ++i) place[i] = from[i] + (to[i] - from[i]) * t / num_frames;
      places.push_back(place);
    }
  };
  SignedSample sample;
  sample.name = "sentence " + std::to_string(seed);
  move(kRest, kRestFrames);
  for (const std::string& word : words) {
    for (const Stroke& stroke : kStrokes) {
      if (word != stroke.label) continue;
      move(stroke.first, kWayFrames);
      const auto first = static_cast<std::int64_t>(places.size());
      move(stroke.last, kSignFrames);
      sample.words.push_back({word, first, static_cast<std::int64_t>(places.size())});
    }
  }
  move(kRest, kRestFrames);
  sample.tracks.resize(static_cast<Eigen::Index>(places.size()), kNumTwoHandTrackColumns);
  for (std::size_t t = 0; t < places.size(); ++t) {
    for (int i = 0; i < kNumTwoHandTrackColumns; ++i) {
      const double head = i % 2 == 0 ? 160 : 60;
      const double place = i < 4 ? places[t][static_cast<std::size_t>(i)] : 0;
      sample.tracks(static_cast<Eigen::Index>(t), i) =
          static_cast<float>(head + size * (place + random.normal()));
    }
  }
  return sample;
}

/// Sentences of one to four words; "cat" is never first.
inline std::vector<SignedSample> signed_sentences(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<SignedSample> samples;
  for (int i = 0; i < count; ++i) {
    std::vector<std::string> words{random.below(2) == 0 ? "ball" : "dog"};
    for (std::uint64_t more = random.below(4); more > 0; --more)
      words.emplace_back(kStrokes[random.below(3)].label);
    samples.push_back(signed_sentence(words, seed * 1000 + static_cast<std::uint64_t>(i)));
  }
  return samples;
}

}  // namespace hri::testing_data
