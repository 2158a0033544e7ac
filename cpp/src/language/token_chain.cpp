// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/token_chain.hpp"

#include <algorithm>

namespace hri::detail {

TokenChain::TokenChain(const SearchChain& chain)
    : num_blocks_(blocks(chain.num_states)),
      most_back_(chain.most_back),
      most_on_(chain.most_on),
      end_of_start_(chain.end_of_start) {
  const auto size = static_cast<std::size_t>(num_blocks_) * kTokenBlock;
  log_start_.assign(size, kImpossible);
  std::copy_n(chain.log_start.data(), chain.num_states, log_start_.begin());
  for (int offset = -most_on_; offset <= most_back_; ++offset) {
    std::vector<double> weights(size, kImpossible);
    bool is_used = false;
    for (int to = 0; to < chain.num_states; ++to) {
      const ChainStep* const end = chain.end_of_steps_into(to);
      for (const ChainStep* step = chain.steps_into(to); step != end; ++step) {
        if (step->from != to + offset) continue;
        weights[static_cast<std::size_t>(to)] = step->log_weight;
        is_used = true;
      }
    }
    if (!is_used) continue;
    offsets_.push_back(offset);
    weights_.insert(weights_.end(), weights.begin(), weights.end());
  }
  for (int state = 0; state < chain.num_states; ++state) {
    if (chain.log_exit[state] > kImpossible) exits_.push_back({state, chain.log_exit[state]});
  }
}

TokenSteps TokenChain::steps() const {
  return {offsets_.data(), static_cast<std::ptrdiff_t>(offsets_.size()), weights_.data(),
          static_cast<std::ptrdiff_t>(num_blocks_) * kTokenBlock, log_start_.data()};
}

int TokenChain::margin() const { return std::max(most_back_, most_on_); }

int TokenChain::reach_back(int first_block) const {
  return std::max(0, first_block * kTokenBlock - most_back_) / kTokenBlock;
}

int TokenChain::reach_on(int end_block) const {
  return std::min(num_blocks_, blocks(end_block * kTokenBlock + most_on_));
}

}  // namespace hri::detail
