// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/model_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

DiscreteHmm train(const std::vector<SymbolSequence>& sequences, const DiscreteHmmOptions& options) {
  return DiscreteHmm::train(sequences, options);
}

GaussianMixtureHmm train(const std::vector<MatrixF>& sequences,
                         const GaussianMixtureHmmOptions& options) {
  return GaussianMixtureHmm::train(sequences, options);
}

double num_frames(const SymbolSequence& s) { return static_cast<double>(s.size()); }
double num_frames(const MatrixF& s) { return static_cast<double>(s.rows()); }

std::int64_t num_parameters(const std::vector<SymbolSequence>&, const DiscreteHmmOptions& options) {
  return num_free_parameters(options);
}

std::int64_t num_parameters(const std::vector<MatrixF>& sequences,
                            const GaussianMixtureHmmOptions& options) {
  return num_free_parameters(options, static_cast<int>(sequences.front().cols()));
}

template <class Model, class Sequence>
double total_likelihood(const Model& model, const std::vector<Sequence>& sequences) {
  double total = 0;
  for (const Sequence& s : sequences) total += model.log_likelihood_exact(s);
  return total;
}

// The likeliest of several trainings.
template <class Sequence, class Options>
auto best_of(const std::vector<Sequence>& sequences, Options options,
             const StateChoiceOptions& choice) {
  const bool alike = options.topology.kind == Topology::Kind::left_right;
  options.seed = choice.seed;
  auto best = train(sequences, options);
  double best_total = total_likelihood(best, sequences);
  for (int restart = 1; restart < (alike ? 1 : choice.num_restarts); ++restart) {
    options.seed = choice.seed + static_cast<std::uint64_t>(restart);
    auto model = train(sequences, options);
    const double total = total_likelihood(model, sequences);
    if (total > best_total) {
      best = std::move(model);
      best_total = total;
    }
  }
  return std::make_pair(std::move(best), best_total);
}

// The fold of every sequence: as many in each, in a seeded order.
std::vector<int> folds(std::size_t count, const StateChoiceOptions& choice) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(choice.seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  std::vector<int> fold(count);
  for (std::size_t i = 0; i < count; ++i)
    fold[order[i]] = static_cast<int>(i % static_cast<std::size_t>(choice.num_folds));
  return fold;
}

template <class Sequence, class Options>
double held_out_likelihood(const std::vector<Sequence>& sequences, const Options& options,
                           const StateChoiceOptions& choice) {
  const std::vector<int> fold = folds(sequences.size(), choice);
  double total = 0;
  for (int f = 0; f < choice.num_folds; ++f) {
    std::vector<Sequence> seen;
    std::vector<Sequence> held;
    for (std::size_t s = 0; s < sequences.size(); ++s)
      (fold[s] == f ? held : seen).push_back(sequences[s]);
    total += total_likelihood(best_of(seen, options, choice).first, held);
  }
  return total;
}

template <class Sequence, class Options>
StateChoice choose(const std::vector<Sequence>& sequences, Options options,
                   Span<const int> candidates, const StateChoiceOptions& choice) {
  require(!candidates.empty(), "candidates must name at least one number of states");
  require(!sequences.empty(), "training needs at least one sequence");
  validate(choice);
  const bool held_out = choice.criterion == StateChoiceOptions::Criterion::held_out;
  if (held_out) {
    require(static_cast<std::size_t>(choice.num_folds) <= sequences.size(),
            "num_folds must lie in 2..number of sequences");
  }
  double frames = 0;
  for (const Sequence& s : sequences) frames += num_frames(s);
  StateChoice result;
  std::optional<StateChoice::Candidate> best;
  for (const int num_states : candidates) {
    options.topology.num_states = num_states;
    StateChoice::Candidate c;
    c.num_states = num_states;
    if (held_out) {
      c.log_likelihood = held_out_likelihood(sequences, options, choice);
      c.score = c.log_likelihood / frames;
      c.num_parameters = num_parameters(sequences, options);
    } else {
      c.log_likelihood = best_of(sequences, options, choice).second;
      c.num_parameters = num_parameters(sequences, options);
      c.score = c.log_likelihood - 0.5 * static_cast<double>(c.num_parameters) * std::log(frames);
    }
    const bool better = !best || c.score > best->score ||
                        (c.score == best->score && c.num_states < best->num_states);
    if (better) best = c;
    result.candidates.push_back(c);
  }
  result.num_states = best->num_states;
  return result;
}

}  // namespace

std::int64_t num_free_parameters(const Topology& topology) {
  validate(topology);
  const std::int64_t n = topology.num_states;
  std::int64_t count = topology.kind == Topology::Kind::left_right ? 0 : n - 1;
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  // Rows of the band sum to 1, together with leave where there are jumps; land sums to 1.
  for (int i = 0; i < topology.num_states; ++i)
    count += topology.end_next(i) - topology.first_next(i) - (jumps ? 0 : 1);
  return jumps ? count + n - 1 : count;
}

std::int64_t num_free_parameters(const DiscreteHmmOptions& options) {
  require(options.num_symbols >= 1, "num_symbols must be positive");
  const std::int64_t emission =
      static_cast<std::int64_t>(options.topology.num_states) * (options.num_symbols - 1);
  return (options.train_transitions ? num_free_parameters(options.topology) : 0) + emission;
}

std::int64_t num_free_parameters(const GaussianMixtureHmmOptions& options, int dim) {
  require(dim >= 1 && options.num_mixtures >= 1, "dim and num_mixtures must be positive");
  const std::int64_t gaussians =
      static_cast<std::int64_t>(options.topology.num_states) * options.num_mixtures;
  const std::int64_t weights = gaussians - options.topology.num_states;
  const std::int64_t variances = options.tied_variance ? dim : gaussians * dim;
  return (options.train_transitions ? num_free_parameters(options.topology) : 0) + weights +
         gaussians * dim + variances;
}

StateChoice choose_num_states(const std::vector<SymbolSequence>& sequences,
                              const DiscreteHmmOptions& options, Span<const int> candidates,
                              const StateChoiceOptions& choice) {
  return choose(sequences, options, candidates, choice);
}

StateChoice choose_num_states(const std::vector<MatrixF>& sequences,
                              const GaussianMixtureHmmOptions& options, Span<const int> candidates,
                              const StateChoiceOptions& choice) {
  return choose(sequences, options, candidates, choice);
}

}  // namespace hri
