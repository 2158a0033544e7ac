// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// When Endpointer says what: by frames of sound in digital silence, to the sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/signal/activity_meter.hpp"
#include "hri/signal/stream/endpointer.hpp"
#include "signal/word_bounds.hpp"

namespace hri {
namespace {

constexpr int kTimesRateHz = 16000;
constexpr std::size_t kShift = 160;
constexpr std::size_t kLength = 400;

// Adds something like a vowel of 125 Hz.
void say(std::vector<float>* audio, std::size_t first, std::size_t last, double level) {
  for (std::size_t n = first; n < last; ++n) {
    double y = 0;
    for (int h = 1; h <= 12; ++h)
      y +=
          std::sin(2 * 3.14159265358979 * 125 * h * static_cast<double>(n - first) / kTimesRateHz) /
          h;
    (*audio)[n] += static_cast<float>(0.3 * level * y);
  }
}

void hiss(std::vector<float>* audio, std::size_t first, std::size_t last, double level) {
  Random random(5);
  for (std::size_t n = first; n < last; ++n)
    (*audio)[n] += static_cast<float>(level * random.normal());
}

std::vector<float> silence(std::size_t num_samples) { return std::vector<float>(num_samples); }

void hear(Endpointer* endpointer, const std::vector<float>& audio, std::vector<Endpoint>* events) {
  for (std::size_t at = 0; at < audio.size();) {
    Endpoint event;
    at += endpointer->consume({audio.data() + at, audio.size() - at}, &event);
    if (event.kind != EndpointKind::none) events->push_back(event);
  }
}

void hear_end(Endpointer* endpointer, std::vector<Endpoint>* events) {
  for (Endpoint e = endpointer->finish(); e.kind != EndpointKind::none; e = endpointer->finish())
    events->push_back(e);
}

std::vector<Endpoint> heard(const std::vector<float>& audio, const EndpointerOptions& options) {
  Endpointer endpointer(kTimesRateHz, options);
  std::vector<Endpoint> events;
  hear(&endpointer, audio, &events);
  hear_end(&endpointer, &events);
  return events;
}

std::vector<ActivityFrame> measured(const std::vector<float>& audio,
                                    const ActivityOptions& options = {}) {
  ActivityMeter meter(kTimesRateHz, options);
  std::vector<ActivityFrame> frames;
  for (std::size_t at = 0; at < audio.size();) {
    ActivityFrame frame;
    bool complete = false;
    at += meter.take({audio.data() + at, audio.size() - at}, &frame, &complete);
    if (complete) frames.push_back(frame);
  }
  return frames;
}

void expect_same(const std::vector<Endpoint>& found, const std::vector<Endpoint>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].kind, expected[i].kind) << i;
    EXPECT_EQ(found[i].at, expected[i].at) << i;
    EXPECT_EQ(found[i].first, expected[i].first) << i;
    EXPECT_EQ(found[i].last, expected[i].last) << i;
    EXPECT_EQ(found[i].segment_first, expected[i].segment_first) << i;
    EXPECT_EQ(found[i].segment_last, expected[i].segment_last) << i;
    EXPECT_EQ(found[i].cut, expected[i].cut) << i;
  }
}

// What a frame on its own is about, over silence that is far below all sound.
struct Sound {
  std::size_t onset = 0;   // of the first two frames above silence_dbfs
  std::size_t voiced = 0;  // the frame by which voicing has reached min_voicing
  std::size_t last = 0;    // within max_depth_db of the loudest, and above silence_dbfs
};

Sound sound_in(const std::vector<ActivityFrame>& frames, const ActivityOptions& options = {}) {
  Sound sound;
  while (!(frames[sound.onset].level_db > -70 && frames[sound.onset + 1].level_db > -70))
    ++sound.onset;
  double sum = 0;
  sound.voiced = sound.onset;
  // Three times what is above 0.45, as all of it is more than 25 dB clear of the silence.
  while (sum < options.min_voicing)
    sum = std::max(0.0, sum + 3 * (static_cast<double>(frames[++sound.voiced].voicing) - 0.45));
  float peak_db = -120;
  for (const ActivityFrame& f : frames) peak_db = std::max(peak_db, f.level_db);
  const float lowest_db = std::max(-70.0F, peak_db - static_cast<float>(options.max_depth_db));
  for (std::size_t t = 0; t < frames.size(); ++t) {
    if (frames[t].level_db > lowest_db) sound.last = t;
  }
  return sound;
}

TEST(EndpointerTimes, AreThoseOfItsFramesToTheSample) {
  std::vector<float> audio = silence(64000);
  say(&audio, 24000, 32000, 1);
  const std::vector<ActivityFrame> frames = measured(audio);
  for (const int hangover : {5, 15, 30}) {
    for (const int context : {5, 30, 60}) {
      for (const double min_voicing : {0.0, 0.9, 1.15, 2.2, 3.5, 4.7, 6.0}) {
        EndpointerOptions options;
        options.hangover_ms = 10 * hangover;
        options.context_ms = 10 * context;
        options.activity.min_voicing = min_voicing;
        const Sound sound = sound_in(frames, options.activity);
        ASSERT_EQ(sound.onset, (24000 - kLength) / kShift + 1);
        const std::size_t begin = sound.onset - static_cast<std::size_t>(context);
        const std::size_t end = sound.last + static_cast<std::size_t>(hangover) + 1;
        Endpoint start;
        start.kind = EndpointKind::speech_start;
        start.at = std::max(sound.voiced, sound.onset + 1) * kShift + kLength;
        start.first = start.segment_first = sound.onset * kShift;
        start.last = start.segment_last = start.at;
        Endpoint stop;
        stop.kind = EndpointKind::speech_end;
        stop.at = stop.segment_last = (end - 1) * kShift + kLength;
        stop.segment_first = begin * kShift;
        const ActivityMeter meter(kTimesRateHz, options.activity);
        const detail::WordFrames word =
            detail::WordFinder(meter, options.activity).find({frames.data() + begin, end - begin});
        const SpeechBounds bounds = detail::to_samples(word, meter, options.activity, kTimesRateHz,
                                                       stop.segment_last - stop.segment_first);
        ASSERT_TRUE(bounds.found);
        stop.first = stop.segment_first + bounds.first;
        stop.last = stop.segment_first + bounds.last;
        expect_same(heard(audio, options), {start, stop});
      }
    }
  }
}

TEST(EndpointerTimes, BeginWithTheStreamWhereThereIsNoContext) {
  std::vector<float> audio = silence(32000);
  say(&audio, 1600, 9600, 1);
  const auto events = heard(audio, {});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].segment_first, 0U);
  EXPECT_EQ(events[1].first, 1600 / kShift * kShift - 2 * kShift - 480);
}

// Sound 30 dB below the vowel is its end, sound above is not.
TEST(EndpointerTimes, EndAtMaxDepthBelowTheVowel) {
  for (const double depth_db : {20.0, 29.2, 30.8, 45.0}) {
    std::vector<float> audio = silence(64000);
    say(&audio, 16000, 24000, 1);
    say(&audio, 24000, 40000, std::pow(10, -depth_db / 20));
    const Sound sound = sound_in(measured(audio));
    EXPECT_NEAR(static_cast<double>(sound.last * kShift), depth_db < 30 ? 40000 : 24000, 800);
    const auto events = heard(audio, {});
    ASSERT_GE(events.size(), 2U);
    EXPECT_EQ(events[1].at, (sound.last + 30) * kShift + kLength);
  }
}

// What one word leaves behind: neither its voicing, by which a hiss would be speech, nor its level,
// below which a word would be silence.
TEST(EndpointerTimes, OweNothingToTheWordBefore) {
  std::vector<float> audio = silence(112000);
  say(&audio, 16000, 24000, 1);
  hiss(&audio, 40000, 42000, 0.1);
  say(&audio, 64000, 80000, 0.01);
  const std::size_t onset = (64000 - kLength) / kShift + 1;
  std::size_t last = 0;
  const std::vector<ActivityFrame> frames = measured(audio);
  for (std::size_t t = onset; t < frames.size(); ++t) {
    if (frames[t].level_db > -70) last = t;
  }
  const auto events = heard(audio, {});
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[2].first, onset * kShift);
  EXPECT_EQ(events[3].kind, EndpointKind::speech_end);
  EXPECT_EQ(events[3].at, (last + 30) * kShift + kLength);
}

// The level of a word is that of what is voiced in it: a hiss that is louder hides nothing.
TEST(EndpointerTimes, TakeTheLevelFromTheVowel) {
  std::vector<float> audio = silence(64000);
  say(&audio, 16000, 20000, 0.05);
  hiss(&audio, 20000, 24000, 0.5);
  say(&audio, 24000, 40000, 0.005);
  const auto events = heard(audio, {});
  ASSERT_GE(events.size(), 2U);
  EXPECT_GT(events[1].at, 40000U);
}

// Of frames of 10 ms that do not overlap: clicks are of one frame.
EndpointerOptions in_short_frames() {
  EndpointerOptions options;
  options.activity.frame_ms = 10;
  options.hangover_ms = 150;
  return options;
}

TEST(EndpointerTimes, BeginWithTwoFramesOfSoundNotMoreThanTheHangoverBefore) {
  for (const std::size_t before : {5U, 15U, 16U, 40U}) {
    for (const bool twice : {false, true}) {
      std::vector<float> audio = silence(48000);
      say(&audio, 150 * kShift, 200 * kShift, 1);
      const std::size_t click = 150 - before;
      audio[click * kShift + 5] = 0.02F;
      if (twice) audio[(click + 1) * kShift + 149] = 0.02F;  // 19 ms later: no pitch
      const auto events = heard(audio, in_short_frames());
      ASSERT_FALSE(events.empty());
      EXPECT_EQ(events[0].kind, EndpointKind::speech_start);
      // With the second click, and 15 frames of silence between it and the vowel, the sound is
      // over.
      EXPECT_EQ(events[0].first, (twice && before <= 15 ? click : 150) * kShift) << before;
    }
  }
}

// Noise that is no speech is kept for half the longest utterance: a word may follow.
TEST(EndpointerTimes, GoBackIntoNoiseByHalfTheLongestUtterance) {
  for (const double max_utterance_ms : {1000.0, 2000.0}) {
    for (const std::size_t word : {48000U, 48160U, 48320U, 48480U}) {
      std::vector<float> audio = silence(80000);
      hiss(&audio, 8000, 64000, 0.02);
      say(&audio, word, 56000, 1);
      EndpointerOptions options;
      options.max_utterance_ms = max_utterance_ms;
      const auto events = heard(audio, options);
      ASSERT_FALSE(events.empty());
      EXPECT_EQ(events[0].kind, EndpointKind::speech_start);
      EXPECT_GT(events[0].at, word);
      EXPECT_LT(events[0].at, word + 2000);
      EXPECT_EQ(events[0].at - events[0].first,
                static_cast<std::size_t>(max_utterance_ms / 20) * kShift + kLength);
    }
  }
  // Noise that is shorter is kept whole.
  std::vector<float> audio = silence(64000);
  hiss(&audio, 16000, 24000, 0.02);
  say(&audio, 22400, 30000, 1);
  EndpointerOptions options;
  options.max_utterance_ms = 1000;
  const auto events = heard(audio, options);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].first, ((16000 - kLength) / kShift + 1) * kShift);
}

TEST(EndpointerTimes, CutAfterTheLongestUtterance) {
  std::vector<float> audio = silence(64000);
  say(&audio, 16000, 40000, 1);
  EndpointerOptions options;
  options.max_utterance_ms = 1000;
  const Sound sound = sound_in(measured(audio));
  const auto events = heard(audio, options);
  ASSERT_GE(events.size(), 2U);
  EXPECT_EQ(events[0].first, sound.onset * kShift);
  EXPECT_EQ(events[1].kind, EndpointKind::speech_end);
  EXPECT_TRUE(events[1].cut);
  EXPECT_EQ(events[1].at, (sound.onset + 99) * kShift + kLength);
  EXPECT_EQ(events[1].segment_first, (sound.onset - 30) * kShift);
  EXPECT_EQ(events[1].last, events[1].at);
}

// The silence behind one word is the silence before the next, and no sample is in two words.
TEST(EndpointerTimes, ShareTheSilenceBetweenTwoWords) {
  std::vector<float> audio = silence(64000);
  say(&audio, 16000, 24000, 1);
  say(&audio, 28800, 36800, 1);
  const std::size_t second = (28800 - kLength) / kShift + 1;
  for (const int context : {5, 60}) {
    EndpointerOptions options;
    options.hangover_ms = 100;
    options.context_ms = 10 * context;
    const auto events = heard(audio, options);
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[2].first, second * kShift);
    EXPECT_EQ(events[3].segment_first,
              context == 5 ? (second - 5) * kShift : events[1].last / kShift * kShift);
    EXPECT_GE(events[3].first, events[1].last / kShift * kShift);
  }
}

TEST(EndpointerTimes, EndWithTheStream) {
  for (const std::size_t size : {20000U, 20123U}) {  // within the word
    std::vector<float> audio = silence(size);
    say(&audio, 16000, size, 1);
    const auto events = heard(audio, {});
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[1].kind, EndpointKind::speech_end);
    EXPECT_EQ(events[1].at, size);
    EXPECT_EQ(events[1].segment_last, size);
    EXPECT_EQ(events[1].last, size);
    EXPECT_FALSE(events[1].cut);
  }
  // A clip that is all word is found as find_speech finds it, and reported at its end.
  std::vector<float> clip = silence(3840);
  hiss(&clip, 0, 3840, 0.001);
  say(&clip, 320, 3520, 1);
  for (std::size_t n = 0; n < clip.size(); ++n)
    clip[n] *= static_cast<float>(std::pow(0.999, static_cast<double>(n)));
  EndpointerOptions options;
  options.activity.min_voicing = 3;
  options.activity.padding_ms = 0;
  const SpeechBounds bounds = find_speech(clip, kTimesRateHz, options.activity);
  ASSERT_TRUE(bounds.found);
  const auto events = heard(clip, options);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EndpointKind::speech_start);
  EXPECT_EQ(events[0].first, bounds.first);
  EXPECT_EQ(events[1].first, bounds.first);
  EXPECT_EQ(events[1].last, bounds.last);
  EXPECT_EQ(events[1].segment_first, 0U);
  EXPECT_EQ(events[1].segment_last, clip.size());
}

// The floor of a band goes down by a tenth of the difference a frame, and up by a fiftieth, at most
// 10 dB a second, 2 dB in speech.
TEST(Endpointer, FollowsTheNoiseAsItSays) {
  std::vector<float> audio = silence(64000);
  hiss(&audio, 0, 64000, 0.001);
  hiss(&audio, 12000, 20000, 0.004);
  say(&audio, 28000, 40000, 0.5);
  hiss(&audio, 48000, 56000, 0.1);
  const std::vector<ActivityFrame> frames = measured(audio);
  Endpointer endpointer(kTimesRateHz, {});
  std::array<double, kMaxActivityBands> floor_db{};
  bool spoke = false;
  std::size_t at = 0;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const bool in_speech = endpointer.in_speech();
    spoke |= in_speech;
    while (at < t * kShift + kLength) {
      Endpoint event;
      at += endpointer.consume({audio.data() + at, t * kShift + kLength - at}, &event);
    }
    double sum = 0;
    for (std::size_t b = 0; b < floor_db.size(); ++b) {
      const auto level_db = static_cast<double>(frames[t].band_db[b]);
      if (t == 0) floor_db[b] = level_db;
      const double over_db = level_db - floor_db[b];
      sum += std::pow(std::max(0.0, over_db), 2);
      floor_db[b] += over_db < 0 ? 0.1 * over_db : std::min(0.02 * over_db, in_speech ? 0.02 : 0.1);
    }
    ASSERT_NEAR(endpointer.excess_db(), std::sqrt(sum / 5), 1e-3) << t;
    ASSERT_EQ(endpointer.level_db(), frames[t].level_db);
  }
  EXPECT_TRUE(spoke);
}

TEST(Endpointer, ReportsOfTheNextStreamWhatANewOneWould) {
  std::vector<float> before = silence(48000);
  hiss(&before, 0, 48000, 0.003);
  say(&before, 8000, 14000, 0.7);
  hiss(&before, 24000, 30000, 0.05);
  say(&before, 32000, 40000, 0.2);
  std::vector<float> next = silence(40000);
  hiss(&next, 0, 40000, 0.01);
  say(&next, 3000, 9000, 0.3);
  say(&next, 20000, 26000, 0.6);
  const auto expected = heard(next, {});
  ASSERT_GE(expected.size(), 4U);
  // Wherever the stream before it ended: in noise, in a sound, in a word, or behind one.
  for (const std::size_t size : {0U, 200U, 6000U, 8400U, 12000U, 15001U, 22000U, 26000U, 36000U}) {
    Endpointer endpointer(kTimesRateHz, {});
    std::vector<Endpoint> ignored;
    hear(&endpointer, {before.begin(), before.begin() + static_cast<std::ptrdiff_t>(size)},
         &ignored);
    hear_end(&endpointer, &ignored);
    EXPECT_EQ(endpointer.num_samples(), 0U);
    EXPECT_EQ(endpointer.level_db(), -120);
    EXPECT_EQ(endpointer.excess_db(), 0);
    EXPECT_FALSE(endpointer.in_speech());
    std::vector<Endpoint> events;
    hear(&endpointer, next, &events);
    hear_end(&endpointer, &events);
    expect_same(events, expected);
  }
}

}  // namespace
}  // namespace hri
