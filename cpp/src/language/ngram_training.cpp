// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// N-grams from counts. Both kinds of smoothing interpolate with the next lower order,
// p(w|h) = (c(hw) - discount) / total(h) + share(h) p(w|h'), and the lowest order with the uniform
// distribution; share(h) is also the back-off weight, as an n-gram that was not seen has no first
// term.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/language/ngram_model.hpp"
#include "language/ngram_words.hpp"

namespace hri {
namespace {

constexpr double kNoProbability = -99;  // of <s>, as ARPA files have it
constexpr double kUsualDiscount = 0.5;  // where the counts of counts give none

}  // namespace

class NGramTrainer {
 public:
  NGramTrainer(const NGramOptions& options, const std::vector<Sentence>& sentences,
               const std::vector<std::string>& vocabulary)
      : options_(options), counts_(static_cast<std::size_t>(options.order)) {
    set_words(sentences, vocabulary);
    for (const Sentence& sentence : sentences) count(sentence);
    if (options_.smoothing == NGramSmoothing::kneser_ney) count_contexts();
  }

  NGramModel run() {
    model_.ngrams_.resize(counts_.size());
    add_vocabulary();
    for (std::size_t n = 0; n < counts_.size(); ++n) estimate(n);
    return std::move(model_);
  }

 private:
  using NGram = NGramModel::NGram;
  using Counts = std::map<NGram, double>;
  using Place = Counts::const_iterator;

  void set_words(const std::vector<Sentence>& sentences,
                 const std::vector<std::string>& vocabulary) {
    std::set<std::string> words(vocabulary.begin(), vocabulary.end());
    for (const Sentence& sentence : sentences) words.insert(sentence.begin(), sentence.end());
    model_.words_ = {NGramModel::kStart, NGramModel::kEnd};
    model_.words_.insert(model_.words_.end(), words.begin(), words.end());
    model_.index_words();
  }

  void count(const Sentence& sentence) {
    NGram words{model_.start_};
    for (const std::string& word : sentence) words.push_back(model_.index_.at(word));
    words.push_back(model_.end_);
    for (std::size_t last = 1; last < words.size(); ++last) {
      for (std::size_t n = 0; n < counts_.size() && n <= last; ++n) {
        const auto end = words.begin() + static_cast<std::ptrdiff_t>(last) + 1;
        counts_[n][NGram(end - static_cast<std::ptrdiff_t>(n) - 1, end)] += 1;
      }
    }
  }

  // Below the highest order an n-gram counts by the words that were seen before it; what begins a
  // sentence has none before it and keeps its count.
  void count_contexts() {
    for (std::size_t n = 0; n + 1 < counts_.size(); ++n) {
      Counts contexts;
      for (const auto& [ngram, times] : counts_[n]) {
        if (ngram.front() == model_.start_) contexts[ngram] = times;
      }
      for (const auto& longer : counts_[n + 1])
        contexts[{longer.first.begin() + 1, longer.first.end()}] += 1;
      counts_[n] = std::move(contexts);
    }
  }

  [[nodiscard]] double discount(std::size_t n) const {
    if (options_.smoothing == NGramSmoothing::witten_bell) return 0;
    double once = 0;
    double twice = 0;
    for (const auto& entry : counts_[n]) {
      once += entry.second == 1 ? 1 : 0;
      twice += entry.second == 2 ? 1 : 0;
    }
    return once > 0 && twice > 0 ? once / (once + 2 * twice) : kUsualDiscount;
  }

  // Unigrams of all words, so that every word can be predicted; of <s> with no probability.
  void add_vocabulary() {
    for (std::size_t w = 0; w < model_.words_.size(); ++w)
      model_.ngrams_[0][{static_cast<std::int32_t>(w)}].log10_probability = kNoProbability;
  }

  void estimate(std::size_t n) {
    const double taken = discount(n);
    for (Place first = counts_[n].begin(); first != counts_[n].end();) {
      // N-grams of one history stand together.
      const NGram history(first->first.begin(), first->first.end() - 1);
      double total = 0;
      double kinds = 0;
      Place last = first;
      for (; last != counts_[n].end() && is_of(last->first, history); ++last) {
        total += last->second;
        kinds += 1;
      }
      if (options_.smoothing == NGramSmoothing::witten_bell) total += kinds;
      const double share =
          (options_.smoothing == NGramSmoothing::witten_bell ? kinds : taken * kinds) / total;
      if (n == 0) {
        add_unigrams(total, taken, share);
      } else {
        model_.ngrams_[n - 1][history].log10_backoff = std::log10(share);
        for (; first != last; ++first)
          add(first->first, (first->second - taken) / total + share * lower(first->first));
      }
      first = last;
    }
  }

  static bool is_of(const NGram& ngram, const NGram& history) {
    return std::equal(history.begin(), history.end(), ngram.begin());
  }

  void add_unigrams(double total, double taken, double share) {
    const double uniform = 1.0 / static_cast<double>(model_.words_.size() - 1);  // without <s>
    for (std::int32_t w = 0; w < static_cast<std::int32_t>(model_.words_.size()); ++w) {
      if (w == model_.start_) continue;
      const auto found = counts_[0].find({w});
      add({w}, (found == counts_[0].end() ? 0 : (found->second - taken) / total) + share * uniform);
    }
  }

  void add(const NGram& ngram, double probability) {
    model_.ngrams_[ngram.size() - 1][ngram].log10_probability = std::log10(probability);
  }

  // p(w|h'), which is there: what was seen after h was seen after h'.
  [[nodiscard]] double lower(const NGram& ngram) const {
    const NGram shorter(ngram.begin() + 1, ngram.end());
    return std::pow(10.0, model_.ngrams_[shorter.size() - 1].at(shorter).log10_probability);
  }

  NGramOptions options_;
  std::vector<Counts> counts_;  // by order, from 1
  NGramModel model_;
};

namespace {

void check_words(const std::vector<std::string>& words, const std::string& name) {
  const std::string where = name + ": the word '";
  for (const std::string& word : words) {
    const char* fault = detail::word_fault(word);
    if (word == NGramModel::kStart || word == NGramModel::kEnd || word == NGramModel::kUnknown)
      fault = "is a marker";
    if (fault != nullptr)
      fail(ErrorKind::invalid_argument, std::string(where).append(word).append("' ").append(fault));
  }
}

}  // namespace

NGramModel NGramModel::train(const std::vector<Sentence>& sentences, const NGramOptions& options,
                             const std::vector<std::string>& vocabulary) {
  validate(options);
  require(!sentences.empty(), "sentences: a language model needs one at least");
  for (std::size_t i = 0; i < sentences.size(); ++i)
    check_words(sentences[i], "sentences[" + std::to_string(i) + "]");
  check_words(vocabulary, "vocabulary");
  return NGramTrainer(options, sentences, vocabulary).run();
}

}  // namespace hri
