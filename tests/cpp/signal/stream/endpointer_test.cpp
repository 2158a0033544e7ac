// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stream/endpointer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr int kStreamRateHz = 16000;

// Noise with something like a vowel (a pulse train at 120 Hz through two resonances) in each of
// `words`, given by first and last sample.
std::vector<float> speech(std::size_t num_samples, double level, double noise,
                          const std::vector<std::pair<std::size_t, std::size_t>>& words) {
  Random random(1);
  std::vector<float> x(num_samples);
  for (std::size_t n = 0; n < num_samples; ++n) x[n] = static_cast<float>(noise * random.normal());
  for (const auto& [first, last] : words) {
    for (std::size_t n = first; n < last; ++n) {
      const double t = static_cast<double>(n - first) / kStreamRateHz;
      double y = 0;
      for (int h = 1; h <= 20; ++h) {
        const double f = 120.0 * h;
        const double gain =
            1 / (1 + std::pow((f - 600) / 150, 2)) + 0.3 / (1 + std::pow((f - 1500) / 200, 2));
        y += gain * std::sin(2 * 3.14159265358979 * f * t);
      }
      x[n] += static_cast<float>(0.5 * level * y);
    }
  }
  return x;
}

std::vector<Endpoint> events_of(const std::vector<float>& audio, std::size_t block,
                                const EndpointerOptions& options = {}) {
  Endpointer endpointer(kStreamRateHz, options);
  std::vector<Endpoint> events;
  const Span<const float> all = audio;
  for (std::size_t begin = 0; begin < all.size(); begin += block) {
    Span<const float> rest = all.subspan(begin, std::min(block, all.size() - begin));
    while (!rest.empty()) {
      Endpoint event;
      const std::size_t used = endpointer.consume(rest, &event);
      if (event.kind != EndpointKind::none) events.push_back(event);
      rest = rest.subspan(used, rest.size() - used);
    }
  }
  for (Endpoint e = endpointer.finish(); e.kind != EndpointKind::none; e = endpointer.finish())
    events.push_back(e);
  return events;
}

std::vector<Endpoint> ends_of(const std::vector<Endpoint>& events) {
  std::vector<Endpoint> ends;
  for (const Endpoint& e : events)
    if (e.kind == EndpointKind::speech_end) ends.push_back(e);
  return ends;
}

TEST(Endpointer, FindsEveryWordWhereItIsAtAnyLevel) {
  const std::vector<std::pair<std::size_t, std::size_t>> words = {
      {16000, 22400}, {35200, 40000}, {56000, 72000}};
  for (const double level : {0.9, 0.05}) {
    for (const double ratio : {300.0, 10.0, 3.0}) {
      const auto ends = ends_of(events_of(speech(96000, level, level / ratio, words), 512));
      ASSERT_EQ(ends.size(), words.size()) << level << " over " << ratio;
      for (std::size_t w = 0; w < words.size(); ++w) {
        EXPECT_NEAR(static_cast<double>(ends[w].first), static_cast<double>(words[w].first), 2400);
        EXPECT_NEAR(static_cast<double>(ends[w].last), static_cast<double>(words[w].second), 2400);
        EXPECT_LE(ends[w].segment_first, ends[w].first);
        EXPECT_GE(ends[w].segment_last, ends[w].last);
        EXPECT_FALSE(ends[w].cut);
      }
    }
  }
}

TEST(Endpointer, DoesNotDependOnTheSizeOfBlocks) {
  const auto audio = speech(64000, 0.5, 0.02, {{16000, 22400}, {35200, 40000}});
  const auto whole = events_of(audio, audio.size());
  ASSERT_EQ(whole.size(), 4U);
  for (const std::size_t block : {std::size_t{1}, std::size_t{159}, std::size_t{1024}}) {
    const auto parts = events_of(audio, block);
    ASSERT_EQ(parts.size(), whole.size()) << block;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(parts[i].kind, whole[i].kind);
      EXPECT_EQ(parts[i].at, whole[i].at);
      EXPECT_EQ(parts[i].first, whole[i].first);
      EXPECT_EQ(parts[i].last, whole[i].last);
      EXPECT_EQ(parts[i].segment_first, whole[i].segment_first);
      EXPECT_EQ(parts[i].segment_last, whole[i].segment_last);
    }
  }
}

TEST(Endpointer, TellsOfTheStartWhileTheWordIsSpokenAndOfTheEndAfterTheHangover) {
  for (const double hangover_ms : {150.0, 300.0, 600.0}) {
    EndpointerOptions options;
    options.hangover_ms = hangover_ms;
    const auto events = events_of(speech(64000, 0.5, 0.01, {{16000, 24000}}), 160, options);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, EndpointKind::speech_start);
    EXPECT_GT(events[0].at, 16000U);
    EXPECT_LT(events[0].at, 20000U);
    EXPECT_NEAR(static_cast<double>(events[0].first), 16000, 800);
    EXPECT_EQ(events[1].kind, EndpointKind::speech_end);
    const double waited_ms = (static_cast<double>(events[1].at) - 24000) / 16;
    EXPECT_NEAR(waited_ms, hangover_ms, 60);
  }
}

TEST(Endpointer, TellsOfAPauseOnceAndOfTheUtteranceSoFar) {
  // Two syllables with 160 ms between them; both pauses are of one utterance.
  const auto audio = speech(64000, 0.5, 0.002, {{16000, 22400}, {24960, 30400}});
  const auto plain = events_of(audio, 160);
  ASSERT_EQ(plain.size(), 2U);
  for (const double pause_ms : {60.0, 100.0}) {
    EndpointerOptions options;
    options.pause_ms = pause_ms;
    for (const std::size_t block : {std::size_t{1}, std::size_t{160}, audio.size()}) {
      const auto events = events_of(audio, block, options);
      ASSERT_EQ(events.size(), 4U) << pause_ms << " " << block;
      EXPECT_EQ(events[0].at, plain[0].at);
      std::size_t last = 22400;
      for (const std::size_t i : {1U, 2U}) {
        EXPECT_EQ(events[i].kind, EndpointKind::speech_pause);
        EXPECT_NEAR(static_cast<double>(events[i].at - last) / 16, pause_ms, 40);
        EXPECT_EQ(events[i].first, plain[1].first);
        EXPECT_EQ(events[i].segment_first, plain[1].segment_first);
        EXPECT_EQ(events[i].segment_last, events[i].at);
        EXPECT_NEAR(static_cast<double>(events[i].last), static_cast<double>(last), 1600);
        EXPECT_FALSE(events[i].cut);
        last = 30400;
      }
      EXPECT_EQ(events[3].kind, EndpointKind::speech_end);
      EXPECT_EQ(events[3].at, plain[1].at);
      EXPECT_EQ(events[3].first, plain[1].first);
      EXPECT_EQ(events[3].last, plain[1].last);
      EXPECT_EQ(events[3].segment_last, plain[1].segment_last);
    }
  }
}

TEST(Endpointer, TellsOfNoPauseThatIsNotShorterThanWhatEndsAnUtterance) {
  const auto audio = speech(64000, 0.5, 0.01, {{16000, 24000}});
  EndpointerOptions options;
  EXPECT_EQ(options.pause_ms, 0);
  for (const double pause_ms : {300.0, 500.0}) {
    options.pause_ms = pause_ms;
    EXPECT_EQ(events_of(audio, 512, options).size(), 2U) << pause_ms;
  }
}

TEST(Endpointer, AgreesWithFindSpeechOnTheSegment) {
  const auto audio = speech(64000, 0.5, 0.05, {{16000, 22400}, {40000, 46400}});
  for (const Endpoint& e : ends_of(events_of(audio, 512))) {
    const SpeechBounds b = find_speech(
        Span<const float>(audio).subspan(e.segment_first, e.segment_last - e.segment_first),
        kStreamRateHz, {});
    ASSERT_TRUE(b.found);
    EXPECT_NEAR(static_cast<double>(e.segment_first + b.first), static_cast<double>(e.first), 320);
    EXPECT_NEAR(static_cast<double>(e.segment_first + b.last), static_cast<double>(e.last), 320);
  }
}

TEST(Endpointer, HearsNoSpeechInSilenceNoiseOrClicks) {
  EXPECT_TRUE(events_of(std::vector<float>(160000, 0.0F), 512).empty());
  EXPECT_TRUE(events_of(std::vector<float>(160000, 0.5F), 512).empty());
  std::vector<float> noise = speech(160000, 0, 0.1, {});
  EXPECT_TRUE(events_of(noise, 512).empty());
  for (std::size_t n = 80000; n < noise.size(); ++n) noise[n] *= 8;  // a fan is switched on
  for (std::size_t n = 8000; n < noise.size(); n += 8000) noise[n] += 0.9F;
  EXPECT_TRUE(events_of(noise, 512).empty());
}

TEST(Endpointer, FindsTheWordAfterTheNoiseHasGrown) {
  std::vector<float> audio = speech(320000, 0, 0.005, {});
  for (std::size_t n = 80000; n < audio.size(); ++n) audio[n] *= 10;
  const std::vector<float> word = speech(320000, 0.8, 0, {{240000, 248000}});
  for (std::size_t n = 0; n < audio.size(); ++n) audio[n] += word[n];
  const auto ends = ends_of(events_of(audio, 512));
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(static_cast<double>(ends[0].first), 240000, 2400);
  EXPECT_NEAR(static_cast<double>(ends[0].last), 248000, 2400);
}

TEST(Endpointer, CutsWhatDoesNotEnd) {
  EndpointerOptions options;
  options.max_utterance_ms = 1000;
  const auto ends = ends_of(events_of(speech(96000, 0.5, 0.01, {{16000, 64000}}), 512, options));
  ASSERT_GE(ends.size(), 1U);
  EXPECT_TRUE(ends[0].cut);
  EXPECT_LE(ends[0].last, 16000U + 16000 + 1600);
}

TEST(Endpointer, JudgesAShortRecordingAsAClip) {
  // No silence around the word, as in a trimmed recording.
  auto audio = speech(6400, 0.5, 0.001, {{0, 6400}});
  for (std::size_t n = 0; n < audio.size(); ++n)
    audio[n] *= static_cast<float>(1 - static_cast<double>(n) / 6400);
  const auto events = events_of(audio, 512);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EndpointKind::speech_start);
  EXPECT_EQ(events[1].kind, EndpointKind::speech_end);
  EXPECT_TRUE(find_speech(audio, kStreamRateHz, {}).found);
}

TEST(Endpointer, IsAsNewAfterTheEndOfAStream) {
  const auto audio = speech(48000, 0.5, 0.02, {{16000, 24000}});
  Endpointer endpointer(kStreamRateHz, {});
  for (int pass = 0; pass < 2; ++pass) {
    Span<const float> rest = audio;
    std::size_t num_events = 0;
    while (!rest.empty()) {
      Endpoint event;
      const std::size_t used = endpointer.consume(rest, &event);
      if (event.kind == EndpointKind::speech_end) {
        EXPECT_NEAR(static_cast<double>(event.first), 16000, 1600) << pass;
        ++num_events;
      }
      rest = rest.subspan(used, rest.size() - used);
    }
    EXPECT_EQ(num_events, 1U);
    EXPECT_EQ(endpointer.num_samples(), audio.size());
    while (endpointer.finish().kind != EndpointKind::none) {
    }
    EXPECT_EQ(endpointer.num_samples(), 0U);
    EXPECT_FALSE(endpointer.in_speech());
  }
}

TEST(Endpointer, EndsWhereFramesAreShorterThanTheirShift) {
  EndpointerOptions options;
  options.activity.frame_ms = 20;
  options.activity.shift_ms = 60;
  options.activity.padding_ms = 0;
  options.activity.min_voicing = 0.1;
  std::size_t num_ends = 0;
  // Recordings that end anywhere in a word, some with its only frame.
  for (std::size_t size = 15000; size < 20000; size += 160) {
    const std::vector<float> audio = speech(size, 0.9, 0.001, {{14000, size}});
    Endpointer endpointer(kStreamRateHz, options);
    Endpoint event;
    for (std::size_t at = 0; at < audio.size();)
      at += endpointer.consume({audio.data() + at, audio.size() - at}, &event);
    std::size_t last = 0;
    int left = 100;
    while ((event = endpointer.finish()).kind != EndpointKind::none && --left > 0) {
      if (event.kind != EndpointKind::speech_end) continue;
      EXPECT_GT(event.last, last) << size;
      last = event.last;
      ++num_ends;
    }
    EXPECT_GT(left, 0) << size;
  }
  EXPECT_GT(num_ends, 10U);
}

TEST(Endpointer, RefusesWhatItCannotJudge) {
  Endpointer endpointer(kStreamRateHz, {});
  std::vector<float> x(1000, 0.0F);
  Endpoint event;
  EXPECT_EQ(endpointer.consume(x, &event), 1000U);
  x[7] = std::numeric_limits<float>::infinity();
  try {
    endpointer.consume(x, &event);
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("sample 1007"), std::string::npos) << error.what();
  }
  EXPECT_EQ(endpointer.num_samples(), 1000U);
  EXPECT_THROW(Endpointer(999, {}), InvalidArgument);
  struct Case {
    double EndpointerOptions::*field;
    double low;
    double high;
  };
  for (const Case& c :
       {Case{&EndpointerOptions::hangover_ms, 50, 5000},
        Case{&EndpointerOptions::pause_ms, 0, 5000}, Case{&EndpointerOptions::context_ms, 50, 5000},
        Case{&EndpointerOptions::max_utterance_ms, 500, 60000}}) {
    for (const double bad : {c.low - 1, c.high + 1, std::numeric_limits<double>::quiet_NaN()}) {
      EndpointerOptions options;
      options.*c.field = bad;
      EXPECT_THROW(Endpointer(kStreamRateHz, options), InvalidArgument) << bad;
    }
    EndpointerOptions options;
    options.*c.field = c.high;
    EXPECT_NO_THROW(Endpointer(kStreamRateHz, options));
  }
  EndpointerOptions options;
  options.activity.margin_db = -1;
  EXPECT_THROW(Endpointer(kStreamRateHz, options), InvalidArgument);
}

}  // namespace
}  // namespace hri
