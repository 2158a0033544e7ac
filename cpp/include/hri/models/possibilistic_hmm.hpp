// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hidden Markov models in possibility theory (PTBHMM, thesis chapter 4), a set of classes trained
// and scaled together. The default differs from the thesis on purpose: its recursions
// (eq. 4.10-4.17) combine everything with max and score every class alike. Here phi'(j) = pi_j(o) *
// max_i phi(i) s_ij, with emissions scaled over all classes (eq. 5.14).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/discrete_hmm.hpp"
#include "hri/models/stop_check.hpp"
#include "hri/models/topology.hpp"

namespace hri {

/// How possibilities of states, transitions and emissions are joined.
enum class Conjunction : std::uint8_t {
  product,  ///< quantitative; in logs only additions and maxima
  min,      ///< qualitative (eq. 2.4)
  max,      ///< literal eq. 4.11; degenerate: kept to show that it tells no classes apart
};

struct PossibilisticHmmOptions {
  Topology topology;
  int num_symbols = 0;  ///< 1..65536
  Conjunction conjunction = Conjunction::product;
  bool conditioned = true;  ///< min: rescale phi to max 1 at every step, keep the log of the scale
  int max_iterations = 20;  ///< Viterbi re-estimations, 1..100000
  double tolerance = 1e-4;  ///< stop when no parameter moves more, >= 0
  double emission_floor = 1e-4;  ///< smallest emission share before scaling, 0..1 / num_symbols
  std::uint64_t seed = 0;        ///< of the start of models that are not left-right
  StopCheck should_stop;
};

/// Immutable; const calls are safe from several threads. Invariant: possibilities lie in 0..1, the
/// start and every row of transition have maximum 1, and so has every symbol's emission over all
/// classes and states.
class PossibilisticHmmSet {
 public:
  /// Trains every class on its own sequences by Viterbi re-estimation with counts (eq. 4.22-4.28
  /// with max for the sums), then scales the emissions over all classes. `per_class[c]` must not be
  /// empty.
  static PossibilisticHmmSet train(const std::vector<std::vector<SymbolSequence>>& per_class,
                                   const PossibilisticHmmOptions& options);

  /// The set that shares topology and parameters with trained classical models: rows of transition
  /// divided by their maximum, emissions scaled by eq. 5.14. All models have one topology and
  /// number of symbols.
  static PossibilisticHmmSet from_hmms(const std::vector<DiscreteHmm>& models,
                                       Conjunction conjunction, bool conditioned = true);

  /// log possibility of the symbols under each class, shape (num_classes,), natural log; -inf for
  /// impossible. Costs O(num_frames * num_states) a class for left_right and banded topologies, not
  /// O(num_states^2).
  [[nodiscard]] VectorF log_possibilities(Span<const std::int32_t> symbols) const;

  /// The most possible path of one class and its log possibility (product conjunction).
  double viterbi(int class_index, Span<const std::int32_t> symbols,
                 std::vector<int>* path = nullptr) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(transitions_.size()); }
  [[nodiscard]] int num_symbols() const { return num_symbols_; }
  [[nodiscard]] const Topology& topology() const { return topology_; }
  [[nodiscard]] Conjunction conjunction() const { return conjunction_; }
  /// Possibilities of one class: transition (num_states, num_states), emission (num_states,
  /// num_symbols).
  [[nodiscard]] const MatrixD& transition(int class_index) const;
  [[nodiscard]] const MatrixD& emission(int class_index) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static PossibilisticHmmSet read(const ModelFile& file, const std::string& prefix);

 private:
  PossibilisticHmmSet(Topology topology, Conjunction conjunction, bool conditioned,
                      std::vector<MatrixD> transitions, std::vector<MatrixD> emissions);

  Topology topology_;
  int num_symbols_ = 0;
  Conjunction conjunction_ = Conjunction::product;
  bool conditioned_ = true;
  std::vector<MatrixD> transitions_;
  std::vector<MatrixD> emissions_;
  // Float logs for scoring; emissions symbol by symbol, so that one frame reads one contiguous row.
  std::vector<MatrixF> log_transitions_;
  std::vector<MatrixF> log_emissions_;
};

}  // namespace hri
