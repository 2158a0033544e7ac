// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Which transitions a sequence model has. Structural zeros stay zero through training.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

struct HRI_API Topology {
  enum class Kind : std::uint8_t {
    left_right,          ///< from i to i .. i + max_jump; starts in state 0
    banded,              ///< from i to i - max_jump .. i + max_jump; starts anywhere
    ergodic,             ///< from anywhere to anywhere, each pair its own value; starts anywhere
    rank_one_plus_band,  ///< banded, and jumps from anywhere to anywhere whose value is a product
                         ///< of one factor of i and one of j; starts anywhere
  };
  Kind kind = Kind::left_right;
  int num_states = 5;
  int max_jump = 1;

  /// Whether the transition from i to j exists.
  [[nodiscard]] bool allows(int i, int j) const;
  /// The first and one past the last state that can be reached from i without a jump.
  [[nodiscard]] int first_next(int i) const;
  [[nodiscard]] int end_next(int i) const;
  /// The first and one past the last state from which j can be reached without a jump.
  [[nodiscard]] int first_previous(int j) const;
  [[nodiscard]] int end_previous(int j) const;

  static constexpr const char* kName = "Topology";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("kind", o.kind, any_value, "which transitions exist");
    v("num_states", o.num_states, within(1, 4096), "number of states");
    v("max_jump", o.max_jump, within(1, 4096),
      "largest step to another state without a jump; ergodic ignores it");
  }
};
constexpr auto enum_names(Topology::Kind) {
  return std::array{"left_right", "banded", "ergodic", "rank_one_plus_band"};
}

/// Start probabilities: all on state 0 for left_right, uniform otherwise, shape (num_states,).
HRI_API VectorD initial_start(const Topology& topology);

/// Row-stochastic start values without jumps: `stay` on the diagonal, the rest shared by the other
/// states in reach.
HRI_API MatrixD initial_transition(const Topology& topology, double stay = 0.6);

HRI_API void write_topology(const Topology& topology, ModelFile& file, const std::string& prefix);
HRI_API Topology read_topology(const ModelFile& file, const std::string& prefix);

}  // namespace hri
