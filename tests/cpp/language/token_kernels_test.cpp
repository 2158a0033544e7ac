// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/token_kernels.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "hri/core/random.hpp"

namespace hri::detail {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr std::size_t kMargin = 8;  // before and behind the states

// Scores of few values, so that many are equal; one in five is -inf.
std::vector<double> drawn_scores(std::size_t size, Random* random) {
  std::vector<double> scores(size);
  for (double& score : scores) {
    const double drawn = random->uniform();
    score = drawn < 0.2 ? kNever : -static_cast<double>(static_cast<int>(drawn * 8));
  }
  return scores;
}

struct Row {
  std::vector<double> scores;
  std::vector<std::int64_t> origins;

  Row(std::vector<double> of_row, std::int64_t first_origin) : scores(std::move(of_row)) {
    for (std::size_t i = 0; i < scores.size(); ++i)
      origins.push_back(first_origin + static_cast<std::int64_t>(i));
  }
  Tokens from(std::size_t first) { return {scores.data() + first, origins.data() + first}; }
  bool operator==(const Row& other) const {
    return scores == other.scores && origins == other.origins;
  }
};

// One state after another, the offsets in their order.
double advance_plainly(const TokenSteps& steps, std::ptrdiff_t first, std::ptrdiff_t end,
                       double score, std::int64_t origin, const Tokens& before,
                       const float* emissions, const Tokens& after) {
  double best = kNever;
  for (std::ptrdiff_t j = first; j < end; ++j) {
    after.scores[j] = steps.log_start[j] + score;
    after.origins[j] = origin;
    for (std::ptrdiff_t k = 0; k < steps.num_offsets; ++k) {
      const std::ptrdiff_t from = j + steps.offsets[k];
      const double passed = before.scores[from] + steps.weights[k * steps.size + j];
      if (passed <= after.scores[j]) continue;
      after.scores[j] = passed;
      after.origins[j] = before.origins[from];
    }
    after.scores[j] += static_cast<double>(emissions[j]);
    if (after.scores[j] > best) best = after.scores[j];
  }
  return best;
}

TEST(TokenKernels, AdvanceAsPlainLoopsDoOnEveryInstructionSet) {
  Random random(1);
  for (const std::vector<int>& offsets :
       std::vector<std::vector<int>>{{0}, {-1, 0}, {-2, -1, 0}, {-1, 0, 1}, {-7, -3, 0, 2, 8}}) {
    for (const std::size_t num_blocks : {1U, 2U, 5U}) {
      const std::size_t size = num_blocks * kTokenBlock;
      const std::vector<double> weights = drawn_scores(offsets.size() * size, &random);
      const std::vector<double> start = drawn_scores(size, &random);
      Row before(drawn_scores(size + 2 * kMargin, &random), 100);
      std::vector<float> emissions;
      for (std::size_t j = 0; j < size; ++j)
        emissions.push_back(-3 * static_cast<float>(random.uniform()));
      emissions.front() = -std::numeric_limits<float>::infinity();
      const TokenSteps steps{offsets.data(), static_cast<std::ptrdiff_t>(offsets.size()),
                             weights.data(), static_cast<std::ptrdiff_t>(size), start.data()};
      for (const double arriving : {kNever, -2.0}) {
        for (std::ptrdiff_t first = 0; first < static_cast<std::ptrdiff_t>(num_blocks); ++first) {
          const auto end = static_cast<std::ptrdiff_t>(num_blocks);
          // Guards around the states show a store too many.
          const Row untouched(std::vector<double>(size + 2 * kMargin, 7), 0);
          Row expected = untouched;
          const double best =
              advance_plainly(steps, first * kTokenBlock, end * kTokenBlock, arriving, -5,
                              before.from(kMargin), emissions.data(), expected.from(kMargin));
          for (const TokenKernels* kernels : all_token_kernels()) {
            Row found = untouched;
            EXPECT_EQ(kernels->advance(steps, first, end, arriving, -5, before.from(kMargin),
                                       emissions.data(), found.from(kMargin)),
                      best);
            EXPECT_TRUE(found == expected) << offsets.size() << " offsets, " << size << " states";
          }
        }
      }
    }
  }
}

TEST(TokenKernels, PruneWhatLiesBelow) {
  for (const TokenKernels* kernels : all_token_kernels()) {
    for (int alive = 0; alive < kTokenBlock; ++alive) {
      std::vector<double> scores(kTokenBlock + 1, -3);
      std::vector<double> expected(kTokenBlock + 1, kNever);
      scores[static_cast<std::size_t>(alive)] = expected[static_cast<std::size_t>(alive)] = -2;
      expected.back() = -3;
      EXPECT_TRUE(kernels->prune(scores.data(), -2));
      EXPECT_EQ(scores, expected);
      EXPECT_FALSE(kernels->prune(scores.data(), -1));
      EXPECT_EQ(scores[static_cast<std::size_t>(alive)], kNever);
      EXPECT_FALSE(kernels->prune(scores.data(), kNever));
    }
  }
}

TEST(TokenKernels, SpreadWhereTheyScoreHigher) {
  Random random(2);
  for (const std::size_t count : {1U, 3U, 4U, 7U, 8U, 29U}) {
    const std::vector<double> weights = drawn_scores(count, &random);
    const Row before(drawn_scores(count + 1, &random), 0);
    Row expected = before;
    for (std::size_t n = 0; n < count; ++n) {
      if (weights[n] - 1 <= expected.scores[n]) continue;
      expected.scores[n] = weights[n] - 1;
      expected.origins[n] = ~77;
    }
    for (const TokenKernels* kernels : all_token_kernels()) {
      Row found = before;
      kernels->spread(-1, ~77, weights.data(), static_cast<std::ptrdiff_t>(count), found.from(0));
      EXPECT_TRUE(found == expected) << count;
    }
  }
}

}  // namespace
}  // namespace hri::detail
