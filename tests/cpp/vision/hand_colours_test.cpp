// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_colours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using hand_testing::hand;

constexpr int kSide_px = 200;
constexpr int kNumFrames = 8;

struct Colour {
  double b, g, r;
};

struct Scene {
  Colour wall;
  Colour skin;
  double gamma = 1;
  double noise = 2;
};

GreyImage truth(int t) { return hand(4, 90 + 3 * t, 120 - 2 * t, 0.9); }

std::vector<std::uint8_t> frame(const Scene& scene, int t, bool with_hand = true) {
  Random random(static_cast<std::uint64_t>(t) + 1);
  const GreyImage mask = truth(t);
  std::vector<std::uint8_t> bgr;
  for (const std::uint8_t inside : mask.pixels) {
    const Colour c = with_hand && inside != 0 ? scene.skin : scene.wall;
    for (const double v : {c.b, c.g, c.r}) {
      const double lit = 255 * std::pow(v / 255, scene.gamma) + scene.noise * random.normal();
      bgr.push_back(static_cast<std::uint8_t>(std::clamp(lit, 0.0, 255.0)));
    }
  }
  return bgr;
}

std::vector<std::vector<std::uint8_t>> film(const Scene& scene, bool with_hand = true) {
  std::vector<std::vector<std::uint8_t>> frames;
  for (int t = 0; t < kNumFrames; ++t) frames.push_back(frame(scene, t, with_hand));
  return frames;
}

std::vector<ImageView> views(const std::vector<std::vector<std::uint8_t>>& frames) {
  std::vector<ImageView> result;
  for (const auto& f : frames) result.push_back({f.data(), kSide_px, kSide_px, 3, 3 * kSide_px});
  return result;
}

HandColourOptions full_size() {
  HandColourOptions options;
  options.max_side_px = kSide_px;
  return options;
}

double worst_overlap(const Scene& scene) {
  const auto frames = film(scene);
  const auto colours = HandColours::learn(views(frames), full_size());
  if (!colours) return 0;
  double worst = 1;
  for (int t = 0; t < kNumFrames; ++t) {
    const GreyImage found = colours->extract(views(frames)[static_cast<std::size_t>(t)]).mask;
    const GreyImage wanted = truth(t);
    double both = 0;
    double any = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
      both += found.pixels[i] != 0 && wanted.pixels[i] != 0 ? 1 : 0;
      any += found.pixels[i] != 0 || wanted.pixels[i] != 0 ? 1 : 0;
    }
    worst = std::min(worst, both / any);
  }
  return worst;
}

TEST(HandColours, AreFoundInAnyLight) {
  EXPECT_GT(worst_overlap({{8, 12, 8}, {60, 35, 70}}), 0.9) << "violet light in the dark";
  EXPECT_GT(worst_overlap({{75, 70, 60}, {255, 255, 255}}), 0.9) << "over-exposed";
  EXPECT_GT(worst_overlap({{110, 60, 10}, {160, 170, 200}}), 0.9) << "blue cloth";
  EXPECT_GT(worst_overlap({{110, 150, 100}, {170, 150, 230}}), 0.9) << "green wall";
  EXPECT_GT(worst_overlap({{250, 245, 240}, {150, 175, 215}}), 0.9) << "white wall";
  EXPECT_GT(worst_overlap({{100, 130, 150}, {90, 150, 230}}), 0.9) << "lamp, beige wall";
  EXPECT_GT(worst_overlap({{165, 160, 150}, {110, 135, 195}, 2.0}), 0.9) << "gamma 2";
}

// A face of the hand's colour, larger than the hand; where the hand hides it, they are one.
GreyImage with_face(int t, double x) {
  GreyImage both = hand(4, x, 130, 0.5);
  for (int y = 0; y < kSide_px; ++y) {
    for (int col = 0; col < kSide_px; ++col) {
      const double u = (col - 140) / 34.0;
      const double v = (y - 60 - t % 2) / 44.0;  // it is never quite still
      if (u * u + v * v < 1) both.pixels[static_cast<std::size_t>(y * kSide_px + col)] = 255;
    }
  }
  return both;
}

TEST(HandColours, LeaveOutAFaceThatStaysWhileTheHandMoves) {
  std::vector<std::vector<std::uint8_t>> frames;
  std::vector<GreyImage> hands;
  for (int t = 0; t < kNumFrames; ++t) {
    hands.push_back(hand(4, 40 + 4 * t, 130, 0.5));
    const GreyImage mask = with_face(t, 40 + 4 * t);
    Random random(static_cast<std::uint64_t>(t) + 1);
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t inside : mask.pixels) {
      for (const double v :
           {inside ? 110.0 : 165.0, inside ? 135.0 : 160.0, inside ? 195.0 : 150.0})
        bgr.push_back(static_cast<std::uint8_t>(v + 2 * random.normal()));
    }
    frames.push_back(bgr);
  }
  const auto shared = [&](const HandColourOptions& options, int t) {
    const auto colours = HandColours::learn(views(frames), options);
    const GreyImage found = colours->extract(views(frames)[static_cast<std::size_t>(t)]).mask;
    const GreyImage& wanted = hands[static_cast<std::size_t>(t)];
    double both = 0;
    double any = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
      both += found.pixels[i] != 0 && wanted.pixels[i] != 0 ? 1 : 0;
      any += found.pixels[i] != 0 || wanted.pixels[i] != 0 ? 1 : 0;
    }
    return both / any;
  };
  HandColourOptions options = full_size();
  for (const int t : {0, 4, 7}) EXPECT_GT(shared(options, t), 0.85) << t;
  options.remove_still = false;
  EXPECT_LT(shared(options, 4), 0.1);
}

TEST(HandColours, KeepAHandThatStays) {
  // What stays in place alone is the hand, also where its fingers move.
  const Scene scene{{165, 160, 150}, {110, 135, 195}};
  std::vector<std::vector<std::uint8_t>> frames(kNumFrames, frame(scene, 0));
  const auto colours = HandColours::learn(views(frames), full_size());
  ASSERT_TRUE(colours.has_value());
  EXPECT_GT(colours->extract(views(frames)[3]).quality, 0.5);
}

TEST(HandColours, AreNotFoundOnABareWall) {
  for (const double noise : {1.0, 2.0, 4.0}) {
    const auto frames = film({{165, 160, 150}, {0, 0, 0}, 1, noise}, false);
    EXPECT_FALSE(HandColours::learn(views(frames), {}).has_value()) << noise;
  }
}

TEST(HandColours, LeaveAFrameWithoutAHandEmpty) {
  const Scene scene{{165, 160, 150}, {110, 135, 195}};
  const auto frames = film(scene);
  const auto colours = HandColours::learn(views(frames), full_size());
  ASSERT_TRUE(colours.has_value());
  EXPECT_GT(colours->quality(), 0.5);
  const auto bare = frame(scene, 0, false);
  const HandObservation s = colours->extract({bare.data(), kSide_px, kSide_px, 3, 3 * kSide_px});
  EXPECT_EQ(s.quality, 0.0);
  EXPECT_EQ(std::count(s.mask.pixels.begin(), s.mask.pixels.end(), 0), kSide_px * kSide_px);
}

TEST(HandColours, TakePicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {1000, 20}}) {
    const std::vector<std::uint8_t> flat(static_cast<std::size_t>(3 * width * height), 100);
    const ImageView view{flat.data(), width, height, 3, 3 * width};
    EXPECT_FALSE(HandColours::learn({view}, {}).has_value());
  }
}

TEST(HandColours, NameWhatDoesNotFit) {
  const auto frames = film({{165, 160, 150}, {110, 135, 195}});
  const auto refused = [&](auto change) {
    HandColourOptions options;
    change(options);
    EXPECT_THROW((void)HandColours::learn(views(frames), options), InvalidArgument);
  };
  refused([](auto& o) { o.max_side_px = 1; });
  refused([](auto& o) { o.fit_side_px = 1; });
  refused([](auto& o) { o.num_fit_frames = 0; });
  refused([](auto& o) { o.num_rounds = 0; });
  refused([](auto& o) { o.min_area = 0.9; });
  refused([](auto& o) { o.min_quality = 2; });
  EXPECT_THROW((void)HandColours::learn({}, {}), InvalidArgument);
  std::vector<ImageView> bad = views(frames);
  bad[2] = {};
  try {
    (void)HandColours::learn(bad, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("frame 2"), std::string::npos);
  }
}

}  // namespace
}  // namespace hri
