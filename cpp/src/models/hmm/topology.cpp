// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/topology.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "io/option_fields.hpp"

namespace hri {

int Topology::first_next(int i) const {
  if (kind == Kind::left_right) return i;
  return kind == Kind::ergodic ? 0 : std::max(0, i - max_jump);
}

int Topology::end_next(int i) const {
  return kind == Kind::ergodic ? num_states : std::min(num_states, i + max_jump + 1);
}

int Topology::first_previous(int j) const {
  return kind == Kind::ergodic ? 0 : std::max(0, j - max_jump);
}

int Topology::end_previous(int j) const {
  if (kind == Kind::left_right) return j + 1;
  return kind == Kind::ergodic ? num_states : std::min(num_states, j + max_jump + 1);
}

bool Topology::allows(int i, int j) const {
  if (kind == Kind::rank_one_plus_band) return true;
  return j >= first_next(i) && j < end_next(i);
}

VectorD initial_start(const Topology& topology) {
  if (topology.kind == Topology::Kind::left_right) return VectorD::Unit(topology.num_states, 0);
  return VectorD::Constant(topology.num_states, 1.0 / topology.num_states);
}

MatrixD initial_transition(const Topology& topology, double stay) {
  const int n = topology.num_states;
  MatrixD a = MatrixD::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const int others = topology.end_next(i) - topology.first_next(i) - 1;
    for (int j = topology.first_next(i); j < topology.end_next(i); ++j) {
      if (i == j) {
        a(i, j) = others == 0 ? 1.0 : stay;
      } else {
        a(i, j) = (1.0 - stay) / others;
      }
    }
  }
  return a;
}

void write_topology(const Topology& topology, ModelFile& file, const std::string& prefix) {
  detail::write_enum(topology.kind, file, prefix + "topology");
  file.set_integer(prefix + "num_states", topology.num_states);
  file.set_integer(prefix + "max_jump", topology.max_jump);
}

Topology read_topology(const ModelFile& file, const std::string& prefix) {
  const auto field = [&](const char* name, std::int64_t low, std::int64_t high) {
    const std::int64_t value = file.integer(prefix + name);
    if (value < low || value > high) {
      fail(ErrorKind::format, file.name() + ": field '" + prefix + name +
                                  "' is out of range: " + std::to_string(value));
    }
    return static_cast<int>(value);
  };
  Topology topology;
  topology.kind = detail::read_enum<Topology::Kind>(file, prefix + "topology");
  topology.num_states = field("num_states", 1, 4096);
  topology.max_jump = field("max_jump", 1, 4096);
  return topology;
}

}  // namespace hri
