// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Lattice::n_best: A* over beginnings of sentences. A beginning is its words and all nodes of the
// lattice where these may end, so that every string of words is met once.
#include <algorithm>
#include <map>
#include <queue>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/language/lattice.hpp"
#include "language/search_network.hpp"

namespace hri {
namespace {

using detail::kImpossible;

constexpr int kMostCount = 1000;
constexpr std::size_t kMostBegun = 1000000;

// The last word of a beginning, behind another one.
struct Beginning {
  int previous = -1;
  int model = WordNetwork::kNull;
  std::map<int, double> ends;  // best score at every node of the lattice; empty once it went on
};

struct Entry {
  double score;  // of the best sentence that begins so
  int beginning;
  bool is_whole;  // the sentence ends here

  bool operator<(const Entry& other) const {
    return score != other.score ? score < other.score : beginning > other.beginning;
  }
};

}  // namespace

std::vector<DecodedSentence> Lattice::n_best(int count) const {
  require(count >= 1 && count <= kMostCount, "count must lie in 1..1000");
  std::vector<DecodedSentence> found;
  if (empty()) return found;
  const VectorD after = best_to_end();
  const auto last = static_cast<int>(nodes_.size()) - 1;
  std::vector<Beginning> begun(1);
  begun[0].ends[0] = 0;
  std::priority_queue<Entry> open;
  open.push({after[0], 0, false});
  while (!open.empty() && static_cast<int>(found.size()) < count) {
    const Entry entry = open.top();
    open.pop();
    if (entry.is_whole) {
      std::vector<int> words;
      for (int b = entry.beginning; b > 0; b = begun[static_cast<std::size_t>(b)].previous)
        words.push_back(begun[static_cast<std::size_t>(b)].model);
      std::reverse(words.begin(), words.end());
      found.push_back(best_path(words));
      continue;
    }
    // Arcs lead to nodes of higher numbers: each is complete when it is reached.
    std::map<int, double> ends = std::move(begun[static_cast<std::size_t>(entry.beginning)].ends);
    std::map<int, std::map<int, double>> next;  // by word
    double whole = kImpossible;
    for (auto at = ends.begin(); at != ends.end(); at = ends.erase(at)) {
      const auto [from, score] = *at;
      if (from == last) whole = score;
      for (int o = first_out_[static_cast<std::size_t>(from)];
           o < first_out_[static_cast<std::size_t>(from) + 1]; ++o) {
        const Arc& arc = arcs_[static_cast<std::size_t>(out_[static_cast<std::size_t>(o)])];
        const Node& to = nodes_[static_cast<std::size_t>(arc.to)];
        const bool is_word = to.model != WordNetwork::kNull && !to.is_silence;
        std::map<int, double>& there = is_word ? next[to.model] : ends;
        const auto place = there.emplace(arc.to, kImpossible).first;
        place->second = std::max(place->second, score + arc.log_score());
      }
    }
    if (whole > kImpossible) open.push({whole, entry.beginning, true});
    for (auto& [model, nodes] : next) {
      if (begun.size() >= kMostBegun) break;
      double best = kImpossible;
      for (const auto& [node, score] : nodes) best = std::max(best, score + after[node]);
      begun.push_back({entry.beginning, model, std::move(nodes)});
      open.push({best, static_cast<int>(begun.size()) - 1, false});
    }
  }
  return found;
}

// By the best scores of every node behind so many of the words.
DecodedSentence Lattice::best_path(const std::vector<int>& words) const {
  const auto num_nodes = static_cast<Eigen::Index>(nodes_.size());
  const auto num_words = static_cast<Eigen::Index>(words.size());
  MatrixD best = MatrixD::Constant(num_nodes, num_words + 1, kImpossible);
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by(num_nodes, num_words + 1);
  best(0, 0) = 0;
  const auto is_word = [](const Node& node) {
    return node.model != WordNetwork::kNull && !node.is_silence;
  };
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    const Arc& arc = arcs_[a];
    const Node& to = nodes_[static_cast<std::size_t>(arc.to)];
    const Eigen::Index step = is_word(to) ? 1 : 0;
    for (Eigen::Index w = 0; w + step <= num_words; ++w) {
      if (step == 1 && words[static_cast<std::size_t>(w)] != to.model) continue;
      const double score = best(arc.from, w) + arc.log_score();
      if (score > best(arc.to, w + step)) {
        best(arc.to, w + step) = score;
        by(arc.to, w + step) = static_cast<int>(a);
      }
    }
  }
  DecodedSentence sentence;
  sentence.complete = true;
  sentence.log_score = best(num_nodes - 1, num_words);
  // Up to the end of a word; then less that of the word before.
  Eigen::Index w = num_words;
  for (auto node = static_cast<int>(num_nodes) - 1; node > 0;) {
    const Arc& arc = arcs_[static_cast<std::size_t>(by(node, w))];
    const Node& to = nodes_[static_cast<std::size_t>(node)];
    if (to.model != WordNetwork::kNull) {
      sentence.words.push_back(
          {to.model, nodes_[static_cast<std::size_t>(arc.from)].frame, to.frame, best(node, w)});
    }
    if (is_word(to)) --w;
    node = arc.from;
  }
  std::reverse(sentence.words.begin(), sentence.words.end());
  for (std::size_t i = sentence.words.size(); i-- > 1;)
    sentence.words[i].log_score -= sentence.words[i - 1].log_score;
  return sentence;
}

}  // namespace hri
