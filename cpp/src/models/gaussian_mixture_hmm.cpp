// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/gaussian_mixture_hmm.hpp"

#include <cmath>
#include <utility>

#include "forward_backward.hpp"
#include "forward_pass.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

void check(const GaussianMixtureHmmOptions& o) {
  validate(o.topology);
  require(o.num_mixtures >= 1 && o.num_mixtures <= 1024, "num_mixtures must lie in 1..1024");
  require(o.max_iterations >= 1 && o.max_iterations <= 100000,
          "max_iterations must lie in 1..100000");
  require(o.tolerance >= 0, "tolerance must not be negative");
  require(o.variance_floor > 0, "variance_floor must be positive");
  require(o.weight_floor >= 0 && o.weight_floor * o.num_mixtures <= 1,
          "weight_floor must lie in 0..1/num_mixtures");
}

// The state every frame starts in: equal parts for left-right models, at random otherwise.
std::vector<std::vector<int>> first_states(const std::vector<MatrixF>& sequences,
                                           const Topology& topology, std::uint64_t seed) {
  std::vector<std::vector<int>> states;
  Random random(seed);
  for (const MatrixF& s : sequences) {
    states.push_back(detail::uniform_segmentation(s.rows(), topology.num_states));
    if (topology.kind == Topology::Kind::left_right) continue;
    for (int& state : states.back()) {
      state = static_cast<int>(random.below(static_cast<std::uint64_t>(topology.num_states)));
    }
  }
  return states;
}

// A variance of zero (a constant feature) still needs a floor.
VectorD floor_of(const VectorD& global_variance, double share) {
  return (global_variance * share).cwiseMax(1e-10);
}

// Gaussians differ by more than probabilities can, so that the pass is in logs.
template <class Scalar>
double forward(const MarkovChain& chain, const detail::Rows<Scalar>& log_b) {
  thread_local detail::ForwardPass pass;
  pass.reset(chain, detail::ForwardPass::Arithmetic::logs);
  for (std::ptrdiff_t t = 0; t < log_b.num_frames; ++t) pass.step(chain, nullptr, log_b[t]);
  return pass.log_likelihood();
}

}  // namespace

GaussianMixtureHmm::GaussianMixtureHmm(MarkovChain chain, MixtureBank bank)
    : chain_(std::move(chain)), bank_(std::move(bank)) {
  require(bank_.num_states() == chain_.num_states(),
          "the mixture bank must have one mixture a state");
}

GaussianMixtureHmm GaussianMixtureHmm::train(const std::vector<MatrixF>& sequences,
                                             const GaussianMixtureHmmOptions& options,
                                             TrainingReport* report) {
  check(options);
  const GlobalStatistics global = global_statistics(sequences);
  const VectorD floor = floor_of(global.variance, options.variance_floor);
  const int n = options.topology.num_states;
  GaussianMixtureHmm model(
      MarkovChain::initial(options.topology),
      initial_bank(sequences, first_states(sequences, options.topology, options.seed), n,
                   options.num_mixtures, floor, options.seed));
  double num_frames = 0;
  for (const MatrixF& s : sequences) num_frames += static_cast<double>(s.rows());

  TrainingReport local;
  MatrixD densities;
  MatrixD components;
  MatrixD gamma;
  for (int iteration = 0; iteration < options.max_iterations && !local.converged; ++iteration) {
    detail::ChainCounts counts(n);
    MixtureAccumulator accumulator(n, options.num_mixtures, model.dim());
    double total = 0;
    for (const MatrixF& s : sequences) {
      poll(options.should_stop);
      model.bank_.log_densities(s, &densities, &components);
      gamma.resize(s.rows(), n);
      total += detail::forward_backward(model.chain_, detail::rows_of(densities), &gamma, &counts);
      accumulator.add(s, gamma, components, densities);
    }
    if (!local.log_likelihoods.empty()) {
      local.converged = (total - local.log_likelihoods.back()) / num_frames < options.tolerance;
    }
    local.log_likelihoods.push_back(total);
    model = GaussianMixtureHmm(detail::estimate_chain(counts, model.chain_),
                               accumulator.estimate(model.bank_, floor, options.weight_floor));
  }
  if (report != nullptr) *report = std::move(local);
  return model;
}

double GaussianMixtureHmm::log_likelihood(ConstMatrixRefF frames) const {
  require(frames.rows() > 0, "frames must have at least one row");
  thread_local std::vector<float> buffer;
  const auto needed = static_cast<std::size_t>(frames.rows() * num_states());
  if (buffer.size() < needed) buffer.resize(needed);
  const Eigen::Map<MatrixF> log_b(buffer.data(), frames.rows(), num_states());
  bank_.log_densities(frames, log_b);
  return forward(chain_, detail::Rows<float>{log_b.data(), num_states(), frames.rows(), nullptr});
}

double GaussianMixtureHmm::log_likelihood_exact(ConstMatrixRefF frames) const {
  require(frames.rows() > 0 && frames.cols() == dim(),
          "frames must have at least one row and dim() columns");
  MatrixD log_b;
  bank_.log_densities(frames, &log_b, nullptr);
  return forward(chain_, detail::rows_of(log_b));
}

double GaussianMixtureHmm::viterbi(ConstMatrixRefF frames, std::vector<int>* path) const {
  require(frames.rows() > 0 && frames.cols() == dim(),
          "frames must have at least one row and dim() columns");
  MatrixD log_b;
  bank_.log_densities(frames, &log_b, nullptr);
  return detail::viterbi(chain_, detail::rows_of(log_b), path);
}

void GaussianMixtureHmm::write(ModelFile& file, const std::string& prefix) const {
  chain_.write(file, prefix);
  bank_.write(file, prefix);
}

GaussianMixtureHmm GaussianMixtureHmm::read(const ModelFile& file, const std::string& prefix) {
  MarkovChain chain = MarkovChain::read(file, prefix);
  MixtureBank bank = MixtureBank::read(file, prefix);
  if (bank.num_states() != chain.num_states()) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' needs one row a state");
  }
  return {std::move(chain), std::move(bank)};
}

}  // namespace hri
