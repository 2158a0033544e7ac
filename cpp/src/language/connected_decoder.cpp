// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/connected_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "language/word_records.hpp"

namespace hri {
namespace {

using detail::Token;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr std::int64_t kDecideEvery = 16;  // frames

// A possible step into a state.
struct Step {
  int from;
  double log_weight;
};

// A chain without what it cannot do.
struct Model {
  int first_emission = 0;
  int num_states = 0;
  bool is_silence = false;
  std::vector<Step> steps;      // by the state they lead to
  std::vector<int> first_step;  // of every state, and one past the last
  VectorD log_start;
  VectorD log_exit;
};

// A node of the network that stands for a word or a silence.
struct WordNode {
  int model = 0;
  int node = 0;
  int first_state = 0;
  bool is_active = false;
};

// What arrives at a node, and the word whose end it is; -1: it has a record already.
struct Arrival {
  Token token;
  int origin = -1;
};

void check_logs(const VectorD& logs, int size, const std::string& name) {
  if (logs.size() != size) {
    fail(ErrorKind::invalid_argument, name + " has " + std::to_string(logs.size()) +
                                          " values, the chain " + std::to_string(size) + " states");
  }
  for (int i = 0; i < size; ++i) {
    if (!(logs[i] <= 0))
      fail(ErrorKind::invalid_argument, name + " has a value that is no log probability");
  }
}

Model model_of(const WordChain& chain, int first_emission, const std::string& name) {
  const auto size = static_cast<int>(chain.log_start.size());
  if (size == 0) fail(ErrorKind::invalid_argument, name + " has no state");
  check_logs(chain.log_start, size, name + ".log_start");
  check_logs(chain.log_exit, size, name + ".log_exit");
  if (chain.log_transition.rows() != size)
    fail(ErrorKind::invalid_argument, name + ".log_transition has another number of rows");
  for (int i = 0; i < size; ++i)
    check_logs(chain.log_transition.row(i), size, name + ".log_transition");
  Model model{first_emission, size, chain.is_silence, {}, {}, chain.log_start, chain.log_exit};
  for (int to = 0; to < size; ++to) {
    model.first_step.push_back(static_cast<int>(model.steps.size()));
    for (int from = 0; from < size; ++from) {
      const double log_weight = chain.log_transition(from, to);
      if (log_weight > kImpossible) model.steps.push_back({from, log_weight});
    }
  }
  model.first_step.push_back(static_cast<int>(model.steps.size()));
  return model;
}

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

struct ConnectedDecoder::State {
  State(const std::vector<WordChain>& chains, const WordNetwork& network,
        const ConnectedDecoderOptions& of_decoder)
      : options(validated(of_decoder)),
        initial(network.initial()),
        final(network.final()),
        records(std::max(256, 2 * network.num_nodes())) {
    for (std::size_t m = 0; m < chains.size(); ++m) {
      models.push_back(model_of(chains[m], num_emissions, "chains[" + std::to_string(m) + "]"));
      num_emissions += models.back().num_states;
    }
    word_of_node.assign(static_cast<std::size_t>(network.num_nodes()), -1);
    std::size_t num_states = 0;
    for (int n = 0; n < network.num_nodes(); ++n) {
      const int model = network.models()[static_cast<std::size_t>(n)];
      if (model == WordNetwork::kNull) continue;
      require(model < static_cast<int>(models.size()),
              "the network names a model that there is not");
      word_of_node[static_cast<std::size_t>(n)] = static_cast<int>(words.size());
      words.push_back({model, n, static_cast<int>(num_states), false});
      num_states += static_cast<std::size_t>(models[static_cast<std::size_t>(model)].num_states);
    }
    for (WordNetwork::Arc arc : network.arcs()) {
      const int word = word_of_node[static_cast<std::size_t>(arc.to)];
      arc.log_weight *= options.language_scale;
      if (word >= 0 && !model_at(word).is_silence) arc.log_weight += options.insertion_penalty;
      arcs.push_back(arc);
    }
    tokens.resize(num_states);
    next_tokens.resize(num_states);
    arrivals.resize(word_of_node.size());
    exits.resize(words.size());
    exit_records.resize(words.size());
    begin();
  }

  [[nodiscard]] const Model& model_at(int word) const {
    return models[static_cast<std::size_t>(words[static_cast<std::size_t>(word)].model)];
  }

  [[nodiscard]] Token& token_at(const WordNode& word, int state) {
    return tokens[static_cast<std::size_t>(word.first_state) + static_cast<std::size_t>(state)];
  }
  [[nodiscard]] const Token& token_at(const WordNode& word, int state) const {
    return tokens[static_cast<std::size_t>(word.first_state) + static_cast<std::size_t>(state)];
  }

  void begin() {
    records.reset();
    num_frames = 0;
    std::fill(tokens.begin(), tokens.end(), Token{});
    for (WordNode& word : words) word.is_active = false;
    std::fill(exits.begin(), exits.end(), Token{});
    pass_on(true);
  }

  // Tokens of all states after one more frame.
  void advance(Span<const float> emissions) {
    double best = kImpossible;
    for (WordNode& word : words) {
      const Arrival& arrival = arrivals[static_cast<std::size_t>(word.node)];
      Token* const next = next_tokens.data() + word.first_state;
      const Model& model = models[static_cast<std::size_t>(word.model)];
      if (!word.is_active && !arrival.token.alive()) {
        std::fill(next, next + model.num_states, Token{});
        continue;
      }
      best = std::max(best, advance_word(model, arrival.token, tokens.data() + word.first_state,
                                         emissions.data() + model.first_emission, next));
    }
    tokens.swap(next_tokens);
    prune(best - options.beam);
  }

  static double advance_word(const Model& model, const Token& arrival, const Token* before,
                             const float* emissions, Token* after) {
    double best = kImpossible;
    for (int j = 0; j < model.num_states; ++j) {
      Token token = arrival;
      token.score += model.log_start[j];
      for (int s = model.first_step[static_cast<std::size_t>(j)];
           s < model.first_step[static_cast<std::size_t>(j) + 1]; ++s) {
        const Step& step = model.steps[static_cast<std::size_t>(s)];
        const double score = before[step.from].score + step.log_weight;
        if (score > token.score) token = {score, before[step.from].record};
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
      WordNode& word = words[w];
      const Model& model = models[static_cast<std::size_t>(word.model)];
      word.is_active = false;
      exits[w] = {};
      for (int j = 0; j < model.num_states; ++j) {
        Token& token = token_at(word, j);
        if (token.score < lowest) token = {};
        if (!token.alive()) continue;
        word.is_active = true;
        const double score = token.score + model.log_exit[j];
        if (score > exits[w].score) exits[w] = {score, token.record};
      }
    }
  }

  // From the ends of words over null nodes to the beginnings of words; at first from the initial
  // node.
  void pass_on(bool at_first) {
    std::fill(arrivals.begin(), arrivals.end(), Arrival{});
    if (at_first) arrivals[static_cast<std::size_t>(initial)].token = {0, records.root()};
    for (const WordNetwork::Arc& arc : arcs) {
      const int word = word_of_node[static_cast<std::size_t>(arc.from)];
      Arrival passed = word < 0 ? arrivals[static_cast<std::size_t>(arc.from)]
                                : Arrival{exits[static_cast<std::size_t>(word)], word};
      passed.token.score += arc.log_weight;
      Arrival& there = arrivals[static_cast<std::size_t>(arc.to)];
      if (passed.token.score > there.token.score) there = passed;
    }
    std::fill(exit_records.begin(), exit_records.end(), -1);
    for (const WordNode& word : words) record(word.node);
    record(final);
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
    for (const WordNode& word : words) {
      Token& token = arrivals[static_cast<std::size_t>(word.node)].token;
      if (token.alive()) f(token);
    }
    Token& token = arrivals[static_cast<std::size_t>(final)].token;
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
    const WordNode* in = nullptr;
    Token best;
    for (const WordNode& word : words) {
      const int size = models[static_cast<std::size_t>(word.model)].num_states;
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
  std::vector<Model> models;
  int num_emissions = 0;
  std::vector<int> word_of_node;  // -1: a null node
  std::vector<WordNode> words;
  std::vector<WordNetwork::Arc> arcs;  // weighted
  int initial;
  int final;

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
  if (log_emissions.size() != static_cast<std::size_t>(s.num_emissions)) {
    fail(ErrorKind::invalid_argument, "log_emissions has " + std::to_string(log_emissions.size()) +
                                          " values, the models have " +
                                          std::to_string(s.num_emissions) + " states");
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
  const Token& last = state_->arrivals[static_cast<std::size_t>(state_->final)].token;
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

int ConnectedDecoder::num_states() const { return state_->num_emissions; }
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
