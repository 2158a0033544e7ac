// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sequences drawn from a hidden Markov model.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct SampledSymbols {
  SymbolSequence symbols;
  std::vector<int> states;
};
struct SampledFrames {
  MatrixF frames;
  std::vector<int> states;
};

/// `count` steps (0 or more), the same for the same seed on every platform. Throws InvalidArgument
/// for a negative count.
HRI_API SampledSymbols sample(const DiscreteHmm& model, int count, std::uint64_t seed);
HRI_API SampledFrames sample(const GaussianMixtureHmm& model, int count, std::uint64_t seed);

}  // namespace hri
