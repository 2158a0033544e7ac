// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hidden Markov model over discrete symbols (Rabiner, Proc. IEEE 77(2), 1989), Baum-Welch over many
// sequences.
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
#include "hri/models/hmm/training_report.hpp"

namespace hri {

namespace detail {
struct ChainCounts;
class ForwardPass;
}  // namespace detail

template <class Model>
class HmmStream;

using SymbolSequence = std::vector<std::int32_t>;

struct HRI_API DiscreteHmmOptions {
  Topology topology;
  int num_symbols = 0;
  int max_iterations = 20;
  double tolerance = 1e-4;
  double emission_floor = 1e-4;
  double transition_prior = 0;
  double emission_prior = 0;
  bool train_transitions = true;
  std::uint64_t seed = 0;
  StopCheck should_stop;  ///< polled before every sequence of every iteration

  static constexpr const char* kName = "DiscreteHmmOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("topology", o.topology, any_value, "which transitions exist");
    v("num_symbols", o.num_symbols, within(0, 65536),
      "size of the alphabet; 0: not set, which training refuses");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations of Baum-Welch at most");
    v("tolerance", o.tolerance, within(0, 1e6),
      "training stops when the log-likelihood a symbol gains less");
    v("emission_floor", o.emission_floor, within(0, 1),
      "smallest emission probability, at most 1 / num_symbols");
    v("transition_prior", o.transition_prior, within(0, 1e12),
      "Dirichlet prior: imagined counts of every transition (and start) that the topology has");
    v("emission_prior", o.emission_prior, within(0, 1e12),
      "Dirichlet prior: imagined counts of every symbol in every state");
    v("train_transitions", o.train_transitions, any_value,
      "False: start and transitions stay as they began");
    v("seed", o.seed, any_seed, "of the start of models that are not left-right");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads. Invariant: the rows of emission sum to 1.
class HRI_API DiscreteHmm {
 public:
  /// `emission` has shape (num_states, num_symbols). Throws InvalidArgument for what is no
  /// distribution.
  DiscreteHmm(MarkovChain chain, MatrixD emission);

  /// Throws InvalidArgument for no sequence, an empty one, or a symbol outside 0..num_symbols - 1
  /// (names it).
  static DiscreteHmm train(const std::vector<SymbolSequence>& sequences,
                           const DiscreteHmmOptions& options, TrainingReport* report = nullptr);

  /// Baum-Welch that goes on from this model. The topology, num_symbols and seed of the options are
  /// not read. Throws as train() does.
  [[nodiscard]] DiscreteHmm retrain(const std::vector<SymbolSequence>& sequences,
                                    const DiscreteHmmOptions& options,
                                    TrainingReport* report = nullptr) const;

  /// log P(symbols | model), natural log; -inf for an impossible sequence. Throws InvalidArgument
  /// for unknown symbols. Allocates nothing once the thread has scored a model as large.
  [[nodiscard]] double log_likelihood(Span<const std::int32_t> symbols) const;
  /// The same in logs from the first symbol on: slow, to compare with.
  [[nodiscard]] double log_likelihood_exact(Span<const std::int32_t> symbols) const;
  /// log P(symbols, best path | model); the path if wanted (empty where the sequence is
  /// impossible).
  double viterbi(Span<const std::int32_t> symbols, std::vector<int>* path = nullptr) const;

  /// P(state of frame t | all symbols), shape (num_frames, num_states). Throws InvalidArgument
  /// where the sequence is impossible.
  [[nodiscard]] MatrixD posterior(Span<const std::int32_t> symbols) const;
  /// log P(symbols | model), and the posterior as above into `posteriors`, which is resized: all 0
  /// where the sequence is impossible.
  double state_posteriors(Span<const std::int32_t> symbols, MatrixD* posteriors) const;
  /// Forward and backward log probabilities of the states, frame by frame. Throws InvalidArgument
  /// for unknown symbols or none.
  [[nodiscard]] ForwardBackward forward_backward(Span<const std::int32_t> symbols) const;

  [[nodiscard]] const MarkovChain& chain() const { return chain_; }
  [[nodiscard]] int num_states() const { return chain_.num_states(); }
  [[nodiscard]] int num_symbols() const { return static_cast<int>(emission_.cols()); }
  [[nodiscard]] const MatrixD& emission() const { return emission_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static DiscreteHmm read(const ModelFile& file, const std::string& prefix);

 private:
  friend class HmmStream<DiscreteHmm>;

  // The forward recursion, frame by frame.
  void begin(detail::ForwardPass* pass) const;
  void advance(detail::ForwardPass* pass, std::int32_t symbol) const;

  void validate_symbol(std::int32_t symbol, std::size_t position) const;
  void validate_all(Span<const std::int32_t> symbols) const;
  double expect(Span<const std::int32_t> symbols, detail::PaddedMatrix* gamma,
                detail::ChainCounts* counts) const;

  MarkovChain chain_;
  MatrixD emission_;
  // One row a symbol, so that a frame reads one piece of memory.
  detail::PaddedMatrix by_symbol_;
  detail::PaddedMatrix log_by_symbol_;
  double smallest_step_ = 0;  // product above 0 of a transition and an emission
};

/// Throws InvalidArgument unless every sequence has symbols, all in 0..num_symbols - 1. `where`
/// begins the message.
HRI_API void validate_symbols(const std::vector<SymbolSequence>& sequences, int num_symbols,
                              const std::string& where = "");

}  // namespace hri
