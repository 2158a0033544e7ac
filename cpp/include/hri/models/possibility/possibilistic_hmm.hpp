// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hidden Markov models in possibility theory (PTBHMM, thesis chapter 4), a set of classes trained
// and scaled together. The default differs from the thesis on purpose: its recursions
// (eq. 4.10-4.17) combine everything with max and score every class alike. Here phi'(j) = pi_j(o) *
// max_i phi(i) s_ij, with emissions scaled over all classes (eq. 5.14). See docs/ptbhmm.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/topology.hpp"
#include "hri/models/possibility/possibility.hpp"
#include "hri/models/possibility/state_possibilities.hpp"

namespace hri {

namespace detail {
struct PossibilityTables;
}

/// How possibilities of states, transitions and emissions are joined.
enum class Conjunction : std::uint8_t {
  product,  ///< quantitative; in logs only additions and maxima
  min,      ///< qualitative (eq. 2.4)
  max,      ///< literal eq. 4.11; degenerate: kept to show that it separates no classes
};
constexpr auto enum_names(Conjunction) { return std::array{"product", "min", "max"}; }

/// How a set is scored.
struct PossibilisticRule {
  Conjunction conjunction = Conjunction::product;
  /// min: possibilities are conditioned on every frame. Its best state in the class becomes fully
  /// possible, before the symbol is joined and after, and what that takes goes into the score.
  bool conditioned = true;
  /// min alone is idempotent: a state contradicted ten times would be as alive as one contradicted
  /// once, and the order of symbols would be forgotten.
  double concentration = 1.5;

  static constexpr const char* kName = "PossibilisticRule";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("conjunction", o.conjunction, any_value, "how possibilities are joined");
    v("conditioned", o.conditioned, any_value,
      "with min: possibilities are conditioned on every frame");
    v("concentration", o.concentration, within(1, 16),
      "with min, conditioned: power that what a state holds is raised to at a symbol that speaks "
      "against it; 1: off");
  }
};

/// How the models of a set are trained before they are scaled.
enum class PossibilisticTraining : std::uint8_t {
  all_paths,  ///< Baum-Welch
  best_path,  ///< counts along the best path, eq. 4.22-4.28 with max for the sums
};
constexpr auto enum_names(PossibilisticTraining) { return std::array{"all_paths", "best_path"}; }

struct HRI_API PossibilisticHmmOptions {
  Topology topology;
  int num_symbols = 0;
  PossibilisticRule rule;
  PossibilisticTraining training = PossibilisticTraining::all_paths;
  int max_iterations = 20;
  double tolerance = 1e-4;
  double emission_floor = 1e-4;
  std::uint64_t seed = 0;
  StopCheck should_stop;

  static constexpr const char* kName = "PossibilisticHmmOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("topology", o.topology, any_value, "which transitions exist");
    v("num_symbols", o.num_symbols, within(0, 65536),
      "size of the alphabet; 0: not set, which training refuses");
    v("rule", o.rule, any_value, "how the set is scored");
    v("training", o.training, any_value, "how the models are trained before they are scaled");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations of the training at most");
    v("tolerance", o.tolerance, within(0, 1e6),
      "all_paths: training stops when the log-likelihood a symbol gains less; best_path: when no "
      "parameter moves more");
    v("emission_floor", o.emission_floor, within(0, 1),
      "smallest emission share before scaling, at most 1 / num_symbols; best_path: smaller ones "
      "are raised to it before those of a state are scaled to sum to 1, and may lie a little "
      "below");
    v("seed", o.seed, any_seed, "of the start of models that are not left-right");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads. Invariant: possibilities lie in 0..1, and
/// of starts, of transitions, and of the emissions of every symbol the largest over all classes and
/// states is 1 (eq. 5.14).
class HRI_API PossibilisticHmmSet {
 public:
  /// The set of trained models, scaled together by eq. 5.14. Throws InvalidArgument unless all
  /// models have one topology and number of symbols.
  explicit PossibilisticHmmSet(std::vector<DiscreteHmm> models, const PossibilisticRule& rule = {});

  /// Trains every class on its own sequences. `per_class[c]` must not be empty. `reports`, if
  /// wanted, gets one entry a class: the log-likelihoods before each re-estimation.
  static PossibilisticHmmSet train(const std::vector<std::vector<SymbolSequence>>& per_class,
                                   const PossibilisticHmmOptions& options,
                                   std::vector<TrainingReport>* reports = nullptr);

  /// The set with one class more, which comes last: emissions are scaled anew, no other class is
  /// trained again.
  [[nodiscard]] PossibilisticHmmSet with_class(DiscreteHmm model) const;
  /// The same with a class that is trained here, as `train` does, on `options` of this topology.
  [[nodiscard]] PossibilisticHmmSet with_class(const std::vector<SymbolSequence>& sequences,
                                               const PossibilisticHmmOptions& options) const;

  /// log possibility of the symbols under each class, shape (num_classes,), natural log; -inf for
  /// impossible. Costs O(num_frames * num_states) a class, but for ergodic topologies
  /// O(num_frames * num_states^2). Throws InvalidArgument for unknown symbols.
  [[nodiscard]] VectorF log_possibilities(Span<const std::int32_t> symbols) const;
  /// The same into the caller's buffer (num_classes), without allocating.
  void log_possibilities(Span<const std::int32_t> symbols, Span<float> out) const;
  /// The same in double, to compare with other implementations.
  [[nodiscard]] VectorD log_possibilities_exact(Span<const std::int32_t> symbols) const;

  /// Possibility and necessity of each class given the symbols (eq. 5.14-5.15).
  [[nodiscard]] Possibilities classify(Span<const std::int32_t> symbols) const;

  /// The most possible path of one class and its log possibility; empty where it is impossible.
  /// Throws InvalidArgument for another class, unknown symbols or none.
  double viterbi(int class_index, Span<const std::int32_t> symbols,
                 std::vector<int>* path = nullptr) const;

  /// Possibility and necessity of every state of one class at every frame given all symbols
  /// (eq. 4.23), with the forward and backward possibilities they come from (eq. 4.10-4.17), in
  /// double. With product O(num_frames * num_states), but for ergodic topologies. Throws
  /// InvalidArgument as viterbi() does, and for a conditioned minimum unless concentration is 1.
  [[nodiscard]] StatePossibilities state_possibilities(int class_index,
                                                       Span<const std::int32_t> symbols) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(models_.size()); }
  [[nodiscard]] int num_states() const { return models_.front().num_states(); }
  [[nodiscard]] int num_symbols() const { return models_.front().num_symbols(); }
  [[nodiscard]] const Topology& topology() const { return models_.front().chain().topology(); }
  [[nodiscard]] const PossibilisticRule& rule() const { return rule_; }
  /// The models before scaling.
  [[nodiscard]] const std::vector<DiscreteHmm>& models() const { return models_; }
  /// Possibilities of one class: start (num_states), transition (num_states, num_states), emission
  /// (num_states, num_symbols).
  [[nodiscard]] VectorD start(int class_index) const;
  [[nodiscard]] MatrixD transition(int class_index) const;
  [[nodiscard]] MatrixD emission(int class_index) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static PossibilisticHmmSet read(const ModelFile& file, const std::string& prefix);

 private:
  friend class PossibilisticHmmStream;
  friend class FixedPointHmmSet;
  void check_class(int class_index) const;
  [[nodiscard]] MatrixD log_emissions(int class_index, Span<const std::int32_t> symbols) const;

  std::vector<DiscreteHmm> models_;
  PossibilisticRule rule_;
  VectorD largest_;  // emission of every symbol, over all classes and states
  std::shared_ptr<const detail::PossibilityTables> tables_;  // immutable
};

}  // namespace hri
