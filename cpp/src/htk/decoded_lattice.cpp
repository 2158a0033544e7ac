// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WordLattice of the lattices that recognition makes, and back.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/word_lattice.hpp"

namespace hri::htk {
namespace {

// The nodes so that every arc leads to a later one; fewer than there are where arcs go round.
std::vector<int> in_order(const WordLattice& lattice) {
  std::vector<std::vector<int>> next(lattice.words.size());
  std::vector<int> num_before(lattice.words.size());
  for (const WordLattice::Arc& arc : lattice.arcs) {
    next[static_cast<std::size_t>(arc.from)].push_back(arc.to);
    ++num_before[static_cast<std::size_t>(arc.to)];
  }
  std::vector<int> order{lattice.first()};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (const int to : next[static_cast<std::size_t>(order[i])]) {
      if (--num_before[static_cast<std::size_t>(to)] == 0) order.push_back(to);
    }
  }
  return order;
}

}  // namespace

WordLattice WordLattice::of_lattice(const Lattice& lattice, const std::vector<std::string>& labels,
                                    double first_s, double frame_s) {
  require(!lattice.empty(), "the lattice has no sentence");
  WordLattice made;
  for (const Lattice::Node& node : lattice.nodes()) {
    require(node.model < static_cast<int>(labels.size()), "the lattice has a model without label");
    made.words.push_back(
        node.model == WordNetwork::kNull ? kNull : labels[static_cast<std::size_t>(node.model)]);
    made.times_s.push_back(first_s + static_cast<double>(node.frame) * frame_s);
  }
  for (const Lattice::Arc& arc : lattice.arcs())
    made.arcs.push_back({arc.from, arc.to, arc.log_weight, arc.log_acoustic});
  return made;
}

Lattice WordLattice::to_lattice(const std::vector<std::string>& labels,
                                const std::vector<std::string>& silences, double first_s,
                                double frame_s) const {
  const std::string wrong = fault();
  require(wrong.empty(), wrong.c_str());
  require(!times_s.empty(), "the nodes of the lattice have no times");
  require(frame_s > 0 && std::isfinite(first_s), "frame_s must be above 0");
  const std::vector<int> order = in_order(*this);
  require(order.size() == words.size(), "the lattice has a cycle");
  std::vector<Lattice::Node> nodes;
  std::vector<int> numbers(words.size());
  for (const int old : order) {
    const auto n = static_cast<std::size_t>(old);
    numbers[n] = static_cast<int>(nodes.size());
    Lattice::Node node;
    const double frame = std::round((times_s[n] - first_s) / frame_s);
    require(frame >= 0 && frame < 1e12, "the time of a node is outside the recording");
    node.frame = static_cast<std::int64_t>(frame);
    if (words[n] != kNull) {
      const auto found = std::find(labels.begin(), labels.end(), words[n]);
      if (found == labels.end())
        fail(ErrorKind::invalid_argument, "the lattice has the word '" + words[n] + "', no label");
      node.model = static_cast<int>(found - labels.begin());
      node.is_silence = std::find(silences.begin(), silences.end(), words[n]) != silences.end();
    }
    nodes.push_back(node);
  }
  std::vector<Lattice::Arc> made;
  made.reserve(arcs.size());
  for (const Arc& arc : arcs) {
    made.push_back({numbers[static_cast<std::size_t>(arc.from)],
                    numbers[static_cast<std::size_t>(arc.to)], arc.log_acoustic, arc.log_weight});
  }
  return {std::move(nodes), std::move(made)};
}

}  // namespace hri::htk
