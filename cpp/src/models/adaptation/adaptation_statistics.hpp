// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the adaptations of Gaussian-mixture HMMs share: sums over new data by state and component.
#pragma once

#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/hmm/mixture_bank.hpp"

namespace hri::detail {

/// Throws InvalidArgument for frames that have not `dim` columns or are not finite.
void check_adaptation_data(const std::vector<MatrixF>& sequences, int dim);

/// Adds `sequences`, aligned by the forward-backward recursion of `chain` with the densities of
/// `bank`. A sequence that is impossible under them adds nothing.
void add_aligned(const MarkovChain& chain, const MixtureBank& bank,
                 const std::vector<MatrixF>& sequences, const StopCheck& should_stop,
                 MixtureAccumulator* accumulator);

}  // namespace hri::detail
