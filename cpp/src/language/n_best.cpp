// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Lattice::n_best: A* over beginnings of sentences. A beginning is its words and all nodes of the
// lattice where these may end, so that every string of words is met once.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
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

struct End {
  int node;
  double score;  // the best
};

// The last word of a beginning, behind another one.
struct Beginning {
  int previous = -1;
  int model = WordNetwork::kNull;
  std::vector<End> ends;  // at every node of the lattice; empty once it went on
};

struct Entry {
  double score;  // of the best sentence that begins so, rounded
  int beginning;
  bool is_whole;  // the sentence ends here

  // Of equals, what began last goes on, until it is whole.
  bool operator<(const Entry& other) const {
    return score != other.score ? score < other.score : beginning < other.beginning;
  }
};

// Scores that differ by the rounding of their sums alone become equal; there can be millions, as
// when a word may end in any frame of its last state. The offset keeps round scores, of which there
// are many, away from where two steps meet.
double rounded(double score) {
  constexpr double kSteps = 1 << 20;
  return std::floor(score * kSteps + 0.382);
}

bool is_word(const Lattice::Node& node) {
  return node.model != WordNetwork::kNull && !node.is_silence;
}

// Best scores at nodes, of which few have one.
class Scores {
 public:
  explicit Scores(std::size_t num_nodes) : scores_(num_nodes, kImpossible) {}

  // Whether the node had none.
  bool raise(int node, double score) {
    double& there = scores_[static_cast<std::size_t>(node)];
    const bool is_new = there == kImpossible;
    there = std::max(there, score);
    return is_new;
  }
  // The score at a node, which has none any more.
  double take(int node) {
    return std::exchange(scores_[static_cast<std::size_t>(node)], kImpossible);
  }

 private:
  std::vector<double> scores_;
};

// Beginnings that have one word more, and the whole sentence that ends where they did.
class NextWords {
 public:
  explicit NextWords(const Lattice& lattice)
      : nodes_(lattice.nodes()),
        first_(nodes_.size() + 1, 0),
        between_(nodes_.size()),
        ends_(nodes_.size()) {
    for (const Lattice::Arc& arc : lattice.arcs()) ++first_[static_cast<std::size_t>(arc.from) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    steps_.resize(lattice.arcs().size());
    for (const Lattice::Arc& arc : lattice.arcs())
      steps_[next[static_cast<std::size_t>(arc.from)]++] = {arc.to, arc.log_score()};
  }

  // Score of the whole sentence, -inf if it does not end there; `next` gets a beginning for every
  // word that follows, in the order of their numbers.
  double follow(const std::vector<End>& ends, int previous, std::vector<Beginning>* next) {
    // Arcs lead to nodes of higher numbers: the lowest is complete.
    std::priority_queue<int, std::vector<int>, std::greater<>> open;
    const auto reach = [&](int node, double score) {
      if (between_.raise(node, score)) open.push(node);
    };
    for (const End& end : ends) reach(end.node, end.score);
    double whole = kImpossible;
    reached_.clear();
    while (!open.empty()) {
      const auto from = static_cast<std::size_t>(open.top());
      open.pop();
      const double score = between_.take(static_cast<int>(from));
      if (from + 1 == nodes_.size()) whole = score;
      for (std::size_t s = first_[from]; s < first_[from + 1]; ++s) {
        const End& step = steps_[s];
        const Lattice::Node& to = nodes_[static_cast<std::size_t>(step.node)];
        if (!is_word(to)) {
          reach(step.node, score + step.score);
        } else if (ends_.raise(step.node, score + step.score)) {
          reached_.push_back(step.node);
        }
      }
    }
    const auto model_of = [this](int n) { return nodes_[static_cast<std::size_t>(n)].model; };
    std::sort(reached_.begin(), reached_.end(), [&](int a, int b) {
      return std::make_pair(model_of(a), a) < std::make_pair(model_of(b), b);
    });
    next->clear();
    for (const int node : reached_) {
      if (next->empty() || next->back().model != model_of(node))
        next->push_back({previous, model_of(node), {}});
      next->back().ends.push_back({node, ends_.take(node)});
    }
    return whole;
  }

 private:
  const std::vector<Lattice::Node>& nodes_;
  std::vector<std::size_t> first_;  // step of every node, and one past the last
  std::vector<End> steps_;
  Scores between_;  // of null nodes and silences
  Scores ends_;     // of the next word
  std::vector<int> reached_;
};

}  // namespace

std::vector<DecodedSentence> Lattice::n_best(int count) const {
  require(count >= 1 && count <= kMostCount, "count must lie in 1..1000");
  std::vector<DecodedSentence> found;
  if (empty()) return found;
  const VectorD after = best_to_end();
  NextWords words_behind(*this);
  std::vector<Beginning> begun(1);
  begun[0].ends.push_back({0, 0});
  std::vector<Beginning> next;
  std::priority_queue<Entry> open;
  open.push({rounded(after[0]), 0, false});
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
    const std::vector<End> ends = std::move(begun[static_cast<std::size_t>(entry.beginning)].ends);
    const double whole = words_behind.follow(ends, entry.beginning, &next);
    if (whole > kImpossible) open.push({rounded(whole), entry.beginning, true});
    for (Beginning& beginning : next) {
      if (begun.size() >= kMostBegun) break;
      double best = kImpossible;
      for (const End& end : beginning.ends) best = std::max(best, end.score + after[end.node]);
      begun.push_back(std::move(beginning));
      open.push({rounded(best), static_cast<int>(begun.size()) - 1, false});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.log_score > b.log_score; });
  return found;
}

// By the best scores of every node behind so many of the words.
DecodedSentence Lattice::best_path(const std::vector<int>& words) const {
  const auto num_nodes = static_cast<Eigen::Index>(nodes_.size());
  const auto num_words = static_cast<Eigen::Index>(words.size());
  MatrixD best = MatrixD::Constant(num_nodes, num_words + 1, kImpossible);
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by(num_nodes, num_words + 1);
  best(0, 0) = 0;
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
