// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Passes of Gaussian-mixture HMMs over many sequences, or of many models over one, several of them
// side by side. The results are those of one pass after the other, to the bit.
#pragma once

#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "models/hmm/forward_backward.hpp"

namespace hri::detail {

/// The E step of Baum-Welch over sequences that are known to be finite: adds what is expected under
/// the model to `counts` and `accumulator`, and returns the log likelihood of all. Polls
/// `should_stop` before every sequence.
double add_expectations(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences,
                        const StopCheck& should_stop, ChainCounts* counts,
                        MixtureAccumulator* accumulator);

/// GaussianMixtureHmm::log_likelihood of every model, as float.
VectorF log_likelihoods(const std::vector<GaussianMixtureHmm>& models, ConstMatrixRefF frames);

}  // namespace hri::detail
