// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Forward and backward recursion over models one behind the other (HTK Book, section 8.8), in logs.
// Entries and exits of models take no frame: they are passed at the points between frames, of which
// point t lies before frame t.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "hri/core/types.hpp"

namespace hri::htk::detail {

/// The transitions of a model in natural logs, those that there are. Emitting states count from 0.
struct LogChain {
  struct Step {
    int state = 0;
    double log_weight = 0;
  };

  /// Of a matrix with entry and exit state.
  explicit LogChain(const MatrixD& transitions);

  [[nodiscard]] int num_states() const { return static_cast<int>(exit.size()); }

  std::vector<double> start;  ///< from the entry
  std::vector<double> exit;
  std::vector<std::vector<Step>> next;
  std::vector<std::vector<Step>> previous;
  double skip = 0;     ///< from the entry to the exit
  int min_frames = 0;  ///< on the shortest way from the entry to the exit; kNoWay: there is none

  static constexpr int kNoWay = std::numeric_limits<int>::max();
};

/// Keeps its memory from one utterance to the next. Not for several threads.
class CompositePass {
 public:
  /// Writes log densities of the states first..end - 1 at a frame.
  using Densities = std::function<void(std::int64_t frame, int first, int end, double* out)>;
  /// Takes the probabilities of these states at a frame, given all frames.
  using Posteriors = std::function<void(std::int64_t frame, int first, int end, const double*)>;

  /// The models of the next utterance; they outlive the passes. Gives the number of frames that
  /// they take at least.
  std::int64_t begin(const std::vector<const LogChain*>& units);

  /// The log probability of all frames; -inf where no path leads through them. At a frame, states
  /// whose backward score is more than `beam` below the best are left out; 0: none is.
  double backward(std::int64_t num_frames, double beam, const Densities& densities);

  /// After a backward pass that gave a finite value: expected counts of transitions are added to
  /// `counts`, a matrix with entry and exit for every unit.
  void forward(const std::vector<MatrixD*>& counts, const Posteriors& posteriors);

 private:
  // States first..end - 1 are active at a frame; their values begin at `offset`.
  struct Row {
    std::size_t offset = 0;
    int first = 0;
    int end = 0;
    [[nodiscard]] bool has(int state) const { return state >= first && state < end; }
    [[nodiscard]] std::size_t at(int state) const {
      return offset + static_cast<std::size_t>(state - first);
    }
  };

  [[nodiscard]] int num_units() const { return static_cast<int>(units_.size()); }
  [[nodiscard]] int unit_of(int state) const { return unit_of_[static_cast<std::size_t>(state)]; }
  [[nodiscard]] int first_of(int unit) const { return first_[static_cast<std::size_t>(unit)]; }
  void enter(std::int64_t point);
  bool add_row(std::int64_t frame, double beam);
  double backward_score(int state, const Row& later) const;
  void leave(std::int64_t point, const Row& before, const std::vector<MatrixD*>& counts);
  void advance(std::int64_t frame, const Row& before, const std::vector<MatrixD*>& counts);

  std::vector<const LogChain*> units_;
  std::vector<int> first_;    // state of every unit, and their end
  std::vector<int> unit_of_;  // of every state
  std::vector<Row> rows_;     // by frame
  std::vector<double> beta_;  // of all rows
  std::vector<double> log_b_;
  std::vector<double> enter_;    // backward scores at the entries of units, and at the end
  std::vector<double> reached_;  // forward scores there
  std::vector<double> alpha_;    // of the frame before, by state
  std::vector<double> next_alpha_;
  std::vector<double> gamma_;
  double log_probability_ = 0;
};

}  // namespace hri::htk::detail
