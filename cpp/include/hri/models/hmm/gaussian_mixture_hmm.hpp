// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hidden Markov model with Gaussian-mixture emissions of diagonal covariance (Rabiner, Proc. IEEE
// 77(2), 1989). Trained by Baum-Welch over many sequences in double; emissions are scored in float.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/forward_backward.hpp"
#include "hri/models/hmm/markov_chain.hpp"
#include "hri/models/hmm/mixture_bank.hpp"
#include "hri/models/hmm/training_report.hpp"

namespace hri {

namespace detail {
class ForwardPass;
}

template <class Model>
class HmmStream;

struct HRI_API GaussianMixtureHmmOptions {
  Topology topology;
  int num_mixtures = 1;
  int max_iterations = 20;
  double tolerance = 1e-4;
  double variance_floor = 0.01;
  double weight_floor = 1e-3;
  bool tied_variance = false;
  double transition_prior = 0;
  double weight_prior = 0;
  bool train_transitions = true;
  std::uint64_t seed = 0;
  StopCheck should_stop;  ///< polled before every sequence of every iteration

  static constexpr const char* kName = "GaussianMixtureHmmOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("topology", o.topology, any_value, "which transitions exist");
    v("num_mixtures", o.num_mixtures, within(1, 1024), "Gaussians a state");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations of Baum-Welch at most");
    v("tolerance", o.tolerance, within(0, 1e6),
      "training stops when the log-likelihood a frame gains less");
    v("variance_floor", o.variance_floor, above(0, 1e6), "share of the global variance");
    v("weight_floor", o.weight_floor, within(0, 1),
      "smaller mixture weights are raised to it, at most 1 / num_mixtures, before all are scaled "
      "to sum to 1: then they may lie a little below");
    v("tied_variance", o.tied_variance, any_value,
      "one vector of variances for all Gaussians of all states");
    v("transition_prior", o.transition_prior, within(0, 1e12),
      "Dirichlet prior: imagined counts of every transition (and start) that the topology has");
    v("weight_prior", o.weight_prior, within(0, 1e12),
      "Dirichlet prior: imagined counts of every Gaussian of a state's mixture");
    v("train_transitions", o.train_transitions, any_value,
      "False: start and transitions stay as they began");
    v("seed", o.seed, any_seed, "of the starts by k-means");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads. Invariant: the bank has one mixture a
/// state.
class HRI_API GaussianMixtureHmm {
 public:
  /// Throws InvalidArgument for a bank that does not fit the chain.
  GaussianMixtureHmm(MarkovChain chain, MixtureBank bank);

  /// Trains on sequences of frames (rows), each with at least one frame. Starts from uniform
  /// segmentation for left_right (sequences shorter than the number of states skip some), seeded
  /// k-means otherwise. States never visited keep their parameters. Throws InvalidArgument for no
  /// data or values not finite (names sequence, row, column).
  static GaussianMixtureHmm train(const std::vector<MatrixF>& sequences,
                                  const GaussianMixtureHmmOptions& options,
                                  TrainingReport* report = nullptr);

  /// Baum-Welch that goes on from this model. The topology, num_mixtures and seed of the options
  /// are not read. Throws as train() does.
  [[nodiscard]] GaussianMixtureHmm retrain(const std::vector<MatrixF>& sequences,
                                           const GaussianMixtureHmmOptions& options,
                                           TrainingReport* report = nullptr) const;

  /// log P(frames | model) by the forward recursion, natural log; -inf for an impossible sequence.
  /// Allocates nothing once the thread has scored a sequence as long and a model as large.
  [[nodiscard]] double log_likelihood(ConstMatrixRefF frames) const;
  /// The same with emissions in double, to compare with other implementations.
  [[nodiscard]] double log_likelihood_exact(ConstMatrixRefF frames) const;
  /// log P(frames, best path | model); the path (num_frames states) if wanted.
  double viterbi(ConstMatrixRefF frames, std::vector<int>* path = nullptr) const;
  /// P(state of frame t | all frames), shape (num_frames, num_states), emissions in double. Throws
  /// InvalidArgument where the sequence is impossible.
  [[nodiscard]] MatrixD posterior(ConstMatrixRefF frames) const;
  /// log P(frames | model), emissions in double, and the posterior as above into `posteriors`,
  /// which is resized: all 0 where the sequence is impossible.
  double state_posteriors(ConstMatrixRefF frames, MatrixD* posteriors) const;
  /// Forward and backward log probabilities of the states, frame by frame, emissions in double.
  /// Throws InvalidArgument for no frames, another dimension or values that are not finite.
  [[nodiscard]] ForwardBackward forward_backward(ConstMatrixRefF frames) const;

  [[nodiscard]] int num_states() const { return bank_.num_states(); }
  [[nodiscard]] int dim() const { return bank_.dim(); }
  [[nodiscard]] const MarkovChain& chain() const { return chain_; }
  [[nodiscard]] const MixtureBank& bank() const { return bank_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static GaussianMixtureHmm read(const ModelFile& file, const std::string& prefix);

 private:
  friend class HmmStream<GaussianMixtureHmm>;

  // The forward recursion, frame by frame.
  void begin(detail::ForwardPass* pass) const;
  void advance(detail::ForwardPass* pass, Span<const float> frame) const;

  MarkovChain chain_;
  MixtureBank bank_;
};

}  // namespace hri
