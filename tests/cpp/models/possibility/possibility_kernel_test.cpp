// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The recursion of every instruction set against plain loops, to the bit.
#include "models/possibility/possibility_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "models/plain_possibility.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

constexpr std::int16_t kGuard = 1234;  // what sweeps must not read

template <class T>
Outcome<T> outcome_of(const ChainKernels<T>& kernels, const Tables<T>& t, const ChainRule<T>& rule,
                      const std::vector<std::int32_t>& symbols) {
  const bool sweeps = t.block.steps != Steps::as_given;
  const auto size = static_cast<std::size_t>(t.size());
  const auto edge = sweeps ? 0 : static_cast<std::size_t>(t.margin * t.block.num_lanes);
  const auto lanes = static_cast<std::size_t>(t.block.num_lanes);
  // Buffers of their own, so that a sanitizer sees an access beyond; sweeps start from rubbish.
  const T filling = sweeps ? static_cast<T>(kGuard) : floor_of<T>();
  std::vector<T> phi(size + 2 * edge, filling);
  std::vector<T> next = phi;
  std::vector<T> scratch(lanes, static_cast<T>(kGuard));
  std::vector<typename ScaleOf<T>::Type> scale(lanes, 0);
  ChainState<T> state;
  state.phi = phi.data() + edge;
  state.next = next.data() + edge;
  state.lanes = scratch.data();
  state.scale = scale.data();
  FrameTable<T> frames;
  frames.rows = t.emissions.data();
  frames.row_size = t.size();
  frames.levels = t.levels.empty() ? nullptr : t.levels.data();
  frames.index = symbols.data();
  kernels.advance(t.block, rule, t.start.data(), frames,
                  static_cast<std::ptrdiff_t>(symbols.size()), &state);
  EXPECT_EQ(state.num_frames, static_cast<std::int64_t>(symbols.size()));
  Outcome<T> result{std::vector<T>(state.phi, state.phi + size), {scale.begin(), scale.end()}};
  for (const std::vector<T>* buffer : {&phi, &next}) {
    for (std::size_t x = 0; x < edge; ++x) {
      EXPECT_EQ((*buffer)[x], filling);
      EXPECT_EQ((*buffer)[buffer->size() - 1 - x], filling);
    }
  }
  return result;
}

template <class T>
void expect_plain(const Tables<T>& tables, const ChainRule<T>& rule, const std::string& what) {
  Random random(7);
  for (const int length : {1, 2, 4, 5, 6, 9, 30}) {
    std::vector<std::int32_t> symbols;
    for (int t = 0; t < length; ++t)
      symbols.push_back(static_cast<std::int32_t>(random.below(kNumTableSymbols)));
    const Outcome<T> expected = Plain<T>(tables, rule).run(symbols);
    for (const ChainKernels<T>& kernels : chain_kernels<T>()) {
      const Outcome<T> found = outcome_of(kernels, tables, rule, symbols);
      ASSERT_EQ(found.phi, expected.phi) << kernels.name << ", " << what << ", " << length;
      ASSERT_EQ(found.scale, expected.scale) << kernels.name << ", " << what << ", " << length;
    }
  }
}

template <class T>
ChainRule<T> rule_of(Join join) {
  ChainRule<T> rule;
  rule.join = join;
  rule.floor = floor_of<T>();
  if (kInteger<T>) rule.condition_every = 4;
  if (join != Join::min) return rule;
  rule.condition_every = 1;
  rule.concentration = static_cast<T>(1.5);
  return rule;
}

template <class T>
class PossibilityKernel : public ::testing::Test {};
using Values = ::testing::Types<float, double, std::int16_t>;
TYPED_TEST_SUITE(PossibilityKernel, Values);

TYPED_TEST(PossibilityKernel, IsThePlainRecursionOnEveryInstructionSet) {
  using T = TypeParam;
  ASSERT_FALSE(chain_kernels<T>().empty());
  Random random(1);
  const std::vector<std::vector<int>> diagonals{
      {0}, {0, 1}, {-1, 0, 1}, {0, 1, 2}, {-2, -1, 0, 1, 2}};
  for (const Join join : {Join::product, Join::min, Join::max}) {
    if (kInteger<T> && join != Join::product) continue;
    for (const int num_lanes : {1, 3, 16, 48, 64}) {
      for (const int num_states : {1, 2, 5, 17}) {
        const std::string what = "join " + std::to_string(static_cast<int>(join)) + ", " +
                                 std::to_string(num_states) + " x " + std::to_string(num_lanes);
        const bool levels = join == Join::min;
        const auto check = [&](Structure structure, const std::vector<int>& offsets) {
          expect_plain(any_structure<T>(structure, num_states, num_lanes, offsets, levels, &random),
                       rule_of<T>(join),
                       what + ", " + std::to_string(offsets.size()) + " diagonals");
        };
        for (const auto& offsets : diagonals) {
          if (offsets.back() >= num_states) continue;
          check(Structure::bands, offsets);
          check(Structure::jumps, offsets);
        }
        check(Structure::dense, {});
      }
    }
  }
}

TYPED_TEST(PossibilityKernel, SweepsLikeThePlainRecursionOnEveryInstructionSet) {
  using T = TypeParam;
  Random random(2);
  const ChainRule<T> rule = rule_of<T>(Join::product);
  for (const Steps steps : {Steps::free_stay, Steps::free}) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      for (const int num_lanes : {16, 32, 48, 64}) {
        for (const int num_states : {2, 5, 40})
          expect_plain(left_right<T>(steps, false, num_states, num_lanes, &random), rule, "lanes");
      }
      constexpr int kLanes = 64 / static_cast<int>(sizeof(T));
      for (const int num_rows : {1, 2, 3, 4, 5, 8, 16, 17})
        expect_plain(left_right<T>(steps, true, num_rows, kLanes, &random), rule, "striped");
    }
  }
}

TYPED_TEST(PossibilityKernel, FindsTheBestOfEveryLaneOnEveryInstructionSet) {
  using T = TypeParam;
  Random random(3);
  for (const int num_lanes : {1, 3, 16, 64}) {
    for (const int num_rows : {1, 4, 9}) {
      const auto size = static_cast<std::size_t>(num_rows) * static_cast<std::size_t>(num_lanes);
      std::vector<T> phi(size);
      std::vector<T> ends(size);
      for (T& v : phi) v = std::max(random_entry<T>(&random), floor_of<T>());
      for (T& v : ends) v = static_cast<T>(100 * random.normal());
      for (const ChainKernels<T>& kernels : chain_kernels<T>()) {
        std::vector<T> best(static_cast<std::size_t>(num_lanes));
        kernels.best_of_lanes(phi.data(), ends.data(), num_rows, num_lanes, floor_of<T>(),
                              best.data());
        for (std::size_t l = 0; l < best.size(); ++l) {
          T expected =
              kInteger<T> ? std::numeric_limits<T>::min() : -std::numeric_limits<T>::infinity();
          for (std::size_t x = l; x < size; x += best.size()) {
            if (phi[x] > floor_of<T>())
              expected = std::max(expected, static_cast<T>(phi[x] + ends[x]));
          }
          EXPECT_EQ(best[l], expected) << kernels.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hri::detail
