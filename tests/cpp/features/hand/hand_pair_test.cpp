// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

struct Place {
  double x, y;
};

// Two hands of different shapes; the second hides the first.
struct Scene {
  GreyImage both, left, right;
};

Scene scene(Place left, Place right, double scale = 0.45) {
  Scene s{hand(4, left.x, left.y, scale), {}, hand(2, right.x, right.y, scale)};
  s.left = s.both;
  for (std::size_t i = 0; i < s.both.pixels.size(); ++i) {
    if (s.right.pixels[i] == 0) continue;
    s.both.pixels[i] = 255;
    s.left.pixels[i] = 0;
  }
  return s;
}

double overlap(const GreyImage& found, const GreyImage& truth) {
  double both = 0;
  double any = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    both += found.pixels[i] != 0 && truth.pixels[i] != 0 ? 1 : 0;
    any += found.pixels[i] != 0 || truth.pixels[i] != 0 ? 1 : 0;
  }
  return any > 0 ? both / any : 1;
}

struct Result {
  double worst_apart = 1;  // overlap in frames where the hands do not touch
  double mean_touching = 0;
  int num_touching = 0;
};

// Along two ways, 0..1.
Result follow(const std::function<Place(double)>& left, const std::function<Place(double)>& right,
              int num_frames = 40) {
  HandPairTracker tracker({});
  Result result;
  for (int t = 0; t < num_frames; ++t) {
    const double at = t / (num_frames - 1.0);
    const Scene s = scene(left(at), right(at));
    const auto& found = tracker.push(s.both.view());
    const double both = std::min(overlap(found[0].mask, s.left), overlap(found[1].mask, s.right));
    EXPECT_TRUE(found[0].seen || std::count(s.left.pixels.begin(), s.left.pixels.end(), 255) < 60);
    EXPECT_TRUE(found[1].seen);
    if (found[0].touching) {
      EXPECT_TRUE(found[1].touching);
      ++result.num_touching;
      result.mean_touching += both;
    } else {
      result.worst_apart = std::min(result.worst_apart, both);
    }
  }
  if (result.num_touching > 0) result.mean_touching /= result.num_touching;
  return result;
}

TEST(HandPair, HandsThatStayApartAreLeftAndRight) {
  const auto r = follow(
      [](double t) {
        return Place{50, 60 + 60 * t};
      },
      [](double t) {
        return Place{150, 140 - 60 * t};
      });
  EXPECT_EQ(r.num_touching, 0);
  EXPECT_EQ(r.worst_apart, 1.0);
}

TEST(HandPair, LabelsGoWithHandsThatCross) {
  const auto r = follow(
      [](double t) {
        return Place{40 + 120 * t, 110};
      },
      [](double t) {
        return Place{160 - 120 * t, 114};
      });
  EXPECT_GT(r.num_touching, 5);
  EXPECT_EQ(r.worst_apart, 1.0);
  EXPECT_GT(r.mean_touching, 0.5);
}

TEST(HandPair, LabelsStayWithHandsThatTouchAndTurnBack) {
  const auto way = [](double t) { return 1 - std::abs(2 * t - 1); };  // there and back
  for (const double gap : {34.0, 24.0, 16.0}) {
    const auto r = follow(
        [&](double t) {
          return Place{40 + (60 - gap / 2) * way(t), 110};
        },
        [&](double t) {
          return Place{160 - (60 - gap / 2) * way(t), 112};
        });
    EXPECT_GT(r.num_touching, 1) << gap;
    EXPECT_EQ(r.worst_apart, 1.0) << gap;
    EXPECT_GT(r.mean_touching, 0.6) << gap;
  }
}

TEST(HandPair, LabelsGoWithAHandThatPassesOneAtRest) {
  const auto r = follow(
      [](double t) {
        return Place{30 + 140 * t, 110};
      },
      [](double) {
        return Place{100, 112};
      });
  EXPECT_GT(r.num_touching, 5);
  EXPECT_EQ(r.worst_apart, 1.0);
}

TEST(HandPair, OneHandIsThatOfItsHalfAndTheOtherJoins) {
  HandPairTracker tracker({});
  const GreyImage right = hand(4, 150, 120, 0.45);
  EXPECT_TRUE(tracker.push(right.view())[1].seen);
  EXPECT_FALSE(tracker.push(right.view())[0].seen);
  const Scene s = scene({60, 100}, {150, 120});
  const auto& found = tracker.push(s.both.view());
  EXPECT_EQ(overlap(found[0].mask, s.left), 1.0);
  EXPECT_EQ(overlap(found[1].mask, s.right), 1.0);
}

TEST(HandPair, LabelsAreGivenWhenBothAreFirstSeen) {
  HandPairTracker tracker({});
  EXPECT_TRUE(tracker.push(hand(4, 120, 120, 0.45).view())[1].seen);
  const Scene s = scene({120, 120}, {170, 120});
  const auto& found = tracker.push(s.both.view());
  EXPECT_EQ(overlap(found[0].mask, s.left), 1.0);
  EXPECT_EQ(overlap(found[1].mask, s.right), 1.0);
  // Hands that touch from the beginning are one until they part.
  tracker.reset();
  EXPECT_FALSE(tracker.push(scene({95, 120}, {105, 120}).both.view())[0].touching);
  const Scene apart = scene({70, 120}, {130, 120});
  EXPECT_EQ(overlap(tracker.push(apart.both.view())[0].mask, apart.left), 1.0);
}

TEST(HandPair, AHandThatIsMissedForAWhileIsTheSameAgain) {
  HandPairTracker tracker({});
  for (int t = 0; t < 4; ++t) tracker.push(scene({60, 110}, {140, 110}).both.view());
  const GreyImage left = hand(4, 60, 110, 0.45);
  for (int t = 0; t < 6; ++t) {
    const auto& found = tracker.push(left.view());
    EXPECT_TRUE(found[0].seen);
    EXPECT_FALSE(found[1].seen);
    EXPECT_NEAR(found[1].x_px, 140, 6);
    EXPECT_EQ(std::count(found[1].mask.pixels.begin(), found[1].mask.pixels.end(), 255), 0);
  }
  // The left one went over to the right half meanwhile.
  const Scene s = scene({75, 110}, {140, 110});
  EXPECT_EQ(overlap(tracker.push(s.both.view())[1].mask, s.right), 1.0);
}

TEST(HandPair, AHandThatLeavesBehindTheOtherIsForgotten) {
  HandPairOptions options;
  options.num_kept_frames = 5;
  HandPairTracker tracker(options);
  for (int t = 0; t <= 10; ++t) tracker.push(scene({60.0 + 4 * t, 110}, {104, 110}).both.view());
  const GreyImage alone = hand(2, 104, 110, 0.45);
  bool touching = true;
  for (int t = 0; t < 12; ++t) touching = tracker.push(alone.view())[0].touching;
  EXPECT_FALSE(touching);
}

TEST(HandPair, SpecksAreNoHands) {
  Scene s = scene({60, 110}, {140, 110});
  for (int y = 10; y < 16; ++y) {
    for (int x = 10; x < 16; ++x) s.both.pixels[static_cast<std::size_t>(y * 200 + x)] = 255;
  }
  HandPairTracker tracker({});
  const auto& found = tracker.push(s.both.view());
  EXPECT_EQ(overlap(found[0].mask, s.left), 1.0);
  EXPECT_EQ(overlap(found[1].mask, s.right), 1.0);
  const GreyImage empty(200, 200);
  for (const PairedHand& h : tracker.push(empty.view())) EXPECT_FALSE(h.seen);
}

TEST(HandPair, AnotherSizeBeginsANewStream) {
  HandPairTracker tracker({});
  tracker.push(scene({60, 110}, {140, 110}).both.view());
  GreyImage small(40, 30);
  for (int y = 5; y < 25; ++y)
    std::fill_n(small.pixels.begin() + y * 40 + 25, 10, std::uint8_t{255});
  const auto& found = tracker.push(small.view());
  EXPECT_FALSE(found[0].seen);
  EXPECT_TRUE(found[1].seen);
  EXPECT_EQ(found[1].mask.width_px, 40);
}

TEST(HandPair, NamesWhatDoesNotFit) {
  const auto refused = [](auto change) {
    HandPairOptions options;
    change(options);
    EXPECT_THROW(HandPairTracker{options}, InvalidArgument);
  };
  refused([](auto& o) { o.min_area = -1; });
  refused([](auto& o) { o.min_share = 2; });
  refused([](auto& o) { o.num_kept_frames = -1; });
  HandPairTracker tracker({});
  EXPECT_THROW((void)tracker.push({}), InvalidArgument);
}

}  // namespace
}  // namespace hri
