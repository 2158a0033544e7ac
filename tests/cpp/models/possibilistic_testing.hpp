// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Words and models of the tests of possibility-theory HMMs.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/model_testing.hpp"

namespace hri::testing_data {

constexpr int kNumClasses = 4;
constexpr int kNumSymbols = 6;

// Words that share their symbols and differ in their order: class c cycles through the symbols from
// c on.
inline SymbolSequence word(int class_index, std::uint64_t seed) {
  Random random(seed);
  SymbolSequence s;
  for (int stretch = 0; stretch < 3; ++stretch) {
    const int length = 4 + static_cast<int>(random.below(5));
    for (int t = 0; t < length; ++t) {
      const bool wrong = random.uniform() < 0.1;
      const int right = class_index % 2 == 0 ? class_index + stretch : class_index + 2 - stretch;
      s.push_back(wrong ? static_cast<std::int32_t>(random.below(kNumSymbols))
                        : right % kNumSymbols);
    }
  }
  return s;
}

inline std::vector<std::vector<SymbolSequence>> words(int per_class, std::uint64_t seed) {
  std::vector<std::vector<SymbolSequence>> per(kNumClasses);
  for (int c = 0; c < kNumClasses; ++c) {
    for (int i = 0; i < per_class; ++i) per[static_cast<std::size_t>(c)].push_back(word(c, seed++));
  }
  return per;
}

inline PossibilisticHmmOptions with(Conjunction conjunction,
                                    Topology topology = {Topology::Kind::left_right, 3, 1}) {
  PossibilisticHmmOptions options;
  options.topology = topology;
  options.num_symbols = kNumSymbols;
  options.rule.conjunction = conjunction;
  return options;
}

// Models with arbitrary parameters, from training on noise.
inline std::vector<DiscreteHmm> random_models(std::size_t num_classes, const Topology& topology) {
  std::vector<DiscreteHmm> models;
  DiscreteHmmOptions options;
  options.topology = topology;
  options.num_symbols = kNumSymbols;
  options.max_iterations = 2;
  for (std::size_t c = 0; c < num_classes; ++c) {
    Random random(c + 1);
    std::vector<SymbolSequence> sequences(3);
    for (SymbolSequence& s : sequences) {
      for (int t = 0; t < 3 * topology.num_states; ++t)
        s.push_back(static_cast<std::int32_t>(random.below(kNumSymbols)));
    }
    options.seed = c;
    models.push_back(DiscreteHmm::train(sequences, options));
  }
  return models;
}

}  // namespace hri::testing_data
