// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/recognizer.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr int kMostSentences = 1000;

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

// The lattice with a node for every pronunciation of its words.
class NetworkBuilder {
 public:
  // `numbers`: the chains of every word.
  NetworkBuilder(const WordLattice& lattice, const std::map<std::string, std::vector<int>>& numbers)
      : lattice_(lattice), numbers_(numbers) {}

  WordNetwork build() {
    const int initial = add(WordNetwork::kNull);
    for (const std::string& word : lattice_.words) add_word(word);
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

  void add_word(const std::string& word) {
    const auto found = numbers_.find(word);
    const std::vector<int> chains = found == numbers_.end() ? std::vector<int>() : found->second;
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
    hmms_.push_back(to_hmm(macro->hmm));
    num_columns_ += hmms_.back().num_states();
    return &units_.emplace(name, std::move(unit)).first->second;
  }

  std::vector<GaussianMixtureHmm> take_hmms() { return std::move(hmms_); }

 private:
  const ModelSet& models_;
  std::map<std::string, Unit> units_;
  std::vector<GaussianMixtureHmm> hmms_;
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
      chains_.push_back(joined(units, std::log(entry.probability), word));
      pronunciations_.push_back(entry);
      for (const Unit* unit : units) {
        for (int s = 0; s < static_cast<int>(unit->chain.log_start.size()); ++s)
          columns_.push_back(unit->first_column + s);
      }
    }
  }
  require(!chains_.empty(), "the network has no word");
  emissions_.emplace_back(table.take_hmms());
  network_ = NetworkBuilder(lattice, numbers).build();
}

// By states of the chains.
MatrixF Recognizer::scores(ConstMatrixRefF observations) const {
  const GaussianEmissions& emissions = emissions_.front();
  require(observations.cols() == dim(),
          "the frames have another number of columns than the models");
  MatrixF of_hmms(observations.rows(), emissions.num_states());
  emissions.compute(observations, of_hmms);
  MatrixF result(observations.rows(), static_cast<Eigen::Index>(columns_.size()));
  for (Eigen::Index t = 0; t < result.rows(); ++t) {
    for (Eigen::Index c = 0; c < result.cols(); ++c)
      result(t, c) = of_hmms(t, columns_[static_cast<std::size_t>(c)]);
  }
  return result;
}

std::vector<RecognisedWord> Recognizer::words_of(const std::vector<DecodedWord>& words) const {
  std::vector<RecognisedWord> result;
  for (const DecodedWord& word : words) {
    const Pronunciation& entry = pronunciations_[static_cast<std::size_t>(word.model)];
    result.push_back({entry.word, entry.has_output ? entry.output : entry.word, word.first_frame,
                      word.last_frame, word.log_score});
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

Lattice Recognizer::lattice(ConstMatrixRefF observations, const LatticeOptions& options) const {
  return Lattice::decode(chains_, network_, scores(observations), options_, options);
}

std::vector<RecognisedSentence> Recognizer::n_best(const Lattice& lattice, int count) const {
  require(count >= 1 && count <= kMostSentences, "count must lie in 1..1000");
  std::vector<RecognisedSentence> result;
  if (lattice.empty()) return result;
  const std::set<std::string> different = [this] {
    const std::vector<std::string> all = words();
    return std::set<std::string>(all.begin(), all.end());
  }();
  // Sentences that differ in pronunciations alone come one behind the other, and count once.
  const bool are_unique = different.size() == pronunciations_.size();
  std::set<std::vector<std::string>> known;
  for (const DecodedSentence& found : lattice.n_best(are_unique ? count : kMostSentences)) {
    std::vector<RecognisedWord> words = words_of(found.words);
    std::vector<std::string> names;
    names.reserve(words.size());
    for (const RecognisedWord& word : words) names.push_back(word.word);
    if (!known.insert(std::move(names)).second) continue;
    result.push_back({true, found.log_score, std::move(words)});
    if (static_cast<int>(result.size()) == count) break;
  }
  return result;
}

std::vector<std::string> Recognizer::words() const {
  std::vector<std::string> result;
  result.reserve(pronunciations_.size());
  for (const Pronunciation& entry : pronunciations_) result.push_back(entry.word);
  return result;
}

}  // namespace hri::htk
