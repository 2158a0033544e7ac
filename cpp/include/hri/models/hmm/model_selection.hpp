// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The number of states of an HMM from data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct StateChoiceOptions {
  enum class Criterion : std::uint8_t {
    bic,       ///< log-likelihood - parameters / 2 * log(frames) (Schwarz, 1978)
    held_out,  ///< log-likelihood a frame of sequences that training did not see
  };
  Criterion criterion = Criterion::bic;
  int num_folds = 5;
  int num_restarts = 3;
  std::uint64_t seed = 0;

  static constexpr const char* kName = "StateChoiceOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("criterion", o.criterion, any_value, "what the candidates are compared by");
    v("num_folds", o.num_folds, within(2, 1000000),
      "held_out: parts of the sequences, at most their number");
    v("num_restarts", o.num_restarts, within(1, 1000),
      "trainings of every candidate, of which the likeliest counts; left-right models are trained "
      "once");
    v("seed", o.seed, any_seed, "of the folds and of the restarts");
  }
};
constexpr auto enum_names(StateChoiceOptions::Criterion) { return std::array{"bic", "held_out"}; }

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
