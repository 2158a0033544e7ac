// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"
#include "hri/core/types.hpp"

namespace hri {
namespace {

TEST(Error, KindsThrowTheirClassesWithTheMessage) {
  EXPECT_THROW(fail(ErrorKind::invalid_argument, "x"), InvalidArgument);
  EXPECT_THROW(fail(ErrorKind::format, "x"), FormatError);
  EXPECT_THROW(fail(ErrorKind::io, "x"), IoError);
  EXPECT_THROW(fail(ErrorKind::interrupted, "x"), Interrupted);
  EXPECT_NO_THROW(require(true, "fine"));
  try {
    require(false, "num_states must lie in 1..64");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "num_states must lie in 1..64");
  }
}

TEST(Span, SeesVectorsAndParts) {
  std::vector<float> values{1, 2, 3, 4};
  const Span<float> all(values);
  const Span<const float> read_only(all);
  EXPECT_EQ(read_only.size(), 4U);
  const Span<const float> middle = read_only.subspan(1, 2);
  EXPECT_EQ(std::vector<float>(middle.begin(), middle.end()), (std::vector<float>{2, 3}));
  all[0] = 9;
  EXPECT_EQ(values[0], 9);
  EXPECT_TRUE(Span<float>().empty());
}

TEST(Matrix, IsRowMajorSoThatAFrameIsContiguous) {
  MatrixF frames(2, 3);
  frames << 0, 1, 2, 3, 4, 5;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(frames.data()[i], static_cast<float>(i));
}

TEST(ImageView, FollowsStrideAndChannels) {
  const std::vector<std::uint8_t> pixels{1, 2, 3, 4, 5, 6, 99, 99, 7, 8, 9, 10, 11, 12, 99, 99};
  const ImageView view{pixels.data(), 2, 2, 3, 8};
  EXPECT_EQ(view.at(1, 0, 2), 6);
  EXPECT_EQ(view.at(0, 1, 1), 8);
  EXPECT_FALSE(view.empty());
  EXPECT_TRUE(ImageView{}.empty());
  EXPECT_EQ(GreyImage(3, 2).pixels, std::vector<std::uint8_t>(6, 0));
}

// First values of SplitMix64 with seed 1234567, as published with the algorithm.
TEST(Random, IsTheSameEverywhere) {
  Random random(1234567);
  EXPECT_EQ(random.next_u64(), 6457827717110365317ULL);
  EXPECT_EQ(random.next_u64(), 3203168211198807973ULL);
  EXPECT_EQ(random.next_u64(), 9817491932198370423ULL);
}

TEST(Random, DrawsWithTheRightMoments) {
  Random random(7);
  double sum = 0;
  double squares = 0;
  std::set<std::uint64_t> seen;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    EXPECT_GE(u, 0.0);
    EXPECT_LT(u, 1.0);
    const double x = random.normal();
    sum += x;
    squares += x * x;
    seen.insert(random.below(7));
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(squares / kCount, 1.0, 0.05);
  EXPECT_EQ(seen, (std::set<std::uint64_t>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(Dot, EqualsTheSumInDoubleForEveryLength) {
  Random random(3);
  std::vector<float> a(70);
  std::vector<float> b(70);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = static_cast<float>(random.normal());
    b[i] = static_cast<float>(random.normal());
  }
  double sum = 0;
  for (int count = 0; count <= 70; ++count) {
    EXPECT_NEAR(dot(a.data(), b.data(), count), sum, 1e-4) << count;
    if (count < 70)
      sum += static_cast<double>(a[static_cast<std::size_t>(count)]) *
             b[static_cast<std::size_t>(count)];
  }
}

TEST(FirstNotFinite, SeesABadValueAnywhere) {
  std::vector<float> values(50, 3e38F);
  EXPECT_EQ(first_not_finite(values.data(), values.size()), 50U);
  EXPECT_EQ(first_not_finite(nullptr, 0), 0U);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
      values[i] = bad;
      EXPECT_EQ(first_not_finite(values.data(), values.size()), i);
    }
    values[i] = -1e-45F;
  }
  values[7] = values[30] = std::nanf("");
  EXPECT_EQ(first_not_finite(values.data(), values.size()), 7U);
}

}  // namespace
}  // namespace hri
