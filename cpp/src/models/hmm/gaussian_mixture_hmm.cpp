// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "models/hmm/expectation.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/hmm/forward_pass.hpp"
#include "models/hmm/mixture_training.hpp"
#include "models/least_variance.hpp"

namespace hri {
namespace {

// A model that is trained on has its own number of Gaussians.
void check(const GaussianMixtureHmmOptions& o, int num_mixtures) {
  validate(o);
  require(o.weight_floor * num_mixtures <= 1, "weight_floor must not exceed 1 / num_mixtures");
}

// The state every frame starts in: equal parts for left-right models, clusters otherwise.
std::vector<std::vector<int>> first_states(const std::vector<MatrixF>& sequences,
                                           const GaussianMixtureHmmOptions& options) {
  if (options.topology.kind != Topology::Kind::left_right)
    return cluster_frames(sequences, options.topology.num_states, options.seed,
                          options.should_stop);
  std::vector<std::vector<int>> states;
  states.reserve(sequences.size());
  for (const MatrixF& s : sequences)
    states.push_back(detail::uniform_segmentation(s.rows(), options.topology.num_states));
  return states;
}

// A variance of zero (a constant feature) still needs a floor.
VectorD floor_of(const GlobalStatistics& global, double share) {
  return (global.variance * share)
      .cwiseMax(detail::least_variance(global.mean, global.variance, 1e-10));
}

// All variances replaced by their mean, so that training begins with one vector.
MixtureBank with_tied_variance(const MixtureBank& bank) {
  return {bank.weights(), bank.means(),
          bank.variances().colwise().mean().replicate(bank.means().rows(), 1)};
}

// Log densities in double in a buffer of the thread's own.
detail::Rows<double> log_densities(const MixtureBank& bank, ConstMatrixRefF frames) {
  require(frames.rows() > 0 && frames.cols() == bank.dim(),
          "frames must have at least one row and dim() columns");
  thread_local std::vector<double> buffer;
  const auto needed = static_cast<std::size_t>(frames.rows() * bank.num_states());
  if (buffer.size() < needed) buffer.resize(needed);
  bank.log_densities(frames, buffer.data());
  return {buffer.data(), bank.num_states(), frames.rows(), nullptr};
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

const char* GaussianMixtureHmmOptions::conflict() const {
  return weight_floor * num_mixtures <= 1 ? nullptr
                                          : "weight_floor must not exceed 1 / num_mixtures";
}

GaussianMixtureHmm::GaussianMixtureHmm(MarkovChain chain, MixtureBank bank)
    : chain_(std::move(chain)), bank_(std::move(bank)) {
  require(bank_.num_states() == chain_.num_states(),
          "the mixture bank must have one mixture a state");
}

GaussianMixtureHmm GaussianMixtureHmm::train(const std::vector<MatrixF>& sequences,
                                             const GaussianMixtureHmmOptions& options,
                                             TrainingReport* report) {
  check(options, options.num_mixtures);
  const GlobalStatistics global = global_statistics(sequences);
  const VectorD floor = floor_of(global, options.variance_floor);
  const int n = options.topology.num_states;
  return GaussianMixtureHmm(MarkovChain::initial(options.topology),
                            detail::initial_bank(sequences, first_states(sequences, options), n,
                                                 options.num_mixtures, floor, options.seed, global))
      .retrain(sequences, options, report);
}

GaussianMixtureHmm GaussianMixtureHmm::retrain(const std::vector<MatrixF>& sequences,
                                               const GaussianMixtureHmmOptions& options,
                                               TrainingReport* report) const {
  check(options, bank_.num_mixtures());
  const GlobalStatistics global = global_statistics(sequences);
  if (global.variance.size() != dim()) {
    fail(ErrorKind::invalid_argument, "sequences have " + std::to_string(global.variance.size()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  const BankEstimation estimation{floor_of(global, options.variance_floor), options.weight_floor,
                                  options.weight_prior, options.tied_variance};
  const int n = num_states();
  GaussianMixtureHmm model = *this;
  if (options.tied_variance) model = GaussianMixtureHmm(chain_, with_tied_variance(bank_));
  double num_frames = 0;
  for (const MatrixF& s : sequences) num_frames += static_cast<double>(s.rows());

  TrainingReport local;
  for (int iteration = 0; iteration < options.max_iterations && !local.converged; ++iteration) {
    detail::ChainCounts counts(n);
    MixtureAccumulator accumulator(n, bank_.num_mixtures(), dim());
    const double total =
        detail::add_expectations(model, sequences, options.should_stop, &counts, &accumulator);
    if (!local.log_likelihoods.empty()) {
      local.converged = (total - local.log_likelihoods.back()) / num_frames < options.tolerance;
    }
    local.log_likelihoods.push_back(total);
    detail::add_pseudo_counts(model.chain_, options.transition_prior, &counts);
    model = GaussianMixtureHmm(
        options.train_transitions ? detail::estimate_chain(counts, model.chain_) : model.chain_,
        accumulator.estimate(model.bank_, estimation));
  }
  if (report != nullptr) *report = std::move(local);
  return model;
}

MatrixD GaussianMixtureHmm::posterior(ConstMatrixRefF frames) const {
  MatrixD result;
  require(std::isfinite(state_posteriors(frames, &result)),
          "frames are impossible under the model");
  return result;
}

double GaussianMixtureHmm::state_posteriors(ConstMatrixRefF frames, MatrixD* posteriors) const {
  const detail::Rows<double> log_b = log_densities(bank_, frames);
  posteriors->resize(frames.rows(), num_states());
  return detail::forward_backward(chain_, log_b, posteriors->data(), num_states(), nullptr);
}

ForwardBackward GaussianMixtureHmm::forward_backward(ConstMatrixRefF frames) const {
  return detail::both_ways(chain_, log_densities(bank_, frames));
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

// The room for log densities is in the pass.
void GaussianMixtureHmm::begin(detail::ForwardPass* pass) const {
  pass->reset(chain_, detail::ForwardPass::Arithmetic::logs);
}

void GaussianMixtureHmm::advance(detail::ForwardPass* pass, Span<const float> frame) const {
  const Eigen::Map<const MatrixF> row(frame.data(), 1, static_cast<Eigen::Index>(frame.size()));
  const Eigen::Map<MatrixF> log_b(pass->log_densities(), 1, num_states());
  bank_.log_densities(row, log_b);
  pass->step(chain_, nullptr, pass->log_densities());
}

double GaussianMixtureHmm::log_likelihood_exact(ConstMatrixRefF frames) const {
  return forward(chain_, log_densities(bank_, frames));
}

double GaussianMixtureHmm::viterbi(ConstMatrixRefF frames, std::vector<int>* path) const {
  return detail::viterbi(chain_, log_densities(bank_, frames), path);
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
