// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A chain as the kernels of token passing want it.
#pragma once

#include <vector>

#include "language/search_network.hpp"
#include "language/token_kernels.hpp"

namespace hri::detail {

class TokenChain {
 public:
  /// A state that a word may end in.
  struct Exit {
    int state;
    double log_weight;
  };

  explicit TokenChain(const SearchChain& chain);

  [[nodiscard]] TokenSteps steps() const;
  [[nodiscard]] int num_blocks() const { return num_blocks_; }
  [[nodiscard]] const std::vector<Exit>& exits() const { return exits_; }
  /// How many states the offsets reach beyond a block.
  [[nodiscard]] int margin() const;

  /// The first block that a step leads to from `first_block` or one behind it.
  [[nodiscard]] int reach_back(int first_block) const;
  /// One past the last block that a step leads to from before `end_block`, or that a word begins
  /// in.
  [[nodiscard]] int reach_on(int end_block) const;
  [[nodiscard]] int end_of_start() const { return blocks(end_of_start_); }

 private:
  static int blocks(int num_states) { return (num_states + kTokenBlock - 1) / kTokenBlock; }

  int num_blocks_;
  int most_back_;
  int most_on_;
  int end_of_start_;
  std::vector<int> offsets_;
  std::vector<double> weights_;
  std::vector<double> log_start_;
  std::vector<Exit> exits_;
};

}  // namespace hri::detail
