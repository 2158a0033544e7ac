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

/// The log possibility of the most possible path of one class, and the path if wanted: empty where
/// it is impossible. `log_b` (num_frames, num_states) holds log possibilities of emissions.
double most_possible_path(const PossibilityChain& chain, const PossibilisticRule& rule,
                          const MatrixD& log_b, std::vector<int>* path);

}  // namespace hri::detail
