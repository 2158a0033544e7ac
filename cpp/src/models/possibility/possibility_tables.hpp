// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Everything a set of discrete possibility-theory HMMs needs to score: transitions of all classes
// and emissions symbol by symbol, in the layout of possibility_chains.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "models/possibility/possibility_chains.hpp"

namespace hri::detail {

/// Throws InvalidArgument naming position and symbol.
void check_symbols(Span<const std::int32_t> symbols, int num_symbols);

/// `largest` divides the emissions of every symbol (eq. 5.14). With min and conditioning every
/// symbol is conditioned within the class: its best state is fully possible, and how possible that
/// is goes straight into the score.
template <class T>
class SymbolScorer {
 public:
  SymbolScorer(const std::vector<DiscreteHmm>& models, const VectorD& largest,
               const ChainRule<T>& rule, double units = 1);

  [[nodiscard]] const PossibilityChains<T>& chains() const { return chains_; }
  [[nodiscard]] int num_blocks() const { return chains_.layout().num_blocks; }

  /// Log possibility of every class, in the unit of T, num_classes values. Allocates nothing once
  /// the thread has scored with a set of this size.
  void score(Span<const std::int32_t> symbols, double* out) const;
  /// Advances one block by some frames.
  void advance(int block, Span<const std::int32_t> symbols, ChainWorkspace<T>* workspace) const;

 private:
  PossibilityChains<T> chains_;
  void condition_symbols();

  std::vector<T> emissions_;  // (num_blocks, num_symbols, block_size)
  std::vector<T> levels_;     // (num_blocks, num_symbols, num_lanes), or empty
  int num_symbols_ = 0;
};

/// The chains of all models as possibilities.
std::vector<PossibilityChain> possibility_chains(const std::vector<DiscreteHmm>& models);

/// The scorer of everyday.
struct PossibilityTables {
  SymbolScorer<float> scorer;
};

}  // namespace hri::detail
