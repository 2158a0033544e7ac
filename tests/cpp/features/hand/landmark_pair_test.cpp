// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/landmark_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kWidth = 640;

// A wrist and five straight fingers that point `turn` from upwards.
MatrixF joints_of_hand(double x, double y, double turn = 0) {
  MatrixF points(kNumLandmarks, 2);
  points.row(0) << static_cast<float>(x), static_cast<float>(y);
  for (int finger = 0; finger < 5; ++finger) {
    const double angle = turn + 0.2 * (finger - 2);
    for (int joint = 0; joint < 4; ++joint) {
      const double r = 30 + 15 * joint;
      points.row(1 + 4 * finger + joint) << static_cast<float>(x + r * std::sin(angle)),
          static_cast<float>(y - r * std::cos(angle));
    }
  }
  return points;
}

using JointsOfHands = std::vector<MatrixF>;
using Found = std::array<int, 2>;

TEST(LandmarkPairTracker, TellsHandsBySideWhateverTheirOrder) {
  LandmarkPairTracker pair;
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(500, 300), joints_of_hand(100, 300)}, kWidth),
            (Found{1, 0}));
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(110, 300), joints_of_hand(490, 300)}, kWidth),
            (Found{0, 1}));
  pair.reset();
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(500, 300)}, kWidth), (Found{-1, 0}));
  EXPECT_EQ(pair.push({}, kWidth), (Found{-1, -1}));
}

TEST(LandmarkPairTracker, LabelsStayWithHandsThatCross) {
  LandmarkPairTracker pair;
  for (int t = 0; t <= 20; ++t) {
    const MatrixF left = joints_of_hand(100 + 20 * t, 300, 0.5);
    const MatrixF right = joints_of_hand(500 - 20 * t, 310, -0.5);
    const bool swapped = t % 2 == 1;
    const JointsOfHands hands = swapped ? JointsOfHands{right, left} : JointsOfHands{left, right};
    EXPECT_EQ(pair.push(hands, kWidth), (swapped ? Found{1, 0} : Found{0, 1})) << t;
  }
}

TEST(LandmarkPairTracker, AHandThatVanishesComesBackAsItself) {
  LandmarkPairTracker pair;
  pair.push(JointsOfHands{joints_of_hand(200, 300), joints_of_hand(400, 300)}, kWidth);
  for (int t = 0; t < 8; ++t)
    EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(400 - 15 * t, 300)}, kWidth), (Found{-1, 0}))
        << t;
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(290, 300), joints_of_hand(190, 300)}, kWidth),
            (Found{1, 0}));
  for (int t = 0; t < 30; ++t) pair.push({}, kWidth);  // both are forgotten
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(500, 300)}, kWidth), (Found{-1, 0}));
}

TEST(LandmarkPairTracker, OneHandFoundTwiceIsOne) {
  LandmarkPairTracker pair;
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(100, 300), joints_of_hand(103, 301)}, kWidth),
            (Found{0, -1}));
  EXPECT_EQ(pair.push(JointsOfHands{joints_of_hand(100, 300), joints_of_hand(103, 301),
                                    joints_of_hand(500, 300)},
                      kWidth),
            (Found{0, 2}));
}

TEST(LandmarkPairTracker, RefusesWhatIsNoHand) {
  LandmarkPairTracker pair;
  EXPECT_THROW(pair.push(JointsOfHands{MatrixF::Zero(20, 2)}, kWidth), InvalidArgument);
  EXPECT_THROW(pair.push(JointsOfHands{joints_of_hand(1, 1)}, 0), InvalidArgument);
  MatrixF broken = joints_of_hand(1, 1);
  broken(3, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(pair.push(JointsOfHands{broken}, kWidth), InvalidArgument);
  LandmarkPairOptions options;
  options.min_apart = -1;
  EXPECT_THROW(LandmarkPairTracker{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
