// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The number of states of an HMM from data.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct StateChoiceOptions {
  enum class Criterion : std::uint8_t {
    bic,       ///< log-likelihood - parameters / 2 * log(frames) (Schwarz, 1978)
    held_out,  ///< log-likelihood a frame of sequences that training did not see
  };
  Criterion criterion = Criterion::bic;
  int num_folds = 5;       ///< held_out: parts of the sequences, 2..number of sequences
  int num_restarts = 3;    ///< trainings of every candidate, the likeliest counts, 1..1000; models
                           ///< that are left-right begin alike and are trained once
  std::uint64_t seed = 0;  ///< of the folds and of the restarts
};

struct StateChoice {
  struct Candidate {
    int num_states = 0;
    double score = 0;           ///< the larger, the better
    double log_likelihood = 0;  ///< bic: of all sequences; held_out: of those held out, added up
    std::int64_t num_parameters = 0;
  };
  int num_states = 0;                 ///< of the best score; the smallest where scores are equal
  std::vector<Candidate> candidates;  ///< in the order they were given
};

/// Free parameters: start and transition probabilities less one for every sum that is 1. Structural
/// zeros are none, nor is a start in state 0.
HRI_API std::int64_t num_free_parameters(const Topology& topology);
HRI_API std::int64_t num_free_parameters(const DiscreteHmmOptions& options);
HRI_API std::int64_t num_free_parameters(const GaussianMixtureHmmOptions& options, int dim);

/// Trains models of every number of states in `candidates` with `options` (whose own num_states is
/// not read). Throws InvalidArgument for no candidate, or what train() refuses.
HRI_API StateChoice choose_num_states(const std::vector<SymbolSequence>& sequences,
                                      const DiscreteHmmOptions& options, Span<const int> candidates,
                                      const StateChoiceOptions& choice = {});
HRI_API StateChoice choose_num_states(const std::vector<MatrixF>& sequences,
                                      const GaussianMixtureHmmOptions& options,
                                      Span<const int> candidates,
                                      const StateChoiceOptions& choice = {});

}  // namespace hri
