// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/grammar.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "language/grammar_tree.hpp"
#include "language/jsgf_reader.hpp"

namespace hri {
namespace {

using detail::GrammarGraph;

constexpr std::size_t kMostWords = 10000;  // of a sentence

// A way through a grammar along the words of a sentence, depth first, so that the first of several
// alternatives is found first.
class SentenceWalk {
 public:
  SentenceWalk(const GrammarGraph& graph, const std::vector<std::string>& sentence)
      : graph_(graph), sentence_(sentence), next_(graph.nodes.size()) {
    for (const GrammarGraph::Arc& arc : graph.arcs)
      next_[static_cast<std::size_t>(arc.from)].push_back(arc.to);
  }

  std::optional<Slots> run() {
    const Place goal{static_cast<int>(graph_.nodes.size()) - 1, sentence_.size()};
    std::vector<std::pair<Place, std::uint64_t>> open{{{0, 0}, kStart}};
    while (!open.empty()) {
      const auto [place, before] = open.back();
      open.pop_back();
      if (!before_.emplace(key(place), before).second) continue;
      if (key(place) == key(goal)) return slots(goal);
      const auto& next = next_[static_cast<std::size_t>(place.node)];
      for (auto to = next.rbegin(); to != next.rend(); ++to) {
        const std::string& word = graph_.nodes[static_cast<std::size_t>(*to)].word;
        if (word.empty()) {
          open.push_back({{*to, place.position}, key(place)});
        } else if (place.position < sentence_.size() && sentence_[place.position] == word) {
          open.push_back({{*to, place.position + 1}, key(place)});
        }
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint64_t kStart = ~std::uint64_t{0};
  struct Place {
    int node;
    std::size_t position;  // words passed
  };
  [[nodiscard]] std::uint64_t key(const Place& place) const {
    return static_cast<std::uint64_t>(place.position) * graph_.nodes.size() +
           static_cast<std::uint64_t>(place.node);
  }

  [[nodiscard]] Slots slots(const Place& goal) const {
    std::vector<Place> path;
    for (std::uint64_t at = key(goal); at != kStart; at = before_.at(at))
      path.push_back({static_cast<int>(at % graph_.nodes.size()), at / graph_.nodes.size()});
    std::reverse(path.begin(), path.end());
    Slots found;
    std::vector<std::size_t> opened;
    for (const Place& place : path) {
      const GrammarGraph::Node& node = graph_.nodes[static_cast<std::size_t>(place.node)];
      if (node.mark == GrammarGraph::Mark::opens) opened.push_back(place.position);
      if (node.mark != GrammarGraph::Mark::closes) continue;
      const GrammarGraph::Tag& tag = graph_.tags[static_cast<std::size_t>(node.tag)];
      std::string value = tag.value;
      for (std::size_t w = opened.back(); tag.value.empty() && w < place.position; ++w)
        value += (value.empty() ? "" : " ") + sentence_[w];
      opened.pop_back();
      found[tag.slot] = value;
    }
    return found;
  }

  const GrammarGraph& graph_;
  const std::vector<std::string>& sentence_;
  std::vector<std::vector<int>> next_;
  std::unordered_map<std::uint64_t, std::uint64_t> before_;  // by place; of all seen
};

constexpr std::size_t kMostVisits = 10000000;  // of nodes, by all paths
constexpr std::size_t kMostListed = 4000000;   // words of all sentences, each by every path

// All paths from the first node to the last one.
class SentenceList {
 public:
  SentenceList(const GrammarGraph& graph, std::size_t most)
      : graph_(graph), most_(most), next_(graph.nodes.size()), is_open_(graph.nodes.size()) {
    for (const GrammarGraph::Arc& arc : graph.arcs)
      next_[static_cast<std::size_t>(arc.from)].push_back(arc.to);
  }

  std::vector<std::vector<std::string>> run() {
    std::vector<std::pair<std::size_t, std::size_t>> path;  // nodes, and the arc to take next
    const auto enter = [&](std::size_t node) {
      require(!is_open_[node], "the grammar repeats words: its sentences have no end");
      require(++num_visits_ <= kMostVisits, "the grammar has too many sentences to list them");
      is_open_[node] = true;
      if (!graph_.nodes[node].word.empty()) words_.push_back(graph_.nodes[node].word);
      path.emplace_back(node, 0);
      if (node + 1 == next_.size()) add();
    };
    enter(0);
    while (!path.empty()) {
      const auto [node, taken] = path.back();
      if (taken < next_[node].size()) {
        ++path.back().second;
        enter(static_cast<std::size_t>(next_[node][taken]));
        continue;
      }
      if (!graph_.nodes[node].word.empty()) words_.pop_back();
      is_open_[node] = false;
      path.pop_back();
    }
    return std::move(found_);
  }

 private:
  void add() {
    require(words_.size() <= kMostWords, "the grammar has a sentence of more than 10000 words");
    num_listed_ += words_.size();
    require(num_listed_ <= kMostListed, "the sentences of the grammar are too long to list them");
    if (!known_.insert(words_).second) return;
    if (known_.size() > most_) {
      fail(ErrorKind::invalid_argument,
           "the grammar has more than " + std::to_string(most_) + " sentences");
    }
    found_.push_back(words_);
  }

  const GrammarGraph& graph_;
  std::size_t most_;
  std::vector<std::vector<int>> next_;
  std::vector<bool> is_open_;
  std::size_t num_visits_ = 0;
  std::size_t num_listed_ = 0;  // words
  std::vector<std::string> words_;
  std::set<std::vector<std::string>> known_;
  std::vector<std::vector<std::string>> found_;
};

}  // namespace

Grammar Grammar::parse(const std::string& text, const std::string& name) {
  Grammar grammar;
  grammar.text_ = text;
  grammar.graph_ =
      std::make_shared<const GrammarGraph>(GrammarGraph::of(detail::JsgfReader(text, name).read()));
  std::set<std::string> words;
  for (const GrammarGraph::Node& node : grammar.graph_->nodes) {
    if (!node.word.empty()) words.insert(node.word);
  }
  grammar.words_.assign(words.begin(), words.end());
  return grammar;
}

Grammar Grammar::load(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return parse({bytes.begin(), bytes.end()}, path);
}

std::optional<Slots> Grammar::slots_of(const std::vector<std::string>& sentence) const {
  if (sentence.size() > kMostWords) return std::nullopt;
  return SentenceWalk(*graph_, sentence).run();
}

std::vector<std::vector<std::string>> Grammar::sentences(std::size_t most) const {
  return SentenceList(*graph_, most).run();
}

WordNetwork Grammar::network(const std::vector<std::string>& labels, int silence,
                             int unknown) const {
  std::vector<int> models;
  std::vector<WordNetwork::Arc> arcs;
  const auto add = [&models](int model) {
    models.push_back(model);
    return static_cast<int>(models.size()) - 1;
  };
  const auto add_silence = [&](int node) {
    if (silence == WordNetwork::kNoSilence) return;
    const int quiet = add(silence);
    arcs.push_back({node, quiet, 0});
    arcs.push_back({quiet, node, 0});
  };
  std::unordered_map<std::string, int> model_of{{"", WordNetwork::kNull}};
  for (const std::string& label : labels)
    model_of.emplace(label, static_cast<int>(model_of.size()) - 1);
  for (const GrammarGraph::Node& node : graph_->nodes) {
    const auto found = model_of.find(node.word);
    if (found == model_of.end()) {
      fail(ErrorKind::invalid_argument,
           "the grammar has the word '" + node.word + "', which is no label");
    }
    add(found->second);
  }
  const int final = static_cast<int>(graph_->nodes.size()) - 1;
  // Behind every word stands a null node, where it may be silent.
  std::vector<int> behind(graph_->nodes.size());
  for (int n = 0; n <= final; ++n) {
    behind[static_cast<std::size_t>(n)] = n;
    if (models[static_cast<std::size_t>(n)] == WordNetwork::kNull) continue;
    const int node = add(WordNetwork::kNull);
    behind[static_cast<std::size_t>(n)] = node;
    arcs.push_back({n, node, 0});
    add_silence(node);
  }
  add_silence(0);
  for (const GrammarGraph::Arc& arc : graph_->arcs)
    arcs.push_back({behind[static_cast<std::size_t>(arc.from)], arc.to, arc.log_weight});
  if (unknown != WordNetwork::kNull) {
    const int word = add(unknown);
    const int node = add(WordNetwork::kNull);
    arcs.insert(arcs.end(), {{0, word, 0}, {word, node, 0}, {node, word, 0}, {node, final, 0}});
    add_silence(node);
  }
  return {std::move(models), std::move(arcs), 0, final};
}

}  // namespace hri
