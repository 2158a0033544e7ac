// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How well the best path of an HMM explains a sequence: densities against those of all states, and
// state durations against their expectation.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/sequence_scorer.hpp"

namespace hri::detail {

/// Of `hmms[index]`, as if there were no HMM `left_out` (-1: none).
PathFit fit_path(const std::vector<GaussianMixtureHmm>& hmms, ConstMatrixRefF frames,
                 std::size_t index, int left_out);

}  // namespace hri::detail
