// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The decision on frames whose levels and voicing are given, so that every bound can be found by
// hand. All bands of a frame have its level, unless stated.
#include "signal/word_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

using Frames = std::vector<ActivityFrame>;

constexpr int kBoundsRateHz = 16000;

Frames frames(int count, float level_db, float voicing = 0) {
  ActivityFrame frame;
  frame.level_db = level_db;
  frame.voicing = voicing;
  frame.band_db.fill(level_db);
  return Frames(static_cast<std::size_t>(count), frame);
}

Frames operator+(Frames a, const Frames& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

detail::WordFrames found_in(const Frames& clip, const ActivityOptions& options = {}) {
  return detail::WordFinder(ActivityMeter(kBoundsRateHz, options), options).find(clip);
}

// Noise at -60 dB, 40 frames of it on both sides.
Frames in_noise(const Frames& middle) { return frames(40, -60) + middle + frames(40, -60); }
// A vowel: 10 frames at -20 dB, so that sound below -50 dB is too low.
Frames vowel(float level_db = -20) { return frames(10, level_db, 0.95F); }

#define EXPECT_BOUNDS(word, begin, end)              \
  do {                                               \
    const detail::WordFrames found_word = (word);    \
    EXPECT_TRUE(found_word.found);                   \
    EXPECT_EQ(found_word.first, std::size_t{begin}); \
    EXPECT_EQ(found_word.last, std::size_t{end});    \
  } while (false)

// A frame adds what its voicing is above 0.45, once to three times as it is 15 to 25 dB clear of
// the noise, and nothing below 5 dB.
TEST(WordFinder, NeedsAsMuchVoicingAsIsAskedFor) {
  struct Case {
    float over_db, times;
  };
  for (const Case& c :
       {Case{5.1F, 1}, Case{15, 1}, Case{17.5F, 1.5F}, Case{20, 2}, Case{25, 3}, Case{40, 3}}) {
    for (const int count : {1, 4}) {
      const Frames clip = in_noise(frames(count, -60 + c.over_db, 0.7F));
      ActivityOptions options;
      options.min_voicing = count * 0.25 * static_cast<double>(c.times) * 0.999;
      EXPECT_TRUE(found_in(clip, options).found) << c.over_db << " " << count;
      options.min_voicing = count * 0.25 * static_cast<double>(c.times) * 1.001;
      EXPECT_FALSE(found_in(clip, options).found) << c.over_db << " " << count;
    }
  }
  ActivityOptions any;
  any.min_voicing = 0.001;
  EXPECT_FALSE(found_in(in_noise(frames(20, -55.1F, 0.95F)), any).found);  // not 5 dB
  EXPECT_FALSE(found_in(in_noise(frames(20, -20, 0.449F)), any).found);
  EXPECT_TRUE(found_in(in_noise(frames(20, -20, 0.451F)), any).found);
}

// A frame without voicing takes 0.45 away, however loud it is, but never leaves less than nothing.
TEST(WordFinder, ForgetsVoicingInWhatIsNotVoiced) {
  const Frames part = frames(2, -40, 0.7F);  // 20 dB clear: 2 * 2 * 0.25
  const auto least = [](const Frames& middle, double sum) {
    ActivityOptions options;
    options.min_voicing = sum;
    return found_in(in_noise(middle), options).found;
  };
  const Frames once = part + frames(1, -40) + part;  // 1 - 0.45 + 1
  EXPECT_TRUE(least(once, 1.549));
  EXPECT_FALSE(least(once, 1.551));
  const Frames forgotten = part + frames(3, -40) + part;
  EXPECT_TRUE(least(forgotten, 0.999));
  EXPECT_FALSE(least(forgotten, 1.001));
}

TEST(WordFinder, HearsNothingBelowSilence) {
  const auto at = [](float level_db) {
    return found_in(frames(40, -100) + frames(10, level_db, 0.95F) + frames(40, -100)).found;
  };
  EXPECT_TRUE(at(-69.9F));
  EXPECT_FALSE(at(-70.1F));
}

TEST(WordFinder, CoversItsVowelAndWhatSoundsBesideIt) {
  EXPECT_BOUNDS(found_in(in_noise(vowel())), 40, 50);
  EXPECT_BOUNDS(found_in(in_noise(frames(3, -40) + vowel() + frames(4, -40))), 40, 57);
  // From the first vowel to the last, and nothing of the noise between them is lost.
  EXPECT_BOUNDS(found_in(in_noise(vowel() + frames(50, -60) + vowel())), 40, 110);
  // The whole clip.
  EXPECT_BOUNDS(found_in(vowel() + frames(40, -60)), 0, 10);
  EXPECT_BOUNDS(found_in(frames(40, -60) + vowel()), 40, 50);
  EXPECT_FALSE(found_in(frames(80, -60)).found);
  EXPECT_FALSE(found_in({}).found);
}

// What is voiced belongs to the word however low it is; what is beside it counts by all its bands.
TEST(WordFinder, EndsWithWhatIsVoicedOrSoundsInAnyBand) {
  const Frames quiet = frames(40, -90);
  EXPECT_BOUNDS(found_in(quiet + frames(3, -52, 0.95F) + vowel() + frames(5, -52, 0.95F) + quiet),
                40, 58);
  Frames hissing = frames(4, -60);
  for (ActivityFrame& frame : hissing) {
    frame.level_db = -40;
    frame.band_db[4] = -51;  // all bands: 9 / sqrt(5), 4.02 dB
  }
  EXPECT_EQ(found_in(in_noise(vowel() + hissing)).last, 54U);
  for (ActivityFrame& frame : hissing) frame.band_db[4] = -51.1F;  // 3.98 dB
  EXPECT_EQ(found_in(in_noise(vowel() + hissing)).last, 50U);
}

// Sound has to be above max_depth_db below the vowel, margin_db above the noise and silence_dbfs.
TEST(WordFinder, LeavesOutWhatIsTooLow) {
  const auto last = [](float vowel_db, float noise_db, float sound_db) {
    const Frames quiet = frames(40, noise_db);
    return found_in(quiet + vowel(vowel_db) + frames(4, sound_db) + quiet).last;
  };
  EXPECT_EQ(last(-20, -60, -49.9F), 54U);
  EXPECT_EQ(last(-20, -60, -50.1F), 50U);
  EXPECT_EQ(last(-30, -60, -55.9F), 54U);
  EXPECT_EQ(last(-30, -60, -56.1F), 50U);
  EXPECT_EQ(last(-45, -90, -69.9F), 54U);
  EXPECT_EQ(last(-45, -90, -70.1F), 50U);
  // The level is that of the loudest voiced frame, wherever that is.
  const Frames clip = frames(40, -60) + vowel(-25) + frames(1, -20, 0.95F) + vowel(-25);
  EXPECT_EQ(found_in(clip + frames(4, -49.9F) + frames(40, -60)).last, 65U);
  EXPECT_EQ(found_in(clip + frames(4, -50.1F) + frames(40, -60)).last, 61U);
}

// A frame of silence costs 2, one of sound is worth its distance from the limits, 12 at most.
TEST(WordFinder, BridgesSilenceThatTheSoundBehindItIsWorth) {
  struct Case {
    int gap, sound;
    float level_db;
    bool bridged;
  };
  for (const Case& c : {Case{5, 1, -30, true}, Case{6, 1, -30, false}, Case{6, 2, -30, true},
                        Case{11, 2, -30, true}, Case{12, 2, -30, false}, Case{12, 3, -30, true},
                        Case{4, 1, -40, true}, Case{5, 1, -40, false},  // 10 a frame
                        Case{1, 1, -47.9F, true}, Case{1, 1, -48.1F, false}}) {
    const Frames sound = frames(c.sound, c.level_db);
    const Frames gap = frames(c.gap, -60);
    const auto size = static_cast<std::size_t>(c.gap + c.sound);
    const auto before = found_in(in_noise(sound + gap + vowel()));
    EXPECT_EQ(before.first, c.bridged ? 40 : 40 + size) << c.gap << " " << c.sound;
    EXPECT_EQ(before.last, 50 + size);
    const auto after = found_in(in_noise(vowel() + gap + sound));
    EXPECT_EQ(after.first, 40U);
    EXPECT_EQ(after.last, c.bridged ? 50 + size : 50) << c.gap << " " << c.sound;
  }
}

// What is worth the silence, five frames for 25 of it, has to stand within max_gap_ms of the word:
// its 30 frames.
TEST(WordFinder, BridgesNoMoreThanTheLongestSilence) {
  for (const int gap : {25, 26}) {
    for (const int sound : {5, 9}) {
      const auto before = found_in(in_noise(frames(sound, -30) + frames(gap, -60) + vowel()));
      const auto after = found_in(in_noise(vowel() + frames(gap, -60) + frames(sound, -30)));
      EXPECT_EQ(before.last - before.first, after.last - after.first);
      EXPECT_EQ(after.last - after.first,
                gap == 25 ? static_cast<std::size_t>(10 + gap + sound) : 10U);
    }
  }
  ActivityOptions options;
  options.max_gap_ms = 69;  // six frames, and no part of one
  EXPECT_EQ(found_in(in_noise(vowel() + frames(5, -60) + frames(1, -30)), options).last, 56U);
  EXPECT_EQ(found_in(in_noise(frames(1, -30) + frames(5, -60) + vowel()), options).first, 40U);
  options.max_gap_ms = 59;
  EXPECT_EQ(found_in(in_noise(vowel() + frames(5, -60) + frames(1, -30)), options).last, 50U);
  EXPECT_EQ(found_in(in_noise(frames(1, -30) + frames(5, -60) + vowel()), options).first, 46U);
}

TEST(WordFinder, CountsUtterancesBetweenLongSilences) {
  const auto count = [](const Frames& between) {
    return found_in(in_noise(vowel() + between + vowel())).num_utterances;
  };
  EXPECT_EQ(count({}), 1);
  EXPECT_EQ(count(frames(29, -60)), 1);
  EXPECT_EQ(count(frames(30, -60)), 2);
  // A click of one frame ends no silence, a sound of two does.
  EXPECT_EQ(count(frames(20, -60) + frames(1, -30) + frames(20, -60)), 2);
  EXPECT_EQ(count(frames(20, -60) + frames(2, -30) + frames(20, -60)), 1);
  // What is too low, or too little above the noise, is silence.
  EXPECT_EQ(count(frames(30, -50.1F)), 2);
  EXPECT_EQ(count(frames(30, -49.9F)), 1);
  EXPECT_EQ(found_in(in_noise(vowel() + frames(40, -60) + vowel() + frames(40, -60) + vowel()))
                .num_utterances,
            3);
  EXPECT_EQ(found_in(frames(80, -60)).num_utterances, 0);
}

// The noise in a band: its quantile 0.1, with half of what it is below its quantile 0.25. Of 40
// frames these are the fourth and the tenth lowest.
TEST(WordFinder, TakesTheQuietFramesForNoise) {
  const auto is_found = [](float spread_db, float over_db) {
    const float usual = -60 + spread_db;
    ActivityOptions options;
    options.min_voicing = 0.4;  // one frame of 0.5, 5 to 15 dB above the noise
    return found_in(frames(3, -90) + frames(1, -60) + frames(5, -59.9F) + frames(30, usual) +
                        frames(1, -60 + over_db, 0.95F),
                    options)
        .found;
  };
  for (const float spread_db : {0.5F, 1.0F, 2.0F}) {
    EXPECT_TRUE(is_found(spread_db, spread_db / 2 + 5.01F)) << spread_db;
    EXPECT_FALSE(is_found(spread_db, spread_db / 2 + 4.99F)) << spread_db;
  }
  // More than 2 dB are sound: the noise is as far below as they are more than 2.
  for (const float spread_db : {3.0F, 4.0F}) {
    EXPECT_TRUE(is_found(spread_db, 1 - (spread_db - 2) + 5.01F)) << spread_db;
    EXPECT_FALSE(is_found(spread_db, 1 - (spread_db - 2) + 4.99F)) << spread_db;
  }
}

// A clip shorter than max_gap_ms, 30 frames, holds no noise: it is 8 dB below what is there.
TEST(WordFinder, TakesAShortClipForAllWord) {
  EXPECT_BOUNDS(found_in(frames(29, -30, 0.95F)), 0, 29);
  EXPECT_FALSE(found_in(frames(30, -30, 0.95F)).found);
  ActivityOptions options;
  options.margin_db = 7.9;
  EXPECT_EQ(found_in(frames(5, -30) + frames(10, -30, 0.95F) + frames(5, -30), options).first, 0U);
  options.margin_db = 8.1;
  EXPECT_EQ(found_in(frames(5, -30) + frames(10, -30, 0.95F) + frames(5, -30), options).first, 5U);
}

TEST(WordFinder, MeasuresExcessOverAllBandsAndTheLowestTwo) {
  const ActivityMeter meter(kBoundsRateHz, {});
  ASSERT_EQ(meter.num_bands(), 5);
  ASSERT_EQ(meter.num_low_bands(), 2);
  ActivityFrame frame;
  frame.band_db = {-57, -56, -48, -60, -65};
  const detail::NoiseFloor noise{-60, -60, -60, -60, -60};
  const detail::Excess found = detail::excess(frame, noise, meter);
  EXPECT_FLOAT_EQ(found.all_db, std::sqrt((9.0F + 16.0F + 144.0F) / 5));
  EXPECT_FLOAT_EQ(found.low_db, 4);
}

TEST(WordFinder, GivesSamplesWithPaddingWithinTheClip) {
  const ActivityMeter meter(kBoundsRateHz, {});  // frames of 400 samples, every 160
  const auto bounds = [&](std::size_t first, std::size_t last, double padding_ms,
                          std::size_t num_samples) {
    ActivityOptions options;
    options.padding_ms = padding_ms;
    const SpeechBounds b =
        detail::to_samples({first, last, true, 2}, meter, options, kBoundsRateHz, num_samples);
    EXPECT_TRUE(b.found);
    EXPECT_EQ(b.num_utterances, 2);
    return std::pair<std::size_t, std::size_t>(b.first, b.last);
  };
  using Bounds = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(bounds(10, 20, 0, 10000), Bounds(1600, 19 * 160 + 400));
  EXPECT_EQ(bounds(10, 20, 30, 10000), Bounds(1600 - 480, 19 * 160 + 400 + 480));
  EXPECT_EQ(bounds(10, 20, 30, 3900), Bounds(1120, 3900));
  EXPECT_EQ(bounds(4, 5, 30, 10000), Bounds(160, 4 * 160 + 400 + 480));
  EXPECT_EQ(bounds(2, 5, 30, 10000).first, 0U);
  EXPECT_EQ(bounds(0, 1, 1.03, 10000), Bounds(0, 400 + 16));  // 16.48 samples
  EXPECT_EQ(bounds(1, 2, 1.04, 10000), Bounds(160 - 17, 560 + 17));
  EXPECT_FALSE(detail::to_samples({}, meter, {}, kBoundsRateHz, 100).found);
}

TEST(ActivityMeter, HasFramesAndBandsByTheRate) {
  struct Case {
    int rate_hz, num_bands, num_low_bands;
    std::size_t length, shift;
  };
  for (const Case& c :
       {Case{1000, 1, 1, 25, 10}, Case{8000, 4, 2, 200, 80}, Case{11025, 5, 2, 276, 110},
        Case{16000, 5, 2, 400, 160}, Case{48000, 5, 2, 1200, 480}}) {
    const ActivityMeter meter(c.rate_hz, {});
    EXPECT_EQ(meter.num_bands(), c.num_bands) << c.rate_hz;
    EXPECT_EQ(meter.num_low_bands(), c.num_low_bands) << c.rate_hz;
    EXPECT_EQ(meter.frame_length(), c.length);
    EXPECT_EQ(meter.frame_shift(), c.shift);
  }
}

TEST(ActivityMeter, IsAsNewAfterReset) {
  std::vector<float> first(5000);
  std::vector<float> second(5000);
  for (std::size_t n = 0; n < first.size(); ++n) {
    first[n] = static_cast<float>(0.3 + 0.5 * std::sin(0.07 * static_cast<double>(n)));
    second[n] = static_cast<float>(-0.1 + 0.2 * std::sin(0.05 * static_cast<double>(n)));
  }
  for (const double shift_ms : {10.0, 40.0}) {  // overlapping, and apart
    ActivityOptions options;
    options.shift_ms = shift_ms;
    for (const std::size_t size : {std::size_t{1}, std::size_t{399}, std::size_t{1003}}) {
      ActivityMeter used(kBoundsRateHz, options);
      ActivityMeter fresh(kBoundsRateHz, options);
      ActivityFrame a;
      ActivityFrame b;
      bool complete = false;
      for (std::size_t at = 0; at < size;)
        at += used.take({first.data() + at, size - at}, &a, &complete);
      used.reset();
      for (std::size_t at = 0; at < second.size();) {
        const Span<const float> rest{second.data() + at, second.size() - at};
        const std::size_t taken = used.take(rest, &a, &complete);
        ASSERT_EQ(fresh.take(rest, &b, &complete), taken);
        at += taken;
        if (!complete) continue;
        ASSERT_EQ(a.level_db, b.level_db);
        ASSERT_EQ(a.voicing, b.voicing);
        ASSERT_EQ(a.band_db, b.band_db);
      }
    }
  }
}

TEST(ActivityMeter, TakesTheFirstSampleForItsZeroAndSilenceForMinus120) {
  const std::vector<float> constant(2000, 0.7F);
  ActivityMeter meter(kBoundsRateHz, {});
  ActivityFrame frame;
  bool complete = false;
  EXPECT_EQ(meter.take(constant, &frame, &complete), 400U);
  EXPECT_TRUE(complete);
  EXPECT_EQ(frame.level_db, -120);
  EXPECT_EQ(frame.voicing, 0);
  EXPECT_EQ(meter.take(Span<const float>(constant).subspan(0, 100), &frame, &complete), 100U);
  EXPECT_FALSE(complete);
}

// Pulses of voices correlate with themselves a period ago; slower ones are too far apart.
TEST(ActivityMeter, HearsThePitchOfVoices) {
  for (const int period : {40, 80, 160, 264, 352}) {  // 400, 200, 100, 60.6 and 45.5 Hz
    ActivityMeter meter(kBoundsRateHz, {});
    std::vector<float> pulses(16000, 0.0F);
    for (std::size_t n = 0; n < pulses.size(); n += static_cast<std::size_t>(period)) pulses[n] = 1;
    ActivityFrame frame;
    bool complete = false;
    for (std::size_t at = 0; at < pulses.size();)
      at += meter.take({pulses.data() + at, pulses.size() - at}, &frame, &complete);
    if (period < 300) {
      EXPECT_GT(frame.voicing, 0.95F) << period;
    } else {
      EXPECT_LT(frame.voicing, 0.3F) << period;
    }
    EXPECT_LE(frame.voicing, 1);
  }
}

// |H|^2 of Butterworth filters of second order after the bilinear transformation, at
// w = tan(pi f / rate): 1 / (1 + (c / w)^4) for the high-pass at c, and
// (b w)^2 / ((l h - w^2)^2 + (b w)^2), b = h - l, for the band from l to h.
TEST(ActivityMeter, MeasuresTonesAsTheFiltersOfItsBandsDo) {
  const auto w = [](double hz) { return std::tan(3.14159265358979323846 * hz / kBoundsRateHz); };
  const double edges_hz[] = {100, 500, 1000, 2000, 3800, 7500};
  for (const double hz : {40.0, 120.0, 480.0, 1000.0, 3000.0, 7480.0}) {  // whole in 400 samples
    ActivityMeter meter(kBoundsRateHz, {});
    std::vector<float> tone(16000);
    for (std::size_t n = 0; n < tone.size(); ++n)
      tone[n] = static_cast<float>(
          0.5 * std::sin(2 * 3.14159265358979323846 * hz * static_cast<double>(n) / kBoundsRateHz));
    ActivityFrame frame;
    bool complete = false;
    std::size_t num_frames = 0;
    for (std::size_t at = 0; at < tone.size();) {
      at += meter.take({tone.data() + at, tone.size() - at}, &frame, &complete);
      num_frames += complete ? 1 : 0;
    }
    EXPECT_EQ(num_frames, (tone.size() - 400) / 160 + 1);
    const double rumble = 1 / (1 + std::pow(w(60) / w(hz), 4));
    const double level_db = 10 * std::log10(0.125 * rumble);
    EXPECT_NEAR(frame.level_db, level_db, 2e-3) << hz;
    for (std::size_t b = 0; b < 5; ++b) {
      const double low = w(edges_hz[b]);
      const double high = w(edges_hz[b + 1]);
      const double part = std::pow((high - low) * w(hz), 2);
      const double gain = part / (std::pow(low * high - w(hz) * w(hz), 2) + part);
      EXPECT_NEAR(frame.band_db[b], level_db + 10 * std::log10(gain), 2e-3) << hz << " " << b;
    }
  }
}

}  // namespace
}  // namespace hri
