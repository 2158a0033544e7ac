// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/framing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

TEST(Framing, CountsAsTryingEveryFrameDoes) {
  for (const int length : {1, 2, 7, 400}) {
    for (const int shift : {1, 3, 160, 500}) {
      for (std::size_t size = 0; size < 1000; size += 13) {
        int fit = 0;
        while (static_cast<std::size_t>(fit) * static_cast<std::size_t>(shift) +
                   static_cast<std::size_t>(length) <=
               size)
          ++fit;
        EXPECT_EQ(num_frames(size, length, shift), fit) << size << " " << length << " " << shift;
      }
    }
  }
}

TEST(Framing, RefusesEmptyFramesAndShifts) {
  for (const int bad : {0, -1}) {
    EXPECT_THROW(num_frames(100, bad, 1), InvalidArgument);
    EXPECT_THROW(num_frames(100, 10, bad), InvalidArgument);
    EXPECT_THROW(make_window(WindowKind::hamming, bad), InvalidArgument);
  }
}

TEST(Hamming, IsSymmetricAndFollowsItsFormula) {
  EXPECT_EQ(make_window(WindowKind::hamming, 1), std::vector<float>{1});
  for (const int size : {2, 3, 64, 399, 400}) {
    const std::vector<float> w = make_window(WindowKind::hamming, size);
    ASSERT_EQ(w.size(), static_cast<std::size_t>(size));
    for (std::size_t n = 0; n < w.size(); ++n) {
      EXPECT_FLOAT_EQ(w[n], w[w.size() - 1 - n]) << size << " " << n;
      EXPECT_GE(w[n], 0.0799F);
      EXPECT_LE(w[n], 1.0F);
    }
    EXPECT_NEAR(w[0], 0.08, 1e-7);
  }
  EXPECT_NEAR(make_window(WindowKind::hamming, 9)[2], 0.54,
              1e-7);  // a quarter of the way, where the cosine is 0
}

}  // namespace
}  // namespace hri
