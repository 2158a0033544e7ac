// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/word_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"

namespace hri::detail {
namespace {

using testing_data::kRateHz;

constexpr double kFirstS = 10;  // where the audio begins in its recording

// Quiet noise with sounds in it; times from the beginning of the audio.
class Scene {
 public:
  explicit Scene(double seconds) : audio_(samples(seconds)) {
    for (float& x : audio_) x = static_cast<float>(0.001 * random_.normal());
  }
  Scene& voice(double first_s, double last_s) {
    return add(first_s, last_s, [](double t) { return 0.3 * std::sin(6.283185307 * 300 * t); });
  }
  // 30 times as loud as the noise.
  Scene& hiss(double first_s, double last_s) {
    return add(first_s, last_s, [this](double) { return 0.03 * random_.normal(); });
  }
  // A voice that dies away, by 25 dB in the end.
  Scene& fade(double first_s, double last_s) {
    return add(first_s, last_s, [=](double t) {
      return 0.3 * std::pow(10.0, -1.25 * (t - first_s) / (last_s - first_s)) *
             std::sin(6.283185307 * 300 * t);
    });
  }
  [[nodiscard]] const std::vector<float>& audio() const { return audio_; }

 private:
  static std::size_t samples(double seconds) {
    return static_cast<std::size_t>(std::lround(seconds * kRateHz));
  }
  template <class Sound>
  Scene& add(double first_s, double last_s, Sound&& sound) {
    for (std::size_t n = samples(first_s); n < samples(last_s); ++n)
      audio_[n] += static_cast<float>(sound(static_cast<double>(n) / kRateHz));
    return *this;
  }

  Random random_{5};
  std::vector<float> audio_;
};

using Times = std::vector<std::pair<double, double>>;

// Times from the beginning of the audio, before and after.
Times extended(const Scene& scene, const Times& decoded) {
  const WordTimes times(kRateHz, ActivityOptions());
  ScoredRecording recording;
  recording.activity = times.frames(scene.audio());
  recording.activity_first_s = kFirstS;
  std::vector<TranscribedWord> words;
  for (const auto& [first_s, last_s] : decoded) {
    TranscribedWord word;
    word.first_s = kFirstS + first_s;
    word.last_s = kFirstS + last_s;
    words.push_back(word);
  }
  times.extend(recording, &words);
  Times result;
  for (const TranscribedWord& word : words)
    result.emplace_back(word.first_s - kFirstS, word.last_s - kFirstS);
  return result;
}

TEST(WordTimes, ReachFirstFricativesAndWordsThatDieAway) {
  Scene scene(2.4);
  scene.hiss(0.4, 0.55).voice(0.55, 0.9).fade(0.9, 1.02);
  scene.hiss(1.3, 1.42).voice(1.42, 1.8).hiss(1.8, 1.95);
  const Times found = extended(scene, {{0.55, 0.9}, {1.42, 1.8}});
  EXPECT_NEAR(found[0].first, 0.4, 0.04);
  EXPECT_NEAR(found[0].second, 1.02, 0.04);
  EXPECT_NEAR(found[1].first, 1.3, 0.04);
  EXPECT_NEAR(found[1].second, 1.95, 0.04);
}

TEST(WordTimes, StayWhereWordsTouchOrNothingSounds) {
  Scene scene(2);
  scene.voice(0.5, 1.5);
  const Times decoded{{0.5, 0.8}, {0.8, 1.3}, {1.3, 1.5}};
  const Times found = extended(scene, decoded);
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    EXPECT_NEAR(found[i].first, decoded[i].first, 0.04);
    EXPECT_NEAR(found[i].second, decoded[i].second, 0.04);
  }
  EXPECT_NEAR(found[0].second, 0.8, 1e-9);
  EXPECT_NEAR(found[1].first, 0.8, 1e-9);
  EXPECT_NEAR(found[1].second, 1.3, 1e-9);
  EXPECT_NEAR(found[2].first, 1.3, 1e-9);
  const Times silent = extended(Scene(2), {{0.5, 0.8}});
  EXPECT_NEAR(silent[0].first, 0.5, 1e-9);
  EXPECT_NEAR(silent[0].second, 0.8, 1e-9);
}

TEST(WordTimes, NeverMoveInwards) {
  Scene scene(2);
  scene.voice(0.7, 1.0);
  const Times found = extended(scene, {{0.5, 1.3}});
  EXPECT_NEAR(found[0].first, 0.5, 1e-9);
  EXPECT_NEAR(found[0].second, 1.3, 1e-9);
}

TEST(WordTimes, DivideAPauseWhereItIsQuietest) {
  // The pause that the decoder found is full of the second word's fricative, but for its beginning.
  Scene scene(2);
  scene.voice(0.4, 0.8).hiss(0.9, 1.2).voice(1.2, 1.6);
  const Times found = extended(scene, {{0.4, 0.8}, {1.2, 1.6}});
  EXPECT_NEAR(found[0].second, 0.8, 0.04);
  EXPECT_NEAR(found[1].first, 0.9, 0.04);
  // Here there is sound throughout.
  const Times joined =
      extended(Scene(2).voice(0.4, 0.8).hiss(0.8, 1.2).voice(1.2, 1.6), {{0.4, 0.8}, {1.2, 1.6}});
  EXPECT_LE(joined[0].second, joined[1].first);
}

TEST(WordTimes, AreTheDecodersWithoutActivity) {
  std::vector<TranscribedWord> words(2);
  words[0].first_s = 1;
  words[0].last_s = words[1].first_s = 2;
  words[1].last_s = 3;
  const WordTimes times(kRateHz, ActivityOptions());
  EXPECT_TRUE(times.frames({}).empty());
  times.extend(ScoredRecording(), &words);
  EXPECT_EQ(words[0].first_s, 1);
  EXPECT_EQ(words[1].last_s, 3);
  ActivityOptions wrong;
  wrong.frame_ms = 0;
  EXPECT_THROW(WordTimes(kRateHz, wrong), InvalidArgument);
}

}  // namespace
}  // namespace hri::detail
