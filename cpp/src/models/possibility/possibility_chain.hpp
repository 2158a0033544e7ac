// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Transition probabilities of trained HMMs as possibilities, all classes on one scale.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/hmm/markov_chain.hpp"
#include "models/possibility/possibility_kernel.hpp"

namespace hri::detail {

/// What possibilities are divided by: the largest of their kind over all classes and states
/// (eq. 5.14), so that a class pays for staying and going on as it does for its symbols.
struct ChainScale {
  explicit ChainScale(const std::vector<const MarkovChain*>& chains);
  double start = 0;
  double transition = 0;
};

/// Possibilities of one class, not in logs. With jumps s_ij is the larger of band(i, j) and
/// (leave[i] and land[j]).
struct PossibilityChain {
  PossibilityChain(const MarkovChain& chain, const ChainScale& scale);
  Topology topology;
  VectorD start;
  MatrixD band;  ///< all of s_ij but for rank_one_plus_band
  VectorD leave;
  VectorD land;
  /// s_ij, shape (num_states, num_states).
  [[nodiscard]] MatrixD transition(Join join) const;
};

/// The chains of models, in their order.
template <class Model>
std::vector<const MarkovChain*> chains_of(const std::vector<Model>& models) {
  std::vector<const MarkovChain*> chains;
  chains.reserve(models.size());
  for (const Model& model : models) chains.push_back(&model.chain());
  return chains;
}

/// The chains of all classes.
std::vector<PossibilityChain> scaled_together(const std::vector<const MarkovChain*>& chains);

}  // namespace hri::detail
