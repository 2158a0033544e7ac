// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_threshold.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

std::vector<float> from_to(int first, int last) {
  std::vector<float> scores;
  for (int i = last; i >= first; --i) scores.push_back(static_cast<float>(i));
  return scores;
}

// Of 0..99 right ones t lie below t; of the others -50..49, 50 - t are not below it.
TEST(BalancedThreshold, ExceedsBothRatesByTheSameFactor) {
  const auto threshold = [](double false_reject, double false_accept) {
    return balanced_threshold(from_to(0, 99), from_to(-50, 49), false_reject, false_accept);
  };
  EXPECT_EQ(threshold(0.05, 0.05), 25);   // 25 and 25 %
  EXPECT_EQ(threshold(0.05, 0.2), 10);    // 10 and 40 %
  EXPECT_EQ(threshold(0.2, 0.05), 40);    // 40 and 10 %
  EXPECT_EQ(threshold(0.005, 0.02), 10);  // only their ratio counts
  EXPECT_EQ(threshold(0, 0.05), 0);       // none may be rejected
  EXPECT_EQ(threshold(0.05, 0), 50);      // none may be accepted
}

TEST(BalancedThreshold, RejectsNothingWhereOthersLieBelow) {
  EXPECT_EQ(balanced_threshold(from_to(0, 9), from_to(-9, -1), 0.05, 0.1), 0);
  EXPECT_EQ(balanced_threshold(from_to(3, 9), {}, 0.05, 0.1), 3);
}

TEST(BalancedThreshold, LeavesTheSurestWhereOthersLieAbove) {
  EXPECT_EQ(balanced_threshold(from_to(0, 9), from_to(20, 29), 0.05, 0.01), 9);
}

TEST(BalancedThreshold, RefusesToJudgeWithoutRightWords) {
  EXPECT_THROW(balanced_threshold({}, from_to(0, 9), 0.05, 0.1), InvalidArgument);
}

}  // namespace
}  // namespace hri::detail
