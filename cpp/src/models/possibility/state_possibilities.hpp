// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The backward recursion of possibility-theory HMMs, and the states that it and the forward one
// leave possible.
#pragma once

#include "hri/core/types.hpp"
#include "hri/models/hmm/markov_chain.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "hri/models/possibility/state_possibilities.hpp"
#include "models/possibility/possibility_chain.hpp"

namespace hri::detail {

/// Of one class, whose possibilities are those of `chain` over `scale`. `log_b` (num_frames >= 1,
/// num_states) holds log possibilities of emissions. Throws InvalidArgument for a conditioned
/// minimum with a concentration above 1.
StatePossibilities state_possibilities(const MarkovChain& chain, const ChainScale& scale,
                                       const PossibilisticRule& rule, MatrixD log_b);

}  // namespace hri::detail
