// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/ngram_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kLn10 = 2.302585092994046;

}  // namespace

double NGramFit::perplexity() const {
  return num_words == 0 ? 0 : std::exp(-log_probability / static_cast<double>(num_words));
}

void NGramModel::index_words() {
  for (std::size_t i = 0; i < words_.size(); ++i) index_.emplace(words_[i], static_cast<int>(i));
  const auto number_of = [this](const char* word) {
    const auto found = index_.find(word);
    return found == index_.end() ? -1 : found->second;
  };
  start_ = number_of(kStart);
  end_ = number_of(kEnd);
  unknown_ = number_of(kUnknown);
}

std::int64_t NGramModel::num_ngrams(int order) const {
  require(order >= 1 && order <= this->order(), "order is not one of the model's");
  return static_cast<std::int64_t>(ngrams_[static_cast<std::size_t>(order - 1)].size());
}

int NGramModel::index_of(const std::string& word) const {
  const auto found = index_.find(word);
  return found == index_.end() ? unknown_ : found->second;
}

double NGramModel::log10_probability(NGram history, int word) const {
  double backoff = 0;
  while (true) {
    NGram ngram = history;
    ngram.push_back(word);
    const auto& longest = ngrams_[history.size()];
    if (const auto found = longest.find(ngram); found != longest.end())
      return backoff + found->second.log10_probability;
    // Every word is a unigram, so the history is not empty.
    const auto& contexts = ngrams_[history.size() - 1];
    if (const auto found = contexts.find(history); found != contexts.end())
      backoff += found->second.log10_backoff;
    history.erase(history.begin());
  }
}

double NGramModel::log_probability(Span<const int> history, int word) const {
  const int size = static_cast<int>(words_.size());
  require(word >= -1 && word < size, "word is no number of a word");
  NGram known;
  for (const int w : history) {
    require(w >= -1 && w < size, "history has a number of no word");
    if (w == -1) {
      known.clear();
    } else {
      known.push_back(w);
    }
  }
  if (word == -1 || word == start_) return -std::numeric_limits<double>::infinity();
  const auto longest = static_cast<std::size_t>(order() - 1);
  if (known.size() > longest)
    known.erase(known.begin(), known.end() - static_cast<std::ptrdiff_t>(longest));
  return kLn10 * log10_probability(std::move(known), word);
}

bool NGramModel::has(Span<const int> history, int word) const {
  if (history.size() >= ngrams_.size()) return false;
  NGram ngram(history.begin(), history.end());
  ngram.push_back(word);
  return ngrams_[history.size()].count(ngram) > 0;
}

double NGramModel::log_backoff(Span<const int> history) const {
  if (history.empty() || history.size() >= ngrams_.size()) return 0;
  const auto& contexts = ngrams_[history.size() - 1];
  const auto found = contexts.find(NGram(history.begin(), history.end()));
  return found == contexts.end() ? 0 : kLn10 * found->second.log10_backoff;
}

NGramFit NGramModel::fit_of(const std::vector<Sentence>& sentences) const {
  NGramFit fit;
  std::vector<int> history;
  const auto predict = [&](int word) {
    if (word == -1) {
      ++fit.num_unknown;
    } else {
      fit.log_probability += log_probability(history, word);
      ++fit.num_words;
    }
    history.push_back(word);
  };
  for (const Sentence& sentence : sentences) {
    history.assign(1, start_);
    for (const std::string& word : sentence) predict(index_of(word));
    predict(end_);
  }
  return fit;
}

}  // namespace hri
