// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Decoding of possibility-theory HMMs: the path whose possibility the recursion has.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/possibility/possibility_chain.hpp"

namespace hri::detail {

/// a "and" b, in logs.
double join(Conjunction conjunction, double a, double b);

/// The forward recursion of one class, in logs, with all that the way back needs.
struct ForwardTable {
  MatrixD log_s;     ///< transitions
  MatrixD log_b;     ///< emissions, conditioned where the rule is
  MatrixD phi;       ///< (num_frames, num_states), conditioned where the rule is
  Matrix<int> from;  ///< the best state to come from
  VectorD taken;     ///< what conditioning took out of every row of phi
  double score = 0;  ///< of the whole sequence
  int last = 0;      ///< the best state of the last frame
};

/// `log_b` (num_frames, num_states) holds log possibilities of emissions.
ForwardTable forward_table(const PossibilityChain& chain, const PossibilisticRule& rule,
                           MatrixD log_b);

/// The log possibility of the most possible path of one class, and the path if wanted: empty where
/// it is impossible. `log_b` as above.
double most_possible_path(const PossibilityChain& chain, const PossibilisticRule& rule,
                          MatrixD log_b, std::vector<int>* path);

}  // namespace hri::detail
