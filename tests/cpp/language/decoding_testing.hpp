// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Small models, random scores, and the best sentence found by trying all there are.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/language/connected_decoder.hpp"

namespace hri::testing_data {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Left-right with random probabilities; `max_jump` 2 allows to skip a state.
inline WordChain random_chain(int num_states, std::uint64_t seed, int max_jump = 1,
                              bool is_silence = false) {
  Random random(seed);
  Topology topology;
  topology.num_states = num_states;
  topology.max_jump = max_jump;
  MatrixD transition = MatrixD::Zero(num_states, num_states);
  for (int i = 0; i < num_states; ++i) {
    for (int j = i; j <= std::min(num_states - 1, i + max_jump); ++j)
      transition(i, j) = 0.1 + random.uniform();
    transition.row(i) /= transition.row(i).sum();
  }
  const MarkovChain chain(topology, initial_start(topology), transition);
  return WordChain::of(chain, 0.2 + 0.6 * random.uniform(), is_silence);
}

inline MatrixF random_scores(int num_frames, int num_states, std::uint64_t seed) {
  Random random(seed);
  MatrixF scores(num_frames, num_states);
  for (Eigen::Index i = 0; i < scores.size(); ++i)
    scores.data()[i] = static_cast<float>(3 * random.normal());
  return scores;
}

/// The best path through one word over frames [first, last), Viterbi in its textbook form.
inline double word_score(const WordChain& chain, const MatrixF& scores, int first_state, int first,
                         int last) {
  const auto size = static_cast<int>(chain.log_start.size());
  std::vector<double> best(static_cast<std::size_t>(size), kNever);
  for (int t = first; t < last; ++t) {
    std::vector<double> next(best.size(), kNever);
    for (int j = 0; j < size; ++j) {
      double& score = next[static_cast<std::size_t>(j)];
      if (t == first) score = chain.log_start[j];
      for (int i = 0; i < size && t > first; ++i)
        score = std::max(score, best[static_cast<std::size_t>(i)] + chain.log_transition(i, j));
      score += static_cast<double>(scores(t, first_state + j));
    }
    best = next;
  }
  double result = kNever;
  for (int j = 0; j < size; ++j)
    result = std::max(result, best[static_cast<std::size_t>(j)] + chain.log_exit[j]);
  return result;
}

/// Models 0 and 1 are words, 2 is silence: five states.
inline std::vector<WordChain> two_words_and_silence(std::uint64_t seed) {
  return {random_chain(2, seed), random_chain(2, seed + 1, 2), random_chain(1, seed + 2, 1, true)};
}

/// One of every kind, of two words and silence.
inline std::vector<WordNetwork> networks_of_two_words() {
  const NGramModel language = NGramModel::train({{"a", "b"}, {"a", "b", "b"}, {"b"}, {"a"}}, {2});
  return {WordNetwork::loop(2),
          WordNetwork::loop(2, 2),
          WordNetwork::sequence(2, 1),
          WordNetwork::sequence(2, 3, 2),
          WordNetwork::transcript({1, 0}),
          WordNetwork::transcript({0, 1, 1}, 2),
          WordNetwork::bigram(language, {"a", "b"}),
          WordNetwork::bigram(language, {"a", "b"}, 2)};
}

/// All paths of a network that cover all frames, each word in every place: slow and plain.
class PlainDecoder {
 public:
  PlainDecoder(const std::vector<WordChain>& chains, const WordNetwork& network,
               const ConnectedDecoderOptions& options, const MatrixF& scores)
      : chains_(chains), network_(network), options_(options), scores_(scores) {
    int state = 0;
    for (const WordChain& chain : chains) {
      first_states_.push_back(state);
      state += static_cast<int>(chain.log_start.size());
    }
    follow(network.initial(), 0, 0);
  }

  struct Path {
    std::vector<DecodedWord> words;
    double log_score;
  };

  [[nodiscard]] double log_score() const { return best_; }
  [[nodiscard]] const std::vector<Path>& paths() const { return paths_; }
  [[nodiscard]] const std::vector<DecodedWord>& words() const { return best_words_; }

 private:
  void follow(int node, int frame, double score) {
    if (node == network_.final() && frame == scores_.rows()) {
      paths_.push_back({words_, score});
      if (score > best_) {
        best_ = score;
        best_words_ = words_;
      }
    }
    for (const WordNetwork::Arc& arc : network_.arcs()) {
      if (arc.from == node) enter(arc.to, frame, score + options_.language_scale * arc.log_weight);
    }
  }

  void enter(int node, int frame, double score) {
    const int model = network_.models()[static_cast<std::size_t>(node)];
    if (model == WordNetwork::kNull) {
      follow(node, frame, score);
      return;
    }
    const WordChain& chain = chains_[static_cast<std::size_t>(model)];
    if (!chain.is_silence) score += options_.insertion_penalty;
    for (int last = frame + 1; last <= scores_.rows(); ++last) {
      const double added =
          word_score(chain, scores_, first_states_[static_cast<std::size_t>(model)], frame, last);
      if (added == kNever) continue;
      words_.push_back({model, frame, last, 0});
      follow(node, last, score + added);
      words_.pop_back();
    }
  }

  const std::vector<WordChain>& chains_;
  const WordNetwork& network_;
  const ConnectedDecoderOptions& options_;
  const MatrixF& scores_;
  std::vector<int> first_states_;
  std::vector<DecodedWord> words_;
  std::vector<DecodedWord> best_words_;
  std::vector<Path> paths_;  // all that cover all frames
  double best_ = kNever;
};

}  // namespace hri::testing_data
