// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/connected_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "language/search_network.hpp"
#include "language/token_chain.hpp"
#include "language/token_kernels.hpp"
#include "language/word_records.hpp"

namespace hri {
namespace {

using detail::kImpossible;
using detail::kTokenBlock;
using detail::SearchNetwork;
using detail::Token;
using detail::TokenChain;
using detail::Tokens;

constexpr std::int64_t kDecideEvery = 16;  // frames

// A word of the network, and which blocks of its states have tokens: first_active up to, not with,
// end_active; none where these are equal.
struct ActiveWord {
  int model = 0;
  int node = 0;
  std::size_t first_state = 0;  // of those of all words, which are padded to blocks
  int first_active = 0;
  int end_active = 0;

  [[nodiscard]] bool is_active() const { return first_active < end_active; }
};

// Arcs from one node to several in a row.
struct ArcRow {
  int from;
  int first_to;
  std::vector<double> log_weights;
};

std::vector<ArcRow> rows_of(const std::vector<WordNetwork::Arc>& arcs) {
  std::vector<ArcRow> rows;
  for (const WordNetwork::Arc& arc : arcs) {
    const bool goes_on =
        !rows.empty() && rows.back().from == arc.from &&
        rows.back().first_to + static_cast<int>(rows.back().log_weights.size()) == arc.to;
    if (!goes_on) rows.push_back({arc.from, arc.to, {}});
    rows.back().log_weights.push_back(arc.log_weight);
  }
  return rows;
}

// Memory of tokens.
struct TokenRow {
  std::vector<double> scores;
  std::vector<std::int64_t> origins;

  explicit TokenRow(std::size_t size = 0) : scores(size, kImpossible), origins(size, 0) {}

  [[nodiscard]] Tokens from(std::size_t first) {
    return {scores.data() + first, origins.data() + first};
  }
  [[nodiscard]] Token at(std::size_t i) const {
    return {scores[i], static_cast<std::int32_t>(origins[i])};
  }
  void clear() { std::fill(scores.begin(), scores.end(), kImpossible); }
};

// What arrives at a node comes from a record, or from the end of a word that has none yet: the
// number of the word, complemented.
constexpr std::int64_t end_of_word(std::size_t word) { return ~static_cast<std::int64_t>(word); }

}  // namespace

WordChain WordChain::of(const MarkovChain& chain, double final_stay, bool is_silence) {
  require(chain.topology().kind == Topology::Kind::left_right,
          "a word of a sentence needs a left-right chain");
  require(final_stay >= 0 && final_stay < 1, "final_stay must lie in 0..1, 1 excluded");
  const Eigen::Index last = chain.start().size() - 1;
  WordChain result;
  result.log_start = chain.log_start();
  MatrixD transition = chain.transition();
  transition(last, last) = final_stay;
  result.log_transition = transition.array().log();
  result.log_exit = VectorD::Constant(last + 1, kImpossible);
  result.log_exit[last] = std::log1p(-final_stay);
  result.is_silence = is_silence;
  return result;
}

WordChain WordChain::possibilities() const {
  WordChain result = *this;
  result.log_start.array() -= log_start.maxCoeff();
  for (Eigen::Index i = 0; i < log_exit.size(); ++i) {
    const double largest = std::max(log_transition.row(i).maxCoeff(), log_exit[i]);
    result.log_transition.row(i).array() -= largest;
    result.log_exit[i] -= largest;
  }
  return result;
}

struct ConnectedDecoder::State {
  State(const std::vector<WordChain>& chains, const WordNetwork& network,
        const ConnectedDecoderOptions& of_decoder)
      : options(validated(of_decoder)),
        search(chains, network, options),
        arcs(rows_of(search.arcs)),
        records(std::max(256, 2 * network.num_nodes())) {
    std::size_t margin = kTokenBlock;
    for (const detail::SearchChain& chain : search.models) {
      models.emplace_back(chain);
      margin = std::max(margin, static_cast<std::size_t>(models.back().margin()));
    }
    std::size_t num_states = margin;
    for (const detail::SearchWord& word : search.words) {
      words.push_back({word.model, word.node, num_states});
      num_states += num_padded(words.back());
    }
    tokens = TokenRow(num_states + margin);
    next_tokens = tokens;
    arrivals = TokenRow(search.word_of_node.size());
    emissions.assign(static_cast<std::size_t>(search.num_emissions) + kTokenBlock, 0);
    exits.resize(words.size());
    exit_records.resize(words.size());
    begin();
  }

  [[nodiscard]] const TokenChain& chain_of(const ActiveWord& word) const {
    return models[static_cast<std::size_t>(word.model)];
  }
  [[nodiscard]] std::size_t num_padded(const ActiveWord& word) const {
    return static_cast<std::size_t>(chain_of(word).num_blocks()) * kTokenBlock;
  }

  void begin() {
    records.reset();
    num_frames = 0;
    tokens.clear();
    for (ActiveWord& word : words) word.first_active = word.end_active = 0;
    std::fill(exits.begin(), exits.end(), Token{});
    pass_on(true);
  }

  // Tokens of all states after one more frame, whose emissions have been taken.
  void advance() {
    double best = kImpossible;
    next_tokens.clear();
    for (ActiveWord& word : words) {
      const auto node = static_cast<std::size_t>(word.node);
      reach(arrivals.scores[node] > kImpossible, &word);
      if (!word.is_active()) continue;
      const int first_emission = search.models[static_cast<std::size_t>(word.model)].first_emission;
      best = std::max(
          best, kernels.advance(chain_of(word).steps(), word.first_active, word.end_active,
                                arrivals.scores[node], arrivals.origins[node],
                                tokens.from(word.first_state), emissions.data() + first_emission,
                                next_tokens.from(word.first_state)));
    }
    std::swap(tokens, next_tokens);
    prune(best - options.beam);
  }

  // To the states that tokens come to in the next frame: of those that are in the word, and of one
  // that arrives.
  void reach(bool arrives, ActiveWord* word) const {
    const TokenChain& chain = chain_of(*word);
    if (word->is_active()) {
      word->first_active = chain.reach_back(word->first_active);
      word->end_active = chain.reach_on(word->end_active);
    }
    if (!arrives) return;
    word->first_active = 0;
    word->end_active = std::max(word->end_active, chain.end_of_start());
  }

  // Drops what is below, and takes stock of the ends of words.
  void prune(double lowest) {
    for (std::size_t w = 0; w < words.size(); ++w) {
      ActiveWord& word = words[w];
      const int first = word.first_active;
      const int end = word.end_active;
      word.first_active = word.end_active = 0;
      for (int block = first; block < end; ++block) {
        double* const scores = tokens.scores.data() + word.first_state + block * kTokenBlock;
        if (!kernels.prune(scores, lowest)) continue;
        if (!word.is_active()) word.first_active = block;
        word.end_active = block + 1;
      }
      exits[w] = {};
      for (const TokenChain::Exit& exit : chain_of(word).exits()) {
        const Token token = tokens.at(word.first_state + static_cast<std::size_t>(exit.state));
        const double score = token.score + exit.log_weight;
        if (score > exits[w].score) exits[w] = {score, token.record};
      }
    }
  }

  // From the ends of words over null nodes to the beginnings of words; at first from the initial
  // node.
  void pass_on(bool at_first) {
    arrivals.clear();
    if (at_first) {
      arrivals.scores[static_cast<std::size_t>(search.initial)] = 0;
      arrivals.origins[static_cast<std::size_t>(search.initial)] = records.root();
    }
    for (const ArcRow& row : arcs) {
      const auto from = static_cast<std::size_t>(row.from);
      const int of_node = search.word_of_node[from];
      double score = arrivals.scores[from];
      std::int64_t origin = arrivals.origins[from];
      if (of_node >= 0) {
        const auto word = static_cast<std::size_t>(of_node);
        score = exits[word].score;
        origin = end_of_word(word);
      }
      if (!(score > kImpossible)) continue;
      kernels.spread(score, origin, row.log_weights.data(),
                     static_cast<std::ptrdiff_t>(row.log_weights.size()),
                     arrivals.from(static_cast<std::size_t>(row.first_to)));
    }
    std::fill(exit_records.begin(), exit_records.end(), -1);
    for (const ActiveWord& word : words) record(word.node);
    record(search.final);
  }

  // Gives what arrives at a node the record of the word whose end it is.
  void record(int node) {
    const auto at = static_cast<std::size_t>(node);
    if (!(arrivals.scores[at] > kImpossible) || arrivals.origins[at] >= 0) return;
    const auto word = static_cast<std::size_t>(~arrivals.origins[at]);
    if (exit_records[word] < 0) {
      exit_records[word] =
          records.add(exits[word].record, words[word].model, num_frames, exits[word].score);
    }
    arrivals.origins[at] = exit_records[word];
  }

  // f(Token) gives whether the token is kept.
  template <class F>
  void for_every_token(F&& f) {
    for (std::size_t i = 0; i < tokens.scores.size(); ++i) visit(&tokens, i, f);
    for (const ActiveWord& word : words) visit(&arrivals, static_cast<std::size_t>(word.node), f);
    visit(&arrivals, static_cast<std::size_t>(search.final), f);
  }

  template <class F>
  static void visit(TokenRow* row, std::size_t i, F& f) {
    if (row->scores[i] > kImpossible && !f(row->at(i))) row->scores[i] = kImpossible;
  }

  void decide() {
    records.begin_marking();
    for_every_token([this](const Token& token) {
      records.mark(token.record);
      return true;
    });
    records.end_marking();
  }

  // Makes room for the ends of all words.
  void make_room() {
    const int wanted = static_cast<int>(words.size());
    if (records.num_free() >= wanted) return;
    decide();
    while (records.num_free() < wanted && records.num_used() > options.max_open_words) {
      keep_best_word();
      decide();
    }
    while (records.num_free() < wanted) records.grow();
  }

  // Drops every hypothesis that does not begin with the oldest open word of the best one.
  void keep_best_word() {
    Token best;
    for_every_token([&best](const Token& token) {
      if (token.score > best.score) best = token;
      return true;
    });
    const std::int32_t first = records.first_open(best.record);
    for_every_token([&](const Token& token) { return records.first_open(token.record) == first; });
  }

  [[nodiscard]] DecodedSentence best_so_far() const {
    DecodedSentence sentence;
    const ActiveWord* in = nullptr;
    Token best;
    for (const ActiveWord& word : words) {
      for (std::size_t j = 0; j < num_padded(word); ++j) {
        const Token token = tokens.at(word.first_state + j);
        if (token.score > best.score) {
          best = token;
          in = &word;
        }
      }
    }
    if (in == nullptr) {
      sentence.words = records.decided();
      return sentence;
    }
    sentence.log_score = best.score;
    records.words_of(best.record, &sentence.words);
    sentence.words.push_back({in->model, records.end_frame(best.record), num_frames,
                              best.score - records.score(best.record)});
    return sentence;
  }

  const detail::TokenKernels& kernels = detail::token_kernels();
  ConnectedDecoderOptions options;
  SearchNetwork search;
  std::vector<ArcRow> arcs;
  std::vector<TokenChain> models;
  std::vector<ActiveWord> words;

  std::int64_t num_frames = 0;
  std::vector<float> emissions;  // of a frame, and behind them what fills the last block
  TokenRow tokens;               // of the states of every word
  TokenRow next_tokens;
  TokenRow arrivals;         // at every node, before the next frame
  std::vector<Token> exits;  // of every word
  std::vector<std::int32_t> exit_records;
  detail::WordRecords records;
};

ConnectedDecoder::ConnectedDecoder(const std::vector<WordChain>& chains, const WordNetwork& network,
                                   const ConnectedDecoderOptions& options)
    : state_(std::make_unique<State>(chains, network, options)) {}
ConnectedDecoder::ConnectedDecoder(ConnectedDecoder&&) noexcept = default;
ConnectedDecoder& ConnectedDecoder::operator=(ConnectedDecoder&&) noexcept = default;
ConnectedDecoder::~ConnectedDecoder() = default;

void ConnectedDecoder::push(Span<const float> log_emissions) {
  State& s = *state_;
  if (log_emissions.size() != static_cast<std::size_t>(s.search.num_emissions)) {
    fail(ErrorKind::invalid_argument, "log_emissions has " + std::to_string(log_emissions.size()) +
                                          " values, the models have " +
                                          std::to_string(s.search.num_emissions) + " states");
  }
  for (const float value : log_emissions)
    require(value < std::numeric_limits<float>::infinity(), "log_emissions has NaN or infinity");
  s.make_room();
  std::copy(log_emissions.begin(), log_emissions.end(), s.emissions.begin());
  s.advance();
  ++s.num_frames;
  s.pass_on(false);
  if (s.num_frames % kDecideEvery == 0) s.decide();
}

DecodedSentence ConnectedDecoder::partial() const { return state_->best_so_far(); }

std::vector<DecodedWord> ConnectedDecoder::take_decided() {
  state_->decide();
  std::vector<DecodedWord> words = state_->records.decided();
  state_->records.decided().clear();
  return words;
}

DecodedSentence ConnectedDecoder::finish() {
  const Token last = state_->arrivals.at(static_cast<std::size_t>(state_->search.final));
  DecodedSentence sentence;
  if (last.alive()) {
    sentence.complete = true;
    sentence.log_score = last.score;
    state_->records.words_of(last.record, &sentence.words);
  } else {
    sentence = state_->best_so_far();
  }
  reset();
  return sentence;
}

void ConnectedDecoder::reset() { state_->begin(); }

int ConnectedDecoder::num_states() const { return state_->search.num_emissions; }
std::int64_t ConnectedDecoder::num_frames() const { return state_->num_frames; }

int ConnectedDecoder::num_active() const {
  const std::vector<double>& scores = state_->tokens.scores;
  return static_cast<int>(std::count_if(scores.begin(), scores.end(),
                                        [](double score) { return score > kImpossible; }));
}

bool ConnectedDecoder::alive() const {
  bool found = false;
  state_->for_every_token([&found](const Token&) { return found = true; });
  return found;
}

}  // namespace hri
