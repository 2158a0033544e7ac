// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibility_chain.hpp"

#include <algorithm>

namespace hri::detail {

ChainScale::ChainScale(const std::vector<const MarkovChain*>& chains) {
  for (const MarkovChain* chain : chains) {
    start = std::max(start, chain->start().maxCoeff());
    transition = std::max(transition, chain->transition().maxCoeff());
  }
}

PossibilityChain::PossibilityChain(const MarkovChain& chain, const ChainScale& scale)
    : topology(chain.topology()), start(chain.start() / scale.start) {
  if (!chain.jumps()) {
    band = chain.transition() / scale.transition;
    return;
  }
  // Within the band either way leads from i to j; outside only a jump does.
  const double best_land = chain.land().maxCoeff();
  land = chain.land() / best_land;
  leave = chain.leave() * best_land / scale.transition;
  band = MatrixD::Zero(topology.num_states, topology.num_states);
  for (int i = 0; i < topology.num_states; ++i) {
    const int first = topology.first_next(i);
    const int count = topology.end_next(i) - first;
    band.row(i).segment(first, count) =
        chain.transition().row(i).segment(first, count) / scale.transition;
  }
}

std::vector<PossibilityChain> scaled_together(const std::vector<const MarkovChain*>& chains) {
  const ChainScale scale(chains);
  std::vector<PossibilityChain> result;
  result.reserve(chains.size());
  for (const MarkovChain* chain : chains) result.emplace_back(*chain, scale);
  return result;
}

MatrixD PossibilityChain::transition(Join join) const {
  MatrixD s = band;
  for (Eigen::Index i = 0; i < leave.size(); ++i) {
    for (Eigen::Index j = 0; j < land.size(); ++j) {
      const double jump = join == Join::product ? leave[i] * land[j]
                          : join == Join::min   ? std::min(leave[i], land[j])
                                                : std::max(leave[i], land[j]);
      s(i, j) = std::max(s(i, j), jump);
    }
  }
  return s;
}

}  // namespace hri::detail
