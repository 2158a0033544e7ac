// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kMaxLength = 1000;

// Nodes and arcs as they come together.
struct Draft {
  std::vector<int> models;
  std::vector<WordNetwork::Arc> arcs;

  int add(int model) {
    models.push_back(model);
    return static_cast<int>(models.size()) - 1;
  }
  void connect(int from, int to, double log_weight = 0) { arcs.push_back({from, to, log_weight}); }

  // A silence that may stand between two nodes.
  void add_silence(int from, int to, int silence) {
    if (silence == WordNetwork::kNoSilence) return;
    const int node = add(silence);
    connect(from, node);
    connect(node, to);
  }

  // One of the words between two nodes.
  void add_words(int from, int to, int num_words) {
    for (int word = 0; word < num_words; ++word) {
      const int node = add(word);
      connect(from, node);
      connect(node, to);
    }
  }
};

}  // namespace

WordNetwork::WordNetwork(std::vector<int> models, std::vector<Arc> arcs, int initial, int final)
    : models_(std::move(models)), arcs_(std::move(arcs)), initial_(initial), final_(final) {
  check();
  sort_arcs();
}

void WordNetwork::check() const {
  const auto is_node = [this](int n) { return n >= 0 && n < num_nodes(); };
  const auto is_null = [&](int n) {
    return is_node(n) && models_[static_cast<std::size_t>(n)] == kNull;
  };
  require(is_null(initial_) && is_null(final_),
          "the initial and the final node must be null nodes");
  for (const int model : models_) require(model >= kNull, "a node has a model below -1");
  std::vector<std::vector<int>> next(models_.size());
  for (const Arc& arc : arcs_) {
    require(is_node(arc.from) && is_node(arc.to), "an arc joins nodes that there are not");
    require(std::isfinite(arc.log_weight), "the weight of an arc is not finite");
    next[static_cast<std::size_t>(arc.from)].push_back(arc.to);
  }
  std::vector<bool> reached(models_.size());
  std::vector<int> open{initial_};
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (reached[node]) continue;
    reached[node] = true;
    open.insert(open.end(), next[node].begin(), next[node].end());
  }
  require(reached[static_cast<std::size_t>(final_)], "no path leads to the final node");
}

// Null nodes in topological order, by the longest way of null nodes to each.
void WordNetwork::sort_arcs() {
  std::vector<int> rank(models_.size(), 0);
  std::vector<std::vector<int>> next(models_.size());
  std::vector<int> num_before(models_.size(), 0);
  const auto is_null = [this](int n) { return models_[static_cast<std::size_t>(n)] == kNull; };
  for (const Arc& arc : arcs_) {
    if (is_null(arc.from)) rank[static_cast<std::size_t>(arc.from)] = 1;
    if (is_null(arc.to)) rank[static_cast<std::size_t>(arc.to)] = 1;
    if (!is_null(arc.from) || !is_null(arc.to)) continue;
    next[static_cast<std::size_t>(arc.from)].push_back(arc.to);
    ++num_before[static_cast<std::size_t>(arc.to)];
  }
  std::vector<std::size_t> open;
  for (std::size_t n = 0; n < models_.size(); ++n) {
    if (num_before[n] == 0) open.push_back(n);
  }
  std::size_t num_ranked = 0;
  for (; !open.empty(); ++num_ranked) {
    const std::size_t from = open.back();
    open.pop_back();
    for (const int to : next[from]) {
      int& longest = rank[static_cast<std::size_t>(to)];
      longest = std::max(longest, rank[from] + 1);
      if (--num_before[static_cast<std::size_t>(to)] == 0)
        open.push_back(static_cast<std::size_t>(to));
    }
  }
  require(num_ranked == models_.size(), "null nodes make a cycle");
  std::stable_sort(arcs_.begin(), arcs_.end(), [&rank](const Arc& a, const Arc& b) {
    const int rank_a = rank[static_cast<std::size_t>(a.from)];
    const int rank_b = rank[static_cast<std::size_t>(b.from)];
    return rank_a != rank_b ? rank_a < rank_b : a.from < b.from;
  });
}

WordNetwork WordNetwork::loop(int num_words, int silence) {
  require(num_words >= 1, "num_words must be at least 1");
  std::vector<int> words(static_cast<std::size_t>(num_words));
  std::iota(words.begin(), words.end(), 0);
  return loop(words, silence);
}

WordNetwork WordNetwork::loop(const std::vector<int>& words, int silence) {
  require(!words.empty(), "words: there is none");
  Draft draft;
  const int middle = draft.add(kNull);
  for (const int word : words) {
    require(word >= 0, "words: a number is below 0");
    const int node = draft.add(word);
    draft.connect(middle, node);
    draft.connect(node, middle);
  }
  draft.add_silence(middle, middle, silence);
  return {std::move(draft.models), std::move(draft.arcs), middle, middle};
}

WordNetwork WordNetwork::sequence(int num_words, int length, int silence) {
  require(num_words >= 1, "num_words must be at least 1");
  require(length >= 1 && length <= kMaxLength, "length must lie in 1..1000");
  Draft draft;
  const int initial = draft.add(kNull);
  int from = initial;
  for (int i = 0; i < length; ++i) {
    draft.add_silence(from, from, silence);
    const int to = draft.add(kNull);
    draft.add_words(from, to, num_words);
    from = to;
  }
  draft.add_silence(from, from, silence);
  return {std::move(draft.models), std::move(draft.arcs), initial, from};
}

WordNetwork WordNetwork::transcript(const std::vector<int>& words, int silence) {
  require(!words.empty(), "words: there is none");
  Draft draft;
  const int initial = draft.add(kNull);
  int from = initial;
  for (const int word : words) {
    require(word >= 0, "words: a number is below 0");
    draft.add_silence(from, from, silence);
    const int node = draft.add(word);
    const int to = draft.add(kNull);
    draft.connect(from, node);
    draft.connect(node, to);
    from = to;
  }
  draft.add_silence(from, from, silence);
  return {std::move(draft.models), std::move(draft.arcs), initial, from};
}

WordNetwork WordNetwork::bigram(const NGramModel& language, const std::vector<std::string>& labels,
                                int silence) {
  require(language.order() <= 2, "a network takes language models of order 1 or 2");
  require(!labels.empty(), "labels: there is no word");
  std::vector<int> numbers;
  for (const std::string& label : labels) {
    const int number = language.index_of(label);
    if (number < 0)
      fail(ErrorKind::invalid_argument, "the language model does not know '" + label + "'");
    numbers.push_back(number);
  }
  const int num_words = static_cast<int>(labels.size());
  Draft draft;
  // What was said last, which silence does not make forgotten: no word, or one of them.
  std::vector<int> histories;
  for (int i = 0; i <= num_words; ++i) {
    histories.push_back(draft.add(kNull));
    draft.add_silence(histories.back(), histories.back(), silence);
  }
  const int final = draft.add(kNull);
  std::vector<int> words;
  for (int word = 0; word < num_words; ++word) {
    words.push_back(draft.add(word));
    draft.connect(words.back(), histories[static_cast<std::size_t>(word) + 1]);
  }
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const int last = i == 0 ? language.start() : numbers[i - 1];
    const auto log_weight = [&](int word) { return language.log_probability({&last, 1}, word); };
    for (std::size_t word = 0; word < words.size(); ++word)
      draft.connect(histories[i], words[word], log_weight(numbers[word]));
    draft.connect(histories[i], final, log_weight(language.end()));
  }
  return {std::move(draft.models), std::move(draft.arcs), histories.front(), final};
}

// A node that several models may take becomes two null nodes with these between.
WordNetwork WordNetwork::with_variants(const std::vector<std::vector<int>>& variants) const {
  for (const int model : models_) {
    if (model == kNull) continue;
    const auto m = static_cast<std::size_t>(model);
    require(m < variants.size() && !variants[m].empty(), "a model of the network has no variant");
    for (const int variant : variants[m]) require(variant >= 0, "variants: a number is below 0");
  }
  std::vector<int> models;
  std::vector<Arc> arcs;
  const auto add = [&models](int model) {
    models.push_back(model);
    return static_cast<int>(models.size()) - 1;
  };
  const auto has_several = [&](int model) {
    return model != kNull && variants[static_cast<std::size_t>(model)].size() > 1;
  };
  // Nodes that stood in a row do so again, where they are entered.
  std::vector<int> entry;
  for (const int model : models_) {
    if (model == kNull || has_several(model)) {
      entry.push_back(add(kNull));
      continue;
    }
    entry.push_back(add(variants[static_cast<std::size_t>(model)].front()));
  }
  std::vector<int> exit = entry;
  for (std::size_t n = 0; n < models_.size(); ++n) {
    if (!has_several(models_[n])) continue;
    exit[n] = add(kNull);
    for (const int variant : variants[static_cast<std::size_t>(models_[n])]) {
      const int node = add(variant);
      arcs.push_back({entry[n], node, 0});
      arcs.push_back({node, exit[n], 0});
    }
  }
  for (const Arc& arc : arcs_) {
    arcs.push_back({exit[static_cast<std::size_t>(arc.from)],
                    entry[static_cast<std::size_t>(arc.to)], arc.log_weight});
  }
  return {std::move(models), std::move(arcs), entry[static_cast<std::size_t>(initial_)],
          entry[static_cast<std::size_t>(final_)]};
}

}  // namespace hri
