// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A word network with the chains of its models, as searches pass it: the one pass of
// ConnectedDecoder and the two of Lattice.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "hri/language/connected_decoder.hpp"

namespace hri::detail {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// A possible step into a state.
struct ChainStep {
  int from;
  double log_weight;
};

/// A chain without what it cannot do.
struct SearchChain {
  int first_emission = 0;
  int num_states = 0;
  bool is_silence = false;
  std::vector<ChainStep> steps;  // by the state they lead to
  std::vector<int> first_step;   // of every state, and one past the last
  VectorD log_start;
  VectorD log_exit;
  int most_back = 0;  // how far a step leads back at most, and on
  int most_on = 0;
  int end_of_start = 0;  // one past the last state that a word may begin in

  [[nodiscard]] const ChainStep* steps_into(int state) const {
    return steps.data() + first_step[static_cast<std::size_t>(state)];
  }
  [[nodiscard]] const ChainStep* end_of_steps_into(int state) const {
    return steps.data() + first_step[static_cast<std::size_t>(state) + 1];
  }
};

/// A node of the network that stands for a word or a silence.
struct SearchWord {
  int model = 0;
  int node = 0;
  int first_state = 0;
};

struct SearchNetwork {
  /// Throws InvalidArgument as the constructor of ConnectedDecoder does.
  SearchNetwork(const std::vector<WordChain>& chains, const WordNetwork& network,
                const ConnectedDecoderOptions& options);

  [[nodiscard]] const SearchChain& chain_of(const SearchWord& word) const {
    return models[static_cast<std::size_t>(word.model)];
  }
  [[nodiscard]] int num_nodes() const { return static_cast<int>(word_of_node.size()); }

  std::vector<SearchChain> models;
  int num_emissions = 0;
  int num_states = 0;             ///< of all words
  std::vector<int> word_of_node;  ///< -1: a null node
  std::vector<SearchWord> words;
  std::vector<WordNetwork::Arc> arcs;  ///< in their order, weighted: scale and penalty are in them
  int initial;
  int final;
};

}  // namespace hri::detail
