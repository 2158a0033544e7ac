// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hidden part of every sequence model: start and transition probabilities in the structure of
// their topology. The recursions of forward, backward and Viterbi are built from the three steps
// below, whose cost is that of the structure: N^2 for ergodic, N for all others.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/padded_matrix.hpp"
#include "hri/models/hmm/topology.hpp"

namespace hri {

namespace detail {
/// What a step of the forward recursion left behind.
struct Spread {
  double sum;
  double smallest;  ///< of the values above 0; +inf where there is none
};

/// Rows of MarkovChain::by_one(): of state j the probability to stay, of the step into it and of
/// the step from it, 0 where there is none, and their logs.
enum ByOne : std::uint8_t { kGoInto, kStay, kGoFrom, kLogGoInto, kLogStay, kLogGoFrom, kNumByOne };
using ByOneRows = std::array<const double*, kNumByOne>;
}  // namespace detail

/// Immutable; const calls are safe from several threads. Invariant: start and every row of
/// transition() sum to 1, and transitions outside the topology are 0.
class HRI_API MarkovChain {
 public:
  /// left_right, banded or ergodic: `transition` has shape (num_states, num_states). Throws
  /// InvalidArgument for what is no distribution or does not fit the topology.
  MarkovChain(const Topology& topology, VectorD start, MatrixD transition);

  /// rank_one_plus_band: a_ij = band(i, j) + leave[i] land[j], so that band row i and leave[i] sum
  /// to 1, and so does land. From i the chain either takes a step of the band, or leaves, and lands
  /// in j whatever i was.
  MarkovChain(const Topology& topology, VectorD start, MatrixD band, VectorD leave, VectorD land);

  /// The values that training starts from.
  static MarkovChain initial(const Topology& topology);

  [[nodiscard]] const Topology& topology() const { return topology_; }
  [[nodiscard]] int num_states() const { return topology_.num_states; }
  [[nodiscard]] const VectorD& start() const { return start_; }
  /// All of a_ij, shape (num_states, num_states).
  [[nodiscard]] const MatrixD& transition() const { return transition_; }
  /// The band alone; equal to transition() but for rank_one_plus_band.
  [[nodiscard]] const MatrixD& band() const { return jumps() ? band_ : transition_; }
  /// Empty but for rank_one_plus_band.
  [[nodiscard]] const VectorD& leave() const { return leave_; }
  [[nodiscard]] const VectorD& land() const { return land_; }
  [[nodiscard]] bool jumps() const { return topology_.kind == Topology::Kind::rank_one_plus_band; }

  [[nodiscard]] const VectorD& log_start() const { return log_start_; }

  /// y[j] = sum over i of x[i] a_ij. x and y hold num_states values and do not overlap.
  void propagate(const double* x, double* y) const;
  /// propagate(), then y[j] *= b[j]; all hold num_states values and 0 up to the next multiple of 8.
  detail::Spread propagate(const double* x, const double* b, double* y) const;
  /// y[i] = sum over j of a_ij x[j].
  void propagate_back(const double* x, double* y) const;
  /// y[j] = max over i of x[i] + log a_ij.
  void propagate_max(const double* x, double* y) const;
  /// y[i] = max over j of log a_ij + x[j].
  void propagate_max_back(const double* x, double* y) const;
  /// The lowest i for which x[i] + log a_ij is largest. `best_leaver` is what best_leaver(x) gave.
  [[nodiscard]] int best_previous(const double* x, int j, int best_leaver) const;
  [[nodiscard]] int best_previous(const double* x, int j) const;
  /// The lowest i for which x[i] + log leave[i] is largest: where jumps come from. 0 unless
  /// jumps().
  [[nodiscard]] int best_leaver(const double* x) const;
  /// The smallest probability above 0 of a start, a step of the band or a jump.
  [[nodiscard]] double smallest_probability() const;

  /// Of a left-right chain without skips: rows of probabilities, padded, in the order of
  /// detail::ByOne; nullptr for others.
  [[nodiscard]] detail::ByOneRows by_one() const;

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError naming the field.
  static MarkovChain read(const ModelFile& file, const std::string& prefix);

 private:
  void tabulate();
  [[nodiscard]] bool dense() const { return topology_.kind == Topology::Kind::ergodic; }

  Topology topology_;
  VectorD start_;
  MatrixD transition_;
  MatrixD band_;  // empty unless jumps()
  VectorD leave_;
  VectorD land_;
  VectorD log_start_;
  VectorD log_leave_;
  VectorD log_land_;
  // ergodic: the matrix and its transpose, and the same of logs.
  detail::PaddedMatrix forward_;
  detail::PaddedMatrix back_;
  detail::PaddedMatrix log_forward_;
  detail::PaddedMatrix log_back_;
  // All others: row d holds the steps from i to i + d - lowest_step_.
  int lowest_step_ = 0;
  detail::PaddedMatrix steps_;
  detail::PaddedMatrix log_steps_;
  detail::PaddedMatrix by_one_;  // left-right without skips: rows of detail::ByOne
};

}  // namespace hri
