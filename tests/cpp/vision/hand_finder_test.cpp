// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/vision/hand_colours.hpp"
#include "hri/vision/mask_smoothing.hpp"
#include "hri/vision/silhouette.hpp"

namespace hri {
namespace {

using hand_testing::hand;

constexpr int kSide_px = 200;
using Picture = std::vector<std::uint8_t>;

// A hand in violet light, in which chroma alone flickers; none for an empty mask.
Picture picture(const GreyImage& mask, std::uint64_t seed) {
  Random random(seed + 1);
  Picture bgr;
  for (const std::uint8_t inside : mask.pixels) {
    for (const double v :
         {inside != 0 ? 70.0 : 14.0, inside != 0 ? 45.0 : 20.0, inside != 0 ? 80.0 : 15.0})
      bgr.push_back(static_cast<std::uint8_t>(std::clamp(v + 1.5 * random.normal(), 0.0, 255.0)));
  }
  return bgr;
}

ImageView view(const Picture& bgr) {
  return {bgr.data(), kSide_px, kSide_px, 3, std::ptrdiff_t{3} * kSide_px};
}

std::vector<Picture> film(int num_frames) {
  std::vector<Picture> frames;
  for (int t = 0; t < num_frames; ++t)
    frames.push_back(picture(hand(3, 80 + 3 * t, 120), static_cast<std::uint64_t>(t)));
  return frames;
}

std::vector<ImageView> views(const std::vector<Picture>& frames) {
  std::vector<ImageView> result;
  for (const Picture& f : frames) result.push_back(view(f));
  return result;
}

double shared(const GreyImage& a, const GreyImage& b) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    both += (a.pixels[i] & b.pixels[i]) != 0 ? 1 : 0;
    either += (a.pixels[i] | b.pixels[i]) != 0 ? 1 : 0;
  }
  return either > 0 ? both / static_cast<double>(either) : 1;
}

TEST(HandFinder, TakesTheStepsOfAClipInTheirOrder) {
  const std::vector<Picture> frames = film(10);
  int done = 0;
  const auto found = HandFinder().find(views(frames), [&](int n, int total) {
    EXPECT_EQ(++done, n);
    EXPECT_EQ(total, 10);
  });
  EXPECT_EQ(done, 10);
  const auto colours = HandColours::learn(views(frames), {});
  ASSERT_TRUE(colours.has_value());
  std::vector<HandObservation> steps;
  for (const Picture& f : frames) steps.push_back(colours->extract(view(f)));
  smooth_masks({}, &steps);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(found[i].mask.pixels, steps[i].mask.pixels) << i;
    EXPECT_EQ(found[i].quality, steps[i].quality) << i;
  }
}

TEST(HandFinder, SegmentsShortClipsPictureByPicture) {
  const std::vector<Picture> frames = film(7);
  HandFinderOptions options;
  options.smooth = false;
  const auto found = HandFinder(options).find(views(frames));
  options.learning = ColourLearning::never;
  const std::vector<Picture> longer = film(9);
  const auto never = HandFinder(options).find(views(longer));
  const SilhouetteExtractor alone{options.silhouette};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(found[i].mask.pixels, alone.extract(view(frames[i])).mask.pixels);
    EXPECT_EQ(never[i].mask.pixels, found[i].mask.pixels);
  }
  EXPECT_TRUE(HandFinder().find({}).empty());
}

TEST(HandFinder, LearnsColoursFromAStreamAndKeepsThemInAGesture) {
  const auto stream = HandFinder().stream(true);
  const auto plain = HandFinder().stream(false);
  const SilhouetteExtractor alone{SilhouetteOptions{}};
  int renewals = 0;
  double time_s = 0;
  for (int t = 0; t < 60; ++t, time_s += 0.05) {
    const GreyImage truth = hand(3, 80 + t % 20, 120);
    const Picture bgr = picture(truth, static_cast<std::uint64_t>(t));
    const HandObservation& found = stream->push(view(bgr), time_s, t > 40);
    EXPECT_EQ(plain->push(view(bgr), time_s, false).mask.pixels,
              alone.extract(view(bgr)).mask.pixels);
    renewals += stream->renewed() ? 1 : 0;
    if (t < 20) {
      EXPECT_EQ(found.mask.pixels, alone.extract(view(bgr)).mask.pixels) << t;
    } else if (t > 25) {
      EXPECT_GT(found.quality, 0.3);
      EXPECT_EQ(found.mask.width_px, 160);
    }
    EXPECT_FALSE(plain->renewed());
  }
  EXPECT_GE(renewals, 1);
  // A picture of another size begins anew, with the colours that are known.
  const Picture small(static_cast<std::size_t>(3 * 64 * 48), 20);
  EXPECT_EQ(stream->push({small.data(), 64, 48, 3, 192}, time_s, false).mask.width_px, 64);
  EXPECT_THROW(stream->push({}, time_s, false), InvalidArgument);
}

TEST(HandFinder, LeavesOutWhatIsInTheBackgroundToo) {
  const Picture wall = picture(GreyImage(kSide_px, kSide_px), 99);
  const std::vector<Picture> frames = film(9);
  HandFinderOptions options;
  options.smooth = false;
  const HandFinder finder(options, view(wall));
  const SilhouetteExtractor extractor(options.silhouette, view(wall));
  const auto found = finder.find(views(frames));
  const auto stream = finder.stream(true);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(found[i].mask.pixels, extractor.extract(view(frames[i])).mask.pixels);
    EXPECT_EQ(stream->push(view(frames[i]), 0.1 * static_cast<double>(i), false).mask.pixels,
              found[i].mask.pixels);
  }
  const Picture small(static_cast<std::size_t>(3 * 64 * 48), 20);
  EXPECT_THROW((void)finder.find(std::vector<ImageView>{{small.data(), 64, 48, 3, 192}}),
               InvalidArgument);
}

TEST(HandFinder, FindsBothHands) {
  std::vector<Picture> frames;
  std::vector<GreyImage> lefts;
  for (int t = 0; t < 10; ++t) {
    GreyImage both = hand(2, 50 + t, 120, 0.5);
    lefts.push_back(both);
    const GreyImage right = hand(3, 150 - t, 100, 0.5);
    for (std::size_t i = 0; i < both.pixels.size(); ++i) both.pixels[i] |= right.pixels[i];
    frames.push_back(picture(both, static_cast<std::uint64_t>(t)));
  }
  HandFinderOptions options;
  options.colours.max_side_px = kSide_px;
  const auto [left, right] = HandFinder(options).find_pair(views(frames));
  ASSERT_EQ(left.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_GT(shared(left[i].mask, lefts[i]), 0.8) << i;
    EXPECT_LT(shared(right[i].mask, lefts[i]), 0.01) << i;
    EXPECT_GT(right[i].quality, 0);
    EXPECT_FALSE(left[i].touching);
  }
}

TEST(HandFinder, NamesWhatDoesNotFit) {
  HandFinderOptions options;
  options.smoothing.max_gap = 11;
  EXPECT_THROW(HandFinder{options}, InvalidArgument);
  options = {};
  options.min_frames = 0;
  EXPECT_THROW(HandFinder{options}, InvalidArgument);
  const Picture grey(100, 3);
  try {
    (void)HandFinder().find(std::vector<ImageView>{{grey.data(), 10, 10, 1, 10}});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("frame 0"), std::string::npos);
  }
}

TEST(BackgroundOf, IsTheMedianOfTheClip) {
  const std::vector<Picture> frames = film(30);
  const std::vector<std::uint8_t> median = background_of(views(frames));
  ASSERT_EQ(median.size(), frames[0].size());
  EXPECT_LT(median[3 * (20 * kSide_px + 20)], 25);
  EXPECT_THROW((void)background_of({}), InvalidArgument);
}

}  // namespace
}  // namespace hri
