// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Recognizer::n_best: sentences of a lattice by their words, whose pronunciations are as one.
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/recognizer.hpp"

namespace hri::htk {
namespace {

constexpr double kNoScore = -std::numeric_limits<double>::infinity();
constexpr int kMostSentences = 1000;

// By pronunciation: the first one of its word.
std::vector<int> firsts_of(const std::vector<std::string>& words) {
  std::map<std::string, int> first;
  std::vector<int> result;
  result.reserve(words.size());
  for (const std::string& word : words)
    result.push_back(first.emplace(word, static_cast<int>(result.size())).first->second);
  return result;
}

// The lattice with the first pronunciation in place of every other of the same word: nodes and arcs
// keep their numbers.
Lattice of_words(const Lattice& lattice, const std::vector<int>& firsts) {
  std::vector<Lattice::Node> nodes = lattice.nodes();
  for (Lattice::Node& node : nodes) {
    require(node.model < static_cast<int>(firsts.size()),
            "the lattice has a model that is no pronunciation of this recogniser");
    if (node.model != WordNetwork::kNull) node.model = firsts[static_cast<std::size_t>(node.model)];
  }
  return {std::move(nodes), lattice.arcs()};
}

// The best pronunciations of a sentence of of_words() within its times. As every word has a frame,
// a node can only stand behind as many words as end up to its frame.
class Pronouncer {
 public:
  Pronouncer(const Lattice& lattice, const std::vector<int>& firsts)
      : lattice_(lattice),
        firsts_(firsts),
        best_(lattice.nodes().size()),
        by_(lattice.nodes().size()) {}

  void pronounce(DecodedSentence* sentence) {
    words_ = &sentence->words;
    std::fill(best_.begin(), best_.end(), kNoScore);
    best_[0] = 0;
    for (std::size_t a = 0; a < lattice_.arcs().size(); ++a) {
      const Lattice::Arc& arc = lattice_.arcs()[a];
      const auto to = static_cast<std::size_t>(arc.to);
      const double score = best_[static_cast<std::size_t>(arc.from)] + arc.log_score();
      if (score > best_[to] && is_within(arc)) {
        best_[to] = score;
        by_[to] = a;
      }
    }
    std::size_t w = words_->size();
    for (std::size_t node = lattice_.nodes().size() - 1; node > 0;) {
      const int model = lattice_.nodes()[node].model;
      if (model != WordNetwork::kNull) {
        (*words_)[--w].model = model;
        (*words_)[w].log_score = best_[node];
      }
      node = static_cast<std::size_t>(lattice_.arcs()[by_[node]].from);
    }
    for (std::size_t i = words_->size(); i-- > 1;)
      (*words_)[i].log_score -= (*words_)[i - 1].log_score;
  }

 private:
  // How many words end up to a frame.
  [[nodiscard]] std::size_t num_said(std::int64_t frame) const {
    const auto after = std::upper_bound(
        words_->begin(), words_->end(), frame,
        [](std::int64_t at, const DecodedWord& word) { return at < word.last_frame; });
    return static_cast<std::size_t>(after - words_->begin());
  }

  // Whether an arc is the word that the sentence has there, or one without a word between two.
  [[nodiscard]] bool is_within(const Lattice::Arc& arc) const {
    const Lattice::Node& from = lattice_.nodes()[static_cast<std::size_t>(arc.from)];
    const Lattice::Node& to = lattice_.nodes()[static_cast<std::size_t>(arc.to)];
    const std::size_t said = num_said(from.frame);
    if (to.model == WordNetwork::kNull) return num_said(to.frame) == said;
    if (said == words_->size()) return false;
    const DecodedWord& word = (*words_)[said];
    return from.frame == word.first_frame && to.frame == word.last_frame &&
           firsts_[static_cast<std::size_t>(to.model)] ==
               firsts_[static_cast<std::size_t>(word.model)];
  }

  const Lattice& lattice_;
  const std::vector<int>& firsts_;
  std::vector<double> best_;
  std::vector<std::size_t> by_;  // arcs
  std::vector<DecodedWord>* words_ = nullptr;
};

}  // namespace

std::vector<RecognisedSentence> Recognizer::n_best(const Lattice& lattice, int count) const {
  require(count >= 1 && count <= kMostSentences, "count must lie in 1..1000");
  std::vector<RecognisedSentence> result;
  if (lattice.empty()) return result;
  const std::vector<int> firsts = firsts_of(words());
  Pronouncer pronouncer(lattice, firsts);
  for (DecodedSentence& found : of_words(lattice, firsts).n_best(count)) {
    pronouncer.pronounce(&found);
    result.push_back({true, found.log_score, words_of(found.words)});
  }
  return result;
}

}  // namespace hri::htk
