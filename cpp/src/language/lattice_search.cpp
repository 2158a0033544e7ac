// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Lattice::decode.
#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/language/lattice.hpp"
#include "language/search_network.hpp"

namespace hri {
namespace {

using detail::ChainStep;
using detail::kImpossible;
using detail::SearchChain;
using detail::SearchNetwork;
using detail::SearchWord;

constexpr std::int64_t kMostValues = 64000000;
constexpr double kRounding = 1e-6;  // sums in another order

// The best scores of what follows, by Viterbi from the last frame to the first.
class BackwardScores {
 public:
  BackwardScores(const SearchNetwork& search, ConstMatrixRefF emissions)
      : search_(search),
        emissions_(emissions),
        states_(MatrixD::Constant(emissions.rows(), search.num_states, kImpossible)),
        entries_(MatrixD::Constant(emissions.rows() + 1, search.num_nodes(), kImpossible)),
        exits_(entries_) {
    entries_(emissions.rows(), search.final) = 0;
    pass_back(emissions.rows());
    for (Eigen::Index t = emissions.rows(); t-- > 0;) {
      for (const SearchWord& word : search.words) retreat(word, t);
      pass_back(t);
    }
  }

  // Behind the emission of frame t in a state; from a node on that a path comes to before frame t;
  // from the end of the word of a node before frame t (of a null node: the same as above).
  [[nodiscard]] const double* of_states(Eigen::Index t) const { return states_.row(t).data(); }
  [[nodiscard]] double of_entry(Eigen::Index t, int node) const { return entries_(t, node); }
  [[nodiscard]] double of_exit(Eigen::Index t, int node) const { return exits_(t, node); }

 private:
  void retreat(const SearchWord& word, Eigen::Index t) {
    const SearchChain& chain = search_.chain_of(word);
    double* const here = states_.row(t).data() + word.first_state;
    const double exit = exits_(t + 1, word.node);
    for (int j = 0; j < chain.num_states; ++j) here[j] = chain.log_exit[j] + exit;
    if (t + 1 < emissions_.rows()) {
      const double* const next = states_.row(t + 1).data() + word.first_state;
      const float* const emitted = emissions_.row(t + 1).data() + chain.first_emission;
      for (int k = 0; k < chain.num_states; ++k) {
        const double score = next[k] + static_cast<double>(emitted[k]);
        if (score == kImpossible) continue;
        for (const ChainStep* s = chain.steps_into(k); s != chain.end_of_steps_into(k); ++s)
          here[s->from] = std::max(here[s->from], score + s->log_weight);
      }
    }
    const float* const emitted = emissions_.row(t).data() + chain.first_emission;
    double& entry = entries_(t, word.node);
    for (int j = 0; j < chain.num_states; ++j)
      entry = std::max(entry, chain.log_start[j] + static_cast<double>(emitted[j]) + here[j]);
  }

  // From the beginnings of words to the ends of those before.
  void pass_back(Eigen::Index t) {
    for (auto arc = search_.arcs.rbegin(); arc != search_.arcs.rend(); ++arc) {
      const bool is_null = search_.word_of_node[static_cast<std::size_t>(arc->from)] < 0;
      double& before = is_null ? entries_(t, arc->from) : exits_(t, arc->from);
      before = std::max(before, arc->log_weight + entries_(t, arc->to));
    }
  }

  const SearchNetwork& search_;
  ConstMatrixRefF emissions_;
  MatrixD states_;
  MatrixD entries_;  // by frame and node
  MatrixD exits_;
};

// A word from the frame on which it begins.
struct Instance {
  const SearchWord* word;
  int entry;      // node of the lattice
  double before;  // the best score of what comes before
  // States on which it goes on; none at first. Scores of the states are apart.
  int first_alive = 0;
  int last_alive = -1;
};

class ForwardPass {
 public:
  ForwardPass(const SearchNetwork& search, ConstMatrixRefF emissions, const BackwardScores& after,
              double beam, int max_arcs)
      : search_(search),
        emissions_(emissions),
        after_(after),
        lowest_(after.of_entry(0, search.initial) - beam - kRounding),
        max_arcs_(static_cast<std::size_t>(max_arcs)),
        ranks_(static_cast<std::size_t>(search.num_nodes())) {
    // A null node stands behind all that lead to it: by its first arc out.
    for (std::size_t a = search.arcs.size(); a-- > 0;)
      ranks_[static_cast<std::size_t>(search.arcs[a].from)] = static_cast<int>(a) + 1;
    int& last = ranks_[static_cast<std::size_t>(search.final)];
    if (last == 0) last = static_cast<int>(search.arcs.size()) + 1;
    for (const SearchChain& chain : search.models)
      most_states_ = std::max(most_states_, static_cast<std::size_t>(chain.num_states));
    next_.resize(most_states_);
  }

  // Nothing where there would be too many arcs.
  std::optional<Lattice> run() {
    here_.assign(ranks_.size(), -1);
    scores_here_.assign(ranks_.size(), kImpossible);
    ends_.resize(search_.words.size());
    const Eigen::Index num_frames = emissions_.rows();
    for (Eigen::Index t = 0; t <= num_frames; ++t) {
      pass_on(t);
      if (arcs_.size() > max_arcs_) return std::nullopt;
      if (t < num_frames) advance(t);
    }
    return finished();
  }

 private:
  struct End {
    int entry;
    double acoustic;
    double score;
  };

  // `order` is that among the nodes of the frame.
  int add(const Lattice::Node& node, int order) {
    nodes_.push_back(node);
    orders_.push_back(order);
    return static_cast<int>(nodes_.size()) - 1;
  }
  int add_null(int node, Eigen::Index t) {
    return add({WordNetwork::kNull, t, false}, ranks_[static_cast<std::size_t>(node)]);
  }

  // What ends before frame t, and over null nodes to what begins.
  void pass_on(Eigen::Index t) {
    std::fill(here_.begin(), here_.end(), -1);
    std::fill(scores_here_.begin(), scores_here_.end(), kImpossible);
    entries_.assign(search_.words.size(), {-1, kImpossible});
    orders_.clear();
    const std::size_t first_node = nodes_.size();
    for (std::size_t w = 0; w < ends_.size(); ++w) end_word(search_.words[w], &ends_[w], t);
    if (t == 0) {
      here_[static_cast<std::size_t>(search_.initial)] = add_null(search_.initial, t);
      scores_here_[static_cast<std::size_t>(search_.initial)] = 0;
    }
    const std::size_t first_arc = arcs_.size();
    for (const WordNetwork::Arc& arc : search_.arcs) {
      const int from = here_[static_cast<std::size_t>(arc.from)];
      if (from < 0) continue;
      const double score = scores_here_[static_cast<std::size_t>(arc.from)] + arc.log_weight;
      if (!(score + after_.of_entry(t, arc.to) >= lowest_)) continue;
      const int word = search_.word_of_node[static_cast<std::size_t>(arc.to)];
      if (word < 0) {
        int& to = here_[static_cast<std::size_t>(arc.to)];
        if (to < 0) to = add_null(arc.to, t);
        double& best = scores_here_[static_cast<std::size_t>(arc.to)];
        best = std::max(best, score);
        arcs_.push_back({from, to, 0, arc.log_weight});
      } else {
        auto& [to, best] = entries_[static_cast<std::size_t>(word)];
        if (to < 0) to = add({WordNetwork::kNull, t, false}, std::numeric_limits<int>::max());
        best = std::max(best, score);
        arcs_.push_back({from, to, 0, arc.log_weight});
      }
    }
    const std::vector<int> numbers = order_nodes(first_node);
    const auto number = [&](int node) {
      return numbers[static_cast<std::size_t>(node) - first_node];
    };
    for (std::size_t a = first_arc; a < arcs_.size(); ++a) {
      arcs_[a].from = number(arcs_[a].from);
      arcs_[a].to = number(arcs_[a].to);
    }
    for (std::size_t w = 0; w < entries_.size(); ++w) {
      const auto& [node, score] = entries_[w];
      if (node >= 0) open_.push_back({&search_.words[w], number(node), score});
    }
  }

  // Ends of words have their numbers at once: they are the first of their frame.
  void end_word(const SearchWord& word, std::vector<End>* ends, Eigen::Index t) {
    if (ends->empty()) return;
    const int node = add({word.model, t, search_.chain_of(word).is_silence}, 0);
    here_[static_cast<std::size_t>(word.node)] = node;
    double& best = scores_here_[static_cast<std::size_t>(word.node)];
    for (const End& end : *ends) {
      arcs_.push_back({end.entry, node, end.acoustic, 0});
      best = std::max(best, end.score);
    }
    ends->clear();
  }

  // Puts the nodes of a frame in the order in which they follow each other; gives their numbers.
  std::vector<int> order_nodes(std::size_t first) {
    std::vector<std::size_t> order(nodes_.size() - first);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) { return orders_[a] < orders_[b]; });
    const std::vector<Lattice::Node> nodes(nodes_.begin() + static_cast<std::ptrdiff_t>(first),
                                           nodes_.end());
    std::vector<int> numbers(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      nodes_[first + i] = nodes[order[i]];
      numbers[order[i]] = static_cast<int>(first + i);
    }
    return numbers;
  }

  void advance(Eigen::Index t) {
    const double* const after = after_.of_states(t);
    states_.resize(std::max(states_.size(), open_.size() * most_states_));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      Instance instance = open_[i];
      const SearchWord& word = *instance.word;
      const SearchChain& chain = search_.chain_of(word);
      const float* const emitted = emissions_.row(t).data() + chain.first_emission;
      const double exit = step(chain, states_.data() + i * most_states_, emitted,
                               after + word.first_state, &instance);
      const double whole = instance.before + exit;
      if (whole + after_.of_exit(t + 1, word.node) >= lowest_) {
        ends_[static_cast<std::size_t>(instance.word - search_.words.data())].push_back(
            {instance.entry, exit, whole});
      }
      if (instance.last_alive < 0) continue;
      std::copy_n(next_.begin(), chain.num_states,
                  states_.begin() + static_cast<std::ptrdiff_t>(kept * most_states_));
      open_[kept++] = instance;
    }
    open_.resize(kept, Instance{});
  }

  // One frame on: scores of the states into next_, and the best one at the end of the word.
  double step(const SearchChain& chain, const double* before, const float* emitted,
              const double* after, Instance* instance) {
    const bool begins = instance->last_alive < 0;
    // Other states cannot be reached.
    const int first = begins ? 0 : std::max(0, instance->first_alive - chain.most_back);
    const int last = begins ? chain.num_states - 1
                            : std::min(chain.num_states - 1, instance->last_alive + chain.most_on);
    std::fill_n(next_.begin(), chain.num_states, kImpossible);
    instance->last_alive = -1;
    double exit = kImpossible;
    for (int j = first; j <= last; ++j) {
      double score = begins ? chain.log_start[j] : kImpossible;
      if (!begins) {
        for (const ChainStep* s = chain.steps_into(j); s != chain.end_of_steps_into(j); ++s)
          score = std::max(score, before[s->from] + s->log_weight);
      }
      score += static_cast<double>(emitted[j]);
      if (!(instance->before + score + after[j] >= lowest_)) continue;
      next_[static_cast<std::size_t>(j)] = score;
      if (instance->last_alive < 0) instance->first_alive = j;
      instance->last_alive = j;
      exit = std::max(exit, score + chain.log_exit[j]);
    }
    return exit;
  }

  // Without nodes from which no arc goes on, as where sums of the same scores differ by rounding.
  Lattice finished() {
    std::vector<bool> goes_on(nodes_.size());
    goes_on.back() = true;
    // Arcs were made in an order in which those from a node stand behind those that lead to it.
    for (auto arc = arcs_.rbegin(); arc != arcs_.rend(); ++arc) {
      if (goes_on[static_cast<std::size_t>(arc->to)])
        goes_on[static_cast<std::size_t>(arc->from)] = true;
    }
    std::vector<Lattice::Node> nodes;
    std::vector<int> numbers(nodes_.size(), -1);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!goes_on[n]) continue;
      numbers[n] = static_cast<int>(nodes.size());
      nodes.push_back(nodes_[n]);
    }
    std::size_t kept = 0;
    for (Lattice::Arc arc : arcs_) {
      arc.from = numbers[static_cast<std::size_t>(arc.from)];
      arc.to = numbers[static_cast<std::size_t>(arc.to)];
      if (arc.to >= 0) arcs_[kept++] = arc;
    }
    arcs_.resize(kept);
    return {std::move(nodes), std::move(arcs_)};
  }

  const SearchNetwork& search_;
  ConstMatrixRefF emissions_;
  const BackwardScores& after_;
  double lowest_;
  std::size_t max_arcs_;
  std::vector<int> ranks_;  // of null nodes, in the order of arcs

  std::vector<Lattice::Node> nodes_;
  std::vector<int> orders_;  // of those of the frame
  std::vector<Lattice::Arc> arcs_;
  std::vector<Instance> open_;
  std::vector<double> states_;                   // of these, most_states_ for each
  std::vector<double> next_;                     // of one of them
  std::size_t most_states_ = 0;                  // of a chain
  std::vector<std::vector<End>> ends_;           // of every word, before the next frame
  std::vector<std::pair<int, double>> entries_;  // of every word: node and score
  std::vector<int> here_;                        // nodes of the lattice, by those of the network
  std::vector<double> scores_here_;
};

}  // namespace

bool Lattice::fits(const std::vector<WordChain>& chains, const WordNetwork& network,
                   std::int64_t num_frames) {
  std::int64_t width = 2 * static_cast<std::int64_t>(network.num_nodes());
  for (const int model : network.models()) {
    if (model >= 0 && model < static_cast<int>(chains.size()))
      width += chains[static_cast<std::size_t>(model)].log_start.size();
  }
  return num_frames < kMostValues / width;
}

Lattice Lattice::decode(const std::vector<WordChain>& chains, const WordNetwork& network,
                        ConstMatrixRefF log_emissions, const ConnectedDecoderOptions& options,
                        const LatticeOptions& lattice_options) {
  validate(lattice_options);
  const SearchNetwork search(chains, network, validated(options));
  if (log_emissions.cols() != search.num_emissions) {
    fail(ErrorKind::invalid_argument, "log_emissions has " + std::to_string(log_emissions.cols()) +
                                          " columns, the models have " +
                                          std::to_string(search.num_emissions) + " states");
  }
  for (Eigen::Index t = 0; t < log_emissions.rows(); ++t) {
    for (const float value : row_span(log_emissions, t))
      require(value < std::numeric_limits<float>::infinity(), "log_emissions has NaN or infinity");
  }
  require(fits(chains, network, log_emissions.rows()),
          "the recording is too long for a lattice of so many states");
  const BackwardScores after(search, log_emissions);
  if (!(after.of_entry(0, search.initial) > kImpossible)) return {{}, {}};
  for (double beam = lattice_options.beam;; beam /= 2) {
    if (beam < kRounding) beam = 0;
    ForwardPass pass(search, log_emissions, after, beam, lattice_options.max_arcs);
    if (std::optional<Lattice> found = pass.run()) return std::move(*found);
    // A single path, and those that are as good, are not cut.
    if (beam == 0) {
      ForwardPass all(search, log_emissions, after, 0, std::numeric_limits<int>::max());
      return std::move(*all.run());
    }
  }
}

}  // namespace hri
