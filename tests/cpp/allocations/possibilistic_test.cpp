// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scoring with possibility-theory HMMs, and quantising frames for them, allocates nothing once the
// thread has done it before.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "hri/models/possibility/fixed_point_hmm.hpp"
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"
#include "hri/models/possibility/possibilistic_stream.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

// Sets of 1, 5 and 40 classes: striped, in one block, in several.
template <class Case>
std::vector<typename Case::Model> classes(const Topology& topology, std::size_t count) {
  std::vector<typename Case::Model> models;
  for (std::size_t c = 0; c < count; ++c) models.push_back(Case::make(topology, c));
  return models;
}

std::vector<PossibilisticRule> rules() {
  PossibilisticRule product;
  PossibilisticRule min;
  min.conjunction = Conjunction::min;
  PossibilisticRule max;
  max.conjunction = Conjunction::max;
  return {product, min, max};
}

std::vector<Topology> topologies() {
  std::vector<Topology> result = kTopologies;
  result.push_back({Kind::left_right, 40, 1});
  return result;
}

TEST(PossibilisticSets, AllocateNothingTheSecondTime) {
  const SymbolSequence s = DiscreteCase::sequence(300, 2);
  const MatrixF frames = GaussianCase::sequence(300, 2);
  for (const Topology& topology : topologies()) {
    for (const std::size_t num_classes : {1U, 5U, 40U}) {
      for (const PossibilisticRule& rule : rules()) {
        const PossibilisticHmmSet discrete(classes<DiscreteCase>(topology, num_classes), rule);
        const PossibilisticGaussianHmmSet gaussian(classes<GaussianCase>(topology, num_classes),
                                                   rule);
        std::vector<float> scores(num_classes);
        const auto score = [&] {
          discrete.log_possibilities(s, scores);
          gaussian.log_possibilities(frames, scores);
        };
        score();
        EXPECT_EQ(allocations_of(score), 0);
        if (rule.conjunction != Conjunction::product) continue;
        const FixedPointHmmSet fixed(discrete);
        fixed.log_possibilities(s, scores);
        EXPECT_EQ(allocations_of([&] { fixed.log_possibilities(s, scores); }), 0);
      }
    }
  }
}

TEST(StatePossibilities, AllocateForFramesOnceNotOneByOne) {
  for (const Topology& topology : topologies()) {
    for (PossibilisticRule rule : rules()) {
      rule.concentration = 1;
      const PossibilisticHmmSet discrete(classes<DiscreteCase>(topology, 3), rule);
      const PossibilisticGaussianHmmSet gaussian(classes<GaussianCase>(topology, 3), rule);
      const auto allocations = [&](int num_frames) {
        const SymbolSequence s = DiscreteCase::sequence(num_frames, 2);
        const MatrixF frames = GaussianCase::sequence(num_frames, 2);
        const auto states = [&] {
          EXPECT_TRUE(std::isfinite(discrete.state_possibilities(1, s).log_possibility));
          EXPECT_TRUE(std::isfinite(gaussian.state_possibilities(1, frames).log_possibility));
        };
        states();
        return allocations_of(states);
      };
      EXPECT_EQ(allocations(300), allocations(3));
    }
  }
}

TEST(PossibilisticStreams, AllocateNothingAtAll) {
  const SymbolSequence s = DiscreteCase::sequence(300, 2);
  for (const Topology& topology : topologies()) {
    for (const std::size_t num_classes : {1U, 5U, 40U}) {
      for (const PossibilisticRule& rule : rules()) {
        const PossibilisticHmmSet set(classes<DiscreteCase>(topology, num_classes), rule);
        std::vector<float> scores(num_classes);
        for (const double beam : {kInfinity, 3.0}) {
          HmmStreamOptions options;
          options.beam = beam;
          PossibilisticHmmStream stream(set, options);
          EXPECT_EQ(allocations_of([&] {
                      for (const std::int32_t symbol : s) {
                        stream.push(symbol);
                        stream.log_possibilities(scores);
                      }
                      stream.reset();
                      stream.push(s[0]);
                    }),
                    0);
        }
      }
    }
  }
}

TEST(Codebooks, QuantiseWithoutAllocating) {
  CodebookOptions options;
  options.num_codewords = 16;
  const Codebook one = Codebook::train_lbg(noise(200, 6, 1), options);
  const MultiStreamCodebook two({one, Codebook::train_lbg(noise(200, 3, 2), options)});
  const MatrixF frames = noise(300, 6, 3);
  const MatrixF wide = noise(300, 9, 4);
  std::vector<std::int32_t> symbols(300);
  std::vector<std::int32_t> pairs(600);
  const auto quantise = [&] {
    one.quantise(frames, symbols);
    two.quantise(wide, pairs);
  };
  quantise();
  EXPECT_EQ(allocations_of(quantise), 0);
}

}  // namespace
}  // namespace hri
