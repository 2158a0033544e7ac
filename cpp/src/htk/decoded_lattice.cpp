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
#include "hri/language/connected_decoder.hpp"

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

bool is_word(const Lattice::Node& node) {
  return node.model != WordNetwork::kNull && !node.is_silence;
}

// By arc: whether its weight has the penalty of a word. This is the arc into the word, or those
// into a node that only goes on to words, without weight: such nodes begin words of one frame.
std::vector<bool> penalised(const std::vector<Lattice::Node>& nodes,
                            const std::vector<Lattice::Arc>& arcs) {
  std::vector<bool> begins_words(nodes.size(), true);
  begins_words.front() = false;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].model != WordNetwork::kNull) begins_words[n] = false;
  }
  for (const Lattice::Arc& arc : arcs) {
    if (arc.log_weight != 0 || !is_word(nodes[static_cast<std::size_t>(arc.to)]))
      begins_words[static_cast<std::size_t>(arc.from)] = false;
  }
  begins_words.back() = false;
  std::vector<bool> result;
  result.reserve(arcs.size());
  for (const Lattice::Arc& arc : arcs) {
    const auto to = static_cast<std::size_t>(arc.to);
    result.push_back(begins_words[to] ||
                     (is_word(nodes[to]) && !begins_words[static_cast<std::size_t>(arc.from)]));
  }
  return result;
}

}  // namespace

WordLattice WordLattice::of_lattice(const Lattice& lattice, const std::vector<std::string>& labels,
                                    double first_s, double frame_s, double language_scale,
                                    double insertion_penalty) {
  require(!lattice.empty(), "the lattice has no sentence");
  ConnectedDecoderOptions options;
  options.language_scale = language_scale;
  options.insertion_penalty = insertion_penalty;
  validate(options);
  WordLattice made;
  made.language_scale = language_scale;
  made.insertion_penalty = insertion_penalty;
  for (const Lattice::Node& node : lattice.nodes()) {
    require(node.model < static_cast<int>(labels.size()), "the lattice has a model without label");
    made.words.push_back(
        node.model == WordNetwork::kNull ? kNull : labels[static_cast<std::size_t>(node.model)]);
    made.times_s.push_back(first_s + static_cast<double>(node.frame) * frame_s);
  }
  const std::vector<bool> has_penalty = penalised(lattice.nodes(), lattice.arcs());
  for (std::size_t a = 0; a < has_penalty.size(); ++a) {
    const Lattice::Arc& arc = lattice.arcs()[a];
    const double weight = arc.log_weight - (has_penalty[a] ? insertion_penalty : 0);
    made.arcs.push_back(
        {arc.from, arc.to, language_scale > 0 ? weight / language_scale : 0, arc.log_acoustic});
  }
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
  const std::vector<bool> has_penalty = penalised(nodes, made);
  for (std::size_t a = 0; a < made.size(); ++a) {
    made[a].log_weight =
        made[a].log_weight * language_scale + (has_penalty[a] ? insertion_penalty : 0);
  }
  return {std::move(nodes), std::move(made)};
}

}  // namespace hri::htk
