// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WordLattice of a language model, as HBuild makes it: bigrams as arcs, and one node over which
// all others back off.
#include <cmath>
#include <set>

#include "hri/core/error.hpp"
#include "hri/htk/word_lattice.hpp"

namespace hri::htk {
namespace {

// Of what the model has no bigram for, the weight to back off; 0 where it has no such entry.
double backoff_of(const NGramModel& language, int history) {
  return language.order() < 2 ? 0 : language.log_backoff({&history, 1});
}

}  // namespace

WordLattice WordLattice::of_bigram(const NGramModel& language,
                                   const std::vector<std::string>& words, const std::string& start,
                                   const std::string& end) {
  require(language.order() <= 2, "a network takes language models of order 1 or 2");
  require(!words.empty(), "words: there is none");
  const auto known = [&](const std::string& word) {
    const int number = language.index_of(word);
    if (number < 0)
      fail(ErrorKind::invalid_argument, "the language model does not know '" + word + "'");
    return number;
  };
  WordLattice lattice;
  lattice.words.emplace_back(kNull);  // where sentences begin
  std::vector<int> numbers = {known(start)};
  std::set<std::string> different = {start, end};
  for (const std::string& word : words) {
    if (!different.insert(word).second)
      fail(ErrorKind::invalid_argument, "'" + word + "' stands twice, or is a marker");
    lattice.words.push_back(word);
    numbers.push_back(known(word));
  }
  const int middle = static_cast<int>(lattice.words.size());
  lattice.words.emplace_back(kNull);  // all histories together
  const int last = middle + 1;
  lattice.words.emplace_back(kNull);
  numbers.push_back(-1);
  numbers.push_back(known(end));

  const auto add = [&](int from, int to, double log_weight) {
    if (std::isfinite(log_weight)) lattice.arcs.push_back({from, to, log_weight, 0});
  };
  for (int from = 0; from < middle; ++from) {
    const int history = numbers[static_cast<std::size_t>(from)];
    for (int to = 1; to <= last; ++to) {
      const int word = numbers[static_cast<std::size_t>(to)];
      if (to == middle || !language.has({&history, 1}, word)) continue;
      add(from, to, language.log_probability({&history, 1}, word));
    }
    add(from, middle, backoff_of(language, history));
  }
  for (int to = 1; to <= last; ++to) {
    if (to != middle)
      add(middle, to, language.log_probability({}, numbers[static_cast<std::size_t>(to)]));
  }
  return lattice;
}

}  // namespace hri::htk
