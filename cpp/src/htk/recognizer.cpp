// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/recognizer.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

// A model that pronunciations name.
struct Unit {
  WordChain chain;
  double log_skip = kImpossible;
  int first_column = 0;
};

// The units of a pronunciation one behind the other; those that may be skipped are.
WordChain joined(const std::vector<const Unit*>& units, double log_probability,
                 const std::string& word) {
  Eigen::Index size = 0;
  std::vector<Eigen::Index> first;
  for (const Unit* unit : units) {
    first.push_back(size);
    size += unit->chain.log_start.size();
  }
  WordChain whole;
  whole.log_start = VectorD::Constant(size, kImpossible);
  whole.log_transition = MatrixD::Constant(size, size, kImpossible);
  whole.log_exit = VectorD::Constant(size, kImpossible);
  // From a point before unit `next`, reached with `log_weight`, into what follows; gives the weight
  // with which the end is reached without a frame.
  const auto enter = [&](std::size_t next, double log_weight, const auto& set) {
    for (; next < units.size() && log_weight > kImpossible; ++next) {
      const VectorD& start = units[next]->chain.log_start;
      for (Eigen::Index s = 0; s < start.size(); ++s) set(first[next] + s, log_weight + start[s]);
      log_weight += units[next]->log_skip;
    }
    return log_weight;
  };
  const double skipped = enter(0, log_probability, [&](Eigen::Index to, double log_weight) {
    whole.log_start[to] = log_weight;
  });
  if (skipped > kImpossible)
    fail(ErrorKind::invalid_argument, "all models of '" + word + "' can be passed without a frame");
  for (std::size_t u = 0; u < units.size(); ++u) {
    const WordChain& chain = units[u]->chain;
    const Eigen::Index n = chain.log_start.size();
    whole.log_transition.block(first[u], first[u], n, n) = chain.log_transition;
    for (Eigen::Index s = 0; s < n; ++s) {
      whole.log_exit[first[u] + s] =
          enter(u + 1, chain.log_exit[s], [&](Eigen::Index to, double log_weight) {
            whole.log_transition(first[u] + s, to) = log_weight;
          });
    }
  }
  return whole;
}

detail::UnitPlaces places_of(const std::vector<const Unit*>& units, int first_column) {
  detail::UnitPlaces places;
  places.first_column = first_column;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const VectorD& exits = units[u]->chain.log_exit;
    for (Eigen::Index s = 0; s < exits.size(); ++s)
      places.states.push_back({static_cast<int>(u), static_cast<int>(s), exits[s]});
    places.log_skips.push_back(units[u]->log_skip);
  }
  return places;
}

// The best path through a chain: its states.
std::vector<int> path_through(const WordChain& chain, ConstMatrixRefF scores) {
  const Eigen::Index n = chain.log_start.size();
  std::vector<std::vector<int>> from(static_cast<std::size_t>(scores.rows()),
                                     std::vector<int>(static_cast<std::size_t>(n), -1));
  VectorD best = chain.log_start + scores.row(0).transpose().cast<double>();
  for (Eigen::Index t = 1; t < scores.rows(); ++t) {
    VectorD next(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      Eigen::Index before = 0;
      next[j] = (best + chain.log_transition.col(j)).maxCoeff(&before) +
                static_cast<double>(scores(t, j));
      from[static_cast<std::size_t>(t)][static_cast<std::size_t>(j)] = static_cast<int>(before);
    }
    best = next;
  }
  Eigen::Index last = 0;
  const double found = (best + chain.log_exit).maxCoeff(&last);
  if (!(found > kImpossible)) return {};
  std::vector<int> states(static_cast<std::size_t>(scores.rows()));
  int state = static_cast<int>(last);
  for (std::size_t t = states.size(); t-- > 0;) {
    states[t] = state;
    state = from[t][static_cast<std::size_t>(state)];
  }
  return states;
}

// Models and states along a path, and the scores of each.
class PathReader {
 public:
  PathReader(const WordChain& chain, const detail::UnitPlaces& places,
             const Pronunciation& pronunciation, std::int64_t first_frame)
      : chain_(chain), places_(places), names_(pronunciation.models), frame_(first_frame) {
    // What the pronunciation adds at the beginning is none of its models'.
    before_ = std::log(pronunciation.probability);
  }

  std::vector<AlignedModel> read(const std::vector<int>& path, ConstMatrixRefF scores) {
    int previous = -1;
    for (std::size_t t = 0; t < path.size(); ++t, ++frame_) {
      const int state = path[t];
      double weight =
          previous < 0 ? chain_.log_start[state] - before_ : chain_.log_transition(previous, state);
      const int unit = place(state).unit;
      if (previous < 0 || place(previous).unit != unit) {
        weight -= leave(previous, unit);
        models_.push_back({names_[static_cast<std::size_t>(unit)], frame_, frame_, 0, {}});
        begin(state);
      } else if (previous != state) {
        begin(state);
      }
      add(weight + static_cast<double>(scores(static_cast<Eigen::Index>(t), state)));
      models_.back().last_frame = models_.back().states.back().last_frame = frame_ + 1;
      previous = state;
    }
    leave(previous, static_cast<int>(names_.size()));
    return std::move(models_);
  }

 private:
  [[nodiscard]] const detail::UnitPlaces::State& place(int state) const {
    return places_.states[static_cast<std::size_t>(state)];
  }
  void begin(int state) {
    models_.back().states.push_back({place(state).state + 2, frame_, frame_, 0});
  }
  void add(double score) {
    models_.back().log_score += score;
    models_.back().states.back().log_score += score;
  }

  // Out of the model of a state, past those before model `next`; gives what that weighs.
  double leave(int state, int next) {
    double weight = 0;
    int unit = 0;
    if (state >= 0) {
      weight = place(state).log_exit;
      add(weight);
      unit = place(state).unit + 1;
    }
    for (; unit < next; ++unit) {
      const auto u = static_cast<std::size_t>(unit);
      models_.push_back({names_[u], frame_, frame_, places_.log_skips[u], {}});
      weight += places_.log_skips[u];
    }
    return weight;
  }

  const WordChain& chain_;
  const detail::UnitPlaces& places_;
  const std::vector<std::string>& names_;
  std::int64_t frame_;
  double before_ = 0;
  std::vector<AlignedModel> models_;
};

// The lattice with a node for every pronunciation of its words.
class NetworkBuilder {
 public:
  // `numbers`: the chains of every word.
  NetworkBuilder(const WordLattice& lattice, const std::map<std::string, std::vector<int>>& numbers)
      : lattice_(lattice), numbers_(numbers) {}

  WordNetwork build() {
    const int initial = add(WordNetwork::kNull);
    for (std::size_t n = 0; n < lattice_.words.size(); ++n)
      add_word(lattice_.words[n], lattice_.variants.empty() ? 0 : lattice_.variants[n]);
    const int final = add(WordNetwork::kNull);
    connect(initial, entries_[static_cast<std::size_t>(lattice_.first())]);
    for (const WordLattice::Arc& arc : lattice_.arcs) {
      arcs_.push_back({exits_[static_cast<std::size_t>(arc.from)],
                       entries_[static_cast<std::size_t>(arc.to)], arc.log_weight});
    }
    connect(exits_[static_cast<std::size_t>(lattice_.last())], final);
    return {std::move(models_), std::move(arcs_), initial, final};
  }

 private:
  int add(int model) {
    models_.push_back(model);
    return static_cast<int>(models_.size()) - 1;
  }
  void connect(int from, int to) { arcs_.push_back({from, to, 0}); }

  // `variant`: which of its pronunciations, from 1; 0: any.
  void add_word(const std::string& word, int variant) {
    const auto found = numbers_.find(word);
    std::vector<int> chains = found == numbers_.end() ? std::vector<int>() : found->second;
    if (variant > 0 && !chains.empty()) {
      if (variant > static_cast<int>(chains.size()))
        fail(ErrorKind::invalid_argument, "the network wants pronunciation " +
                                              std::to_string(variant) + " of '" + word +
                                              "', which has " + std::to_string(chains.size()));
      chains = {chains[static_cast<std::size_t>(variant) - 1]};
    }
    if (chains.size() < 2) {
      const int node = add(chains.empty() ? WordNetwork::kNull : chains.front());
      entries_.push_back(node);
      exits_.push_back(node);
      return;
    }
    const int entry = add(WordNetwork::kNull);
    const int exit = add(WordNetwork::kNull);
    for (const int chain : chains) {
      const int node = add(chain);
      connect(entry, node);
      connect(node, exit);
    }
    entries_.push_back(entry);
    exits_.push_back(exit);
  }

  const WordLattice& lattice_;
  const std::map<std::string, std::vector<int>>& numbers_;
  std::vector<int> models_;
  std::vector<WordNetwork::Arc> arcs_;
  std::vector<int> entries_;
  std::vector<int> exits_;
};

// What the words of a lattice need, each once.
class UnitTable {
 public:
  explicit UnitTable(const ModelSet& models) : models_(models) {}

  // Valid until the table is gone: maps keep their nodes.
  const Unit* unit(const std::string& name, const std::string& word) {
    const auto found = units_.find(name);
    if (found != units_.end()) return &found->second;
    const MacroDefinition* macro = models_.find('h', name);
    if (macro == nullptr)
      fail(ErrorKind::invalid_argument,
           "there is no model '" + name + "', of the word '" + word + "'");
    Unit unit;
    unit.chain = to_chain(macro->hmm, &unit.log_skip);
    unit.first_column = num_columns_;
    num_columns_ += static_cast<int>(macro->hmm.states.size());
    if (models_.num_codewords() > 0) {
      states_.insert(states_.end(), macro->hmm.states.begin(), macro->hmm.states.end());
    } else {
      hmms_.push_back(to_hmm(macro->hmm));
    }
    return &units_.emplace(name, std::move(unit)).first->second;
  }

  std::vector<GaussianMixtureHmm> take_hmms() { return std::move(hmms_); }
  // Of discrete models: log probabilities by codeword and state.
  [[nodiscard]] MatrixF discrete() const {
    MatrixF logs(models_.num_codewords(), static_cast<Eigen::Index>(states_.size()));
    for (std::size_t s = 0; s < states_.size(); ++s) {
      require(states_[s].discrete.size() == logs.rows(),
              "a model has another number of codewords than the others");
      logs.col(static_cast<Eigen::Index>(s)) = states_[s].discrete.array().log().cast<float>();
    }
    return logs;
  }

 private:
  const ModelSet& models_;
  std::map<std::string, Unit> units_;
  std::vector<GaussianMixtureHmm> hmms_;
  std::vector<StateDefinition> states_;  // of discrete models
  int num_columns_ = 0;
};

}  // namespace

Recognizer::Recognizer(const ModelSet& models, const Dictionary& dictionary,
                       const WordLattice& lattice, const ConnectedDecoderOptions& options)
    : options_(validated(options)), network_(WordNetwork::loop(1)) {
  if (const std::string fault = lattice.fault(); !fault.empty())
    fail(ErrorKind::invalid_argument, "the network of words: " + fault);
  const auto entries = dictionary.by_word();
  std::map<std::string, std::vector<int>> numbers;
  UnitTable table(models);
  for (const std::string& word : lattice.words) {
    if (word == WordLattice::kNull || numbers.count(word) > 0) continue;
    const auto found = entries.find(word);
    if (found == entries.end())
      fail(ErrorKind::invalid_argument, "the dictionary has no word '" + word + "'");
    for (const int number : found->second) {
      const Pronunciation& entry = dictionary.entries[static_cast<std::size_t>(number)];
      std::vector<const Unit*> units;
      units.reserve(entry.models.size());
      for (const std::string& model : entry.models) units.push_back(table.unit(model, word));
      numbers[word].push_back(static_cast<int>(chains_.size()));
      of_entry_.emplace(number, static_cast<int>(chains_.size()));
      entries_.push_back(number);
      units_.push_back(places_of(units, static_cast<int>(columns_.size())));
      chains_.push_back(joined(units, std::log(entry.probability), word));
      pronunciations_.push_back(entry);
      for (const Unit* unit : units) {
        for (int s = 0; s < static_cast<int>(unit->chain.log_start.size()); ++s)
          columns_.push_back(unit->first_column + s);
      }
    }
  }
  require(!chains_.empty(), "the network has no word");
  if (models.num_codewords() > 0) {
    discrete_ = table.discrete();
  } else {
    emissions_.emplace_back(table.take_hmms());
  }
  network_ = NetworkBuilder(lattice, numbers).build();
}

// By states of the chains.
MatrixF Recognizer::scores(ConstMatrixRefF observations) const {
  require(observations.cols() == dim(),
          "the frames have another number of columns than the models");
  if (emissions_.empty()) return discrete_scores(observations);
  const GaussianEmissions& emissions = emissions_.front();
  MatrixF of_hmms(observations.rows(), emissions.num_states());
  emissions.compute(observations, of_hmms);
  MatrixF result(observations.rows(), static_cast<Eigen::Index>(columns_.size()));
  for (Eigen::Index t = 0; t < result.rows(); ++t) {
    for (Eigen::Index c = 0; c < result.cols(); ++c)
      result(t, c) = of_hmms(t, columns_[static_cast<std::size_t>(c)]);
  }
  return result;
}

MatrixF Recognizer::discrete_scores(ConstMatrixRefF observations) const {
  MatrixF result(observations.rows(), static_cast<Eigen::Index>(columns_.size()));
  for (Eigen::Index t = 0; t < result.rows(); ++t) {
    const float value = observations(t, 0);
    if (!(value >= 1 && value <= static_cast<float>(discrete_.rows()) &&
          value == std::floor(value)))
      fail(ErrorKind::invalid_argument, "row " + std::to_string(t) +
                                            " is no codeword of the models, which have 1.." +
                                            std::to_string(discrete_.rows()));
    const auto codeword = static_cast<Eigen::Index>(value) - 1;
    for (Eigen::Index c = 0; c < result.cols(); ++c)
      result(t, c) = discrete_(codeword, columns_[static_cast<std::size_t>(c)]);
  }
  return result;
}

std::vector<RecognisedWord> Recognizer::words_of(const std::vector<DecodedWord>& words) const {
  std::vector<RecognisedWord> result;
  for (const DecodedWord& word : words) {
    const Pronunciation& entry = pronunciations_[static_cast<std::size_t>(word.model)];
    result.push_back({entry.word, entry.has_output ? entry.output : entry.word, word.first_frame,
                      word.last_frame, word.log_score,
                      entries_[static_cast<std::size_t>(word.model)]});
  }
  return result;
}

RecognisedSentence Recognizer::recognise(ConstMatrixRefF observations) const {
  const MatrixF of_states = scores(observations);
  ConnectedDecoder decoder(chains_, network_, options_);
  for (Eigen::Index t = 0; t < of_states.rows(); ++t) decoder.push(row_span(of_states, t));
  std::vector<DecodedWord> words = decoder.take_decided();
  const DecodedSentence rest = decoder.finish();
  words.insert(words.end(), rest.words.begin(), rest.words.end());
  return {rest.complete, rest.log_score, words_of(words)};
}

std::vector<std::vector<AlignedModel>> Recognizer::align(ConstMatrixRefF observations,
                                                         const RecognisedSentence& sentence) const {
  const MatrixF of_states = scores(observations);
  std::vector<std::vector<AlignedModel>> result;
  for (const RecognisedWord& word : sentence.words) {
    const auto found = of_entry_.find(word.pronunciation);
    require(found != of_entry_.end() && word.first_frame >= 0 &&
                word.first_frame < word.last_frame && word.last_frame <= of_states.rows(),
            "a word of the sentence is not of this recogniser and recording");
    const auto number = static_cast<std::size_t>(found->second);
    const MatrixF part = of_states.block(word.first_frame, units_[number].first_column,
                                         word.last_frame - word.first_frame,
                                         static_cast<Eigen::Index>(units_[number].states.size()));
    const std::vector<int> path = path_through(chains_[number], part);
    require(!path.empty(), "no path leads through the frames of a word");
    result.push_back(
        PathReader(chains_[number], units_[number], pronunciations_[number], word.first_frame)
            .read(path, part));
  }
  return result;
}

Lattice Recognizer::lattice(ConstMatrixRefF observations, const LatticeOptions& options) const {
  return Lattice::decode(chains_, network_, scores(observations), options_, options);
}

std::vector<std::string> Recognizer::words() const {
  std::vector<std::string> result;
  result.reserve(pronunciations_.size());
  for (const Pronunciation& entry : pronunciations_) result.push_back(entry.word);
  return result;
}

}  // namespace hri::htk
