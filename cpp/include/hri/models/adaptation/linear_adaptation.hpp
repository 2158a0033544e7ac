// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Maximum-likelihood linear adaptation (Leggetter and Woodland, Computer Speech and Language 9(2),
// 1995) with diagonal matrices: one change of all means and variances together, so that a few words
// adapt the models of all words to a voice, a microphone or a noise.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/hmm/mixture_bank.hpp"

namespace hri {

/// Of every dimension: mean' = slope * mean + offset, variance' = spread * variance.
struct HRI_API LinearAdaptation {
  VectorD slope;
  VectorD offset;
  VectorD spread;

  [[nodiscard]] MixtureBank apply(const MixtureBank& bank) const;
};

/// The adaptation under which `models` explain their sequences best (one step of expectation and
/// maximisation). `prior_frames` imagined frames of the models themselves hold it near the
/// identity, > 0. `per_model[m]` holds the sequences of models[m], which may be none. Throws
/// InvalidArgument for frames that do not fit or are not finite.
HRI_API LinearAdaptation
estimate_linear_adaptation(const std::vector<GaussianMixtureHmm>& models,
                           const std::vector<std::vector<MatrixF>>& per_model, double prior_frames,
                           const StopCheck& should_stop);

}  // namespace hri
