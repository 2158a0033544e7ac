// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/connected_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "language/search_network.hpp"
#include "language/word_records.hpp"

namespace hri {
namespace {

using detail::ChainStep;
using detail::kImpossible;
using detail::SearchChain;
using detail::SearchNetwork;
using detail::Token;

constexpr std::int64_t kDecideEvery = 16;  // frames

// A word of the network, and which of its states have tokens: first_active up to, not with,
// end_active; none where these are equal.
struct ActiveWord : detail::SearchWord {
  int first_active = 0;
  int end_active = 0;

  [[nodiscard]] bool is_active() const { return first_active < end_active; }
};

// What arrives at a node, and the word whose end it is; -1: it has a record already.
struct Arrival {
  Token token;
  int origin = -1;
};

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
        records(std::max(256, 2 * network.num_nodes())) {
    for (const detail::SearchWord& word : search.words) words.push_back({word, 0, 0});
    const auto num_states = static_cast<std::size_t>(search.num_states);
    tokens.resize(num_states);
    next_tokens.resize(num_states);
    arrivals.resize(search.word_of_node.size());
    exits.resize(words.size());
    exit_records.resize(words.size());
    begin();
  }

  [[nodiscard]] Token& token_at(const ActiveWord& word, int state) {
    return tokens[static_cast<std::size_t>(word.first_state) + static_cast<std::size_t>(state)];
  }
  [[nodiscard]] const Token& token_at(const ActiveWord& word, int state) const {
    return tokens[static_cast<std::size_t>(word.first_state) + static_cast<std::size_t>(state)];
  }

  void begin() {
    records.reset();
    num_frames = 0;
    std::fill(tokens.begin(), tokens.end(), Token{});
    for (ActiveWord& word : words) word.first_active = word.end_active = 0;
    std::fill(exits.begin(), exits.end(), Token{});
    pass_on(true);
  }

  // Tokens of all states after one more frame.
  void advance(Span<const float> emissions) {
    double best = kImpossible;
    for (ActiveWord& word : words) {
      const Arrival& arrival = arrivals[static_cast<std::size_t>(word.node)];
      Token* const next = next_tokens.data() + word.first_state;
      const SearchChain& model = search.chain_of(word);
      reach(model, arrival.token.alive(), &word);
      std::fill(next, next + word.first_active, Token{});
      std::fill(next + word.end_active, next + model.num_states, Token{});
      if (!word.is_active()) continue;
      best =
          std::max(best, advance_word(model, word, arrival.token, tokens.data() + word.first_state,
                                      emissions.data() + model.first_emission, next));
    }
    tokens.swap(next_tokens);
    prune(best - options.beam);
  }

  // To the states that tokens come to in the next frame: of those that are in the word, and of one
  // that arrives.
  static void reach(const SearchChain& model, bool arrives, ActiveWord* word) {
    if (word->is_active()) {
      word->first_active = std::max(0, word->first_active - model.most_back);
      word->end_active = std::min(model.num_states, word->end_active + model.most_on);
    }
    if (!arrives) return;
    word->first_active = 0;
    word->end_active = std::max(word->end_active, model.end_of_start);
  }

  static double advance_word(const SearchChain& model, const ActiveWord& word, const Token& arrival,
                             const Token* before, const float* emissions, Token* after) {
    double best = kImpossible;
    for (int j = word.first_active; j < word.end_active; ++j) {
      Token token = arrival;
      token.score += model.log_start[j];
      const ChainStep* const end = model.end_of_steps_into(j);
      for (const ChainStep* step = model.steps_into(j); step != end; ++step) {
        const double score = before[step->from].score + step->log_weight;
        if (score > token.score) token = {score, before[step->from].record};
      }
      token.score += static_cast<double>(emissions[j]);
      after[j] = token;
      best = std::max(best, token.score);
    }
    return best;
  }

  // Drops what is below, and takes stock of the ends of words.
  void prune(double lowest) {
    for (std::size_t w = 0; w < words.size(); ++w) {
      ActiveWord& word = words[w];
      const SearchChain& model = search.chain_of(word);
      const int first = word.first_active;
      const int end = word.end_active;
      word.first_active = word.end_active = 0;
      exits[w] = {};
      for (int j = first; j < end; ++j) {
        Token& token = token_at(word, j);
        if (token.score < lowest) token = {};
        if (!token.alive()) continue;
        if (!word.is_active()) word.first_active = j;
        word.end_active = j + 1;
        const double score = token.score + model.log_exit[j];
        if (score > exits[w].score) exits[w] = {score, token.record};
      }
    }
  }

  // From the ends of words over null nodes to the beginnings of words; at first from the initial
  // node.
  void pass_on(bool at_first) {
    std::fill(arrivals.begin(), arrivals.end(), Arrival{});
    if (at_first) arrivals[static_cast<std::size_t>(search.initial)].token = {0, records.root()};
    for (const WordNetwork::Arc& arc : search.arcs) {
      const int word = search.word_of_node[static_cast<std::size_t>(arc.from)];
      Arrival passed = word < 0 ? arrivals[static_cast<std::size_t>(arc.from)]
                                : Arrival{exits[static_cast<std::size_t>(word)], word};
      passed.token.score += arc.log_weight;
      Arrival& there = arrivals[static_cast<std::size_t>(arc.to)];
      if (passed.token.score > there.token.score) there = passed;
    }
    std::fill(exit_records.begin(), exit_records.end(), -1);
    for (const ActiveWord& word : words) record(word.node);
    record(search.final);
  }

  // Gives what arrives at a node the record of the word whose end it is.
  void record(int node) {
    Arrival& arrival = arrivals[static_cast<std::size_t>(node)];
    if (!arrival.token.alive() || arrival.origin < 0) return;
    const auto origin = static_cast<std::size_t>(arrival.origin);
    if (exit_records[origin] < 0) {
      exit_records[origin] =
          records.add(exits[origin].record, words[origin].model, num_frames, exits[origin].score);
    }
    arrival.token.record = exit_records[origin];
    arrival.origin = -1;
  }

  template <class F>
  void for_every_token(F&& f) {
    for (Token& token : tokens) {
      if (token.alive()) f(token);
    }
    for (const ActiveWord& word : words) {
      Token& token = arrivals[static_cast<std::size_t>(word.node)].token;
      if (token.alive()) f(token);
    }
    Token& token = arrivals[static_cast<std::size_t>(search.final)].token;
    if (token.alive()) f(token);
  }

  void decide() {
    records.begin_marking();
    for_every_token([this](const Token& token) { records.mark(token.record); });
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
    });
    const std::int32_t first = records.first_open(best.record);
    for_every_token([&](Token& token) {
      if (records.first_open(token.record) != first) token = {};
    });
  }

  [[nodiscard]] DecodedSentence best_so_far() const {
    DecodedSentence sentence;
    const ActiveWord* in = nullptr;
    Token best;
    for (const ActiveWord& word : words) {
      const int size = search.chain_of(word).num_states;
      for (int j = 0; j < size; ++j) {
        const Token& token = token_at(word, j);
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

  ConnectedDecoderOptions options;
  SearchNetwork search;
  std::vector<ActiveWord> words;

  std::int64_t num_frames = 0;
  std::vector<Token> tokens;  // of every state of every word
  std::vector<Token> next_tokens;
  std::vector<Token> exits;       // of every word
  std::vector<Arrival> arrivals;  // at every node, before the next frame
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
  s.advance(log_emissions);
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
  const Token& last = state_->arrivals[static_cast<std::size_t>(state_->search.final)].token;
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
  return static_cast<int>(std::count_if(state_->tokens.begin(), state_->tokens.end(),
                                        [](const Token& token) { return token.alive(); }));
}

bool ConnectedDecoder::alive() const {
  bool found = false;
  state_->for_every_token([&found](const Token&) { found = true; });
  return found;
}

}  // namespace hri
