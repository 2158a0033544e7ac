// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of PossibilisticHmmSet. With best_path sums over all paths give way to the best path
// (thesis eq. 4.22-4.28), so that what is expected becomes what is counted.
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/possibility/possibilistic_rule.hpp"

namespace hri {
namespace {

void check(const PossibilisticHmmOptions& options) {
  validate(options);
  require(options.num_symbols > 0, "PossibilisticHmmOptions.num_symbols must be set");
}

// Counts one step of a path. With jumps a step in the band may have been either; it is shared as
// the model has it.
void count_step(const MarkovChain& chain, int i, int j, detail::ChainCounts* counts) {
  const double all = chain.transition()(i, j);
  const double stepped = all > 0 ? chain.band()(i, j) / all : 1.0;
  counts->band(i, j) += stepped;
  counts->leave[i] += 1 - stepped;
  counts->land[j] += 1 - stepped;
}

// One imagined visit of every transition keeps rare ones possible.
void imagine_visits(const Topology& topology, detail::ChainCounts* counts) {
  const int n = topology.num_states;
  for (int i = 0; i < n; ++i) {
    for (int j = topology.first_next(i); j < topology.end_next(i); ++j) counts->band(i, j) += 1;
  }
  if (topology.kind != Topology::Kind::rank_one_plus_band) return;
  counts->leave.array() += 1;
  counts->land.array() += 1;
}

DiscreteHmm reestimate(const std::vector<SymbolSequence>& sequences, const DiscreteHmm& model,
                       const PossibilisticHmmOptions& options, double* log_likelihood) {
  const int n = model.num_states();
  detail::ChainCounts counts(n);
  MatrixD emitted = MatrixD::Constant(n, model.num_symbols(), 1e-9);
  std::vector<int> path;
  *log_likelihood = 0;
  for (const SymbolSequence& s : sequences) {
    poll(options.should_stop);
    *log_likelihood += model.viterbi(s, &path);
    if (path.empty()) continue;
    counts.start[path.front()] += 1;
    for (std::size_t t = 0; t < path.size(); ++t) {
      emitted(path[t], s[t]) += 1;
      if (t > 0) count_step(model.chain(), path[t - 1], path[t], &counts);
    }
  }
  imagine_visits(model.chain().topology(), &counts);
  MatrixD emission = model.emission();
  for (int j = 0; j < n; ++j) {
    if (emitted.row(j).sum() > 0.5) emission.row(j) = emitted.row(j) / emitted.row(j).sum();
    emission.row(j) = emission.row(j).cwiseMax(options.emission_floor);
    emission.row(j) /= emission.row(j).sum();
  }
  return {detail::estimate_chain(counts, model.chain()), emission};
}

DiscreteHmm train_class(const std::vector<SymbolSequence>& sequences,
                        const PossibilisticHmmOptions& options, TrainingReport* report) {
  DiscreteHmmOptions all_paths;
  all_paths.topology = options.topology;
  all_paths.num_symbols = options.num_symbols;
  all_paths.emission_floor = options.emission_floor;
  all_paths.max_iterations = options.max_iterations;
  all_paths.tolerance = options.tolerance;
  all_paths.seed = options.seed;
  all_paths.should_stop = options.should_stop;
  if (options.training == PossibilisticTraining::all_paths)
    return DiscreteHmm::train(sequences, all_paths, report);
  all_paths.max_iterations = 1;
  DiscreteHmm model = DiscreteHmm::train(sequences, all_paths);
  for (int iteration = 0; iteration < options.max_iterations && !report->converged; ++iteration) {
    double log_likelihood = 0;
    DiscreteHmm next = reestimate(sequences, model, options, &log_likelihood);
    const MarkovChain& before = model.chain();
    const double moved =
        std::max({(next.chain().start() - before.start()).cwiseAbs().maxCoeff(),
                  (next.chain().transition() - before.transition()).cwiseAbs().maxCoeff(),
                  (next.emission() - model.emission()).cwiseAbs().maxCoeff()});
    model = std::move(next);
    report->log_likelihoods.push_back(log_likelihood);
    report->converged = moved < options.tolerance;
  }
  return model;
}

}  // namespace

const char* PossibilisticHmmOptions::conflict() const {
  return emission_floor * num_symbols <= 1 ? nullptr
                                           : "emission_floor must not exceed 1 / num_symbols";
}

PossibilisticHmmSet PossibilisticHmmSet::train(
    const std::vector<std::vector<SymbolSequence>>& per_class,
    const PossibilisticHmmOptions& options, std::vector<TrainingReport>* reports) {
  check(options);
  require(!per_class.empty(), "training needs at least one class");
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    if (per_class[c].empty())
      fail(ErrorKind::invalid_argument, "class " + std::to_string(c) + " has no sequence");
    validate_symbols(per_class[c], options.num_symbols, "class " + std::to_string(c) + ", ");
  }
  std::vector<DiscreteHmm> models;
  models.reserve(per_class.size());
  std::vector<TrainingReport> local(per_class.size());
  for (std::size_t c = 0; c < per_class.size(); ++c)
    models.push_back(train_class(per_class[c], options, &local[c]));
  if (reports != nullptr) *reports = std::move(local);
  return PossibilisticHmmSet(std::move(models), options.rule);
}

PossibilisticHmmSet PossibilisticHmmSet::with_class(const std::vector<SymbolSequence>& sequences,
                                                    const PossibilisticHmmOptions& options) const {
  check(options);
  validate_symbols(sequences, options.num_symbols);
  TrainingReport report;
  return with_class(train_class(sequences, options, &report));
}

}  // namespace hri
