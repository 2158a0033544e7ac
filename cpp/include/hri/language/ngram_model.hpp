// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// N-gram language models of words, interpolated and written as back-off models: Witten-Bell
// (Witten and Bell, IEEE Trans. Information Theory 37(4), 1991, method C) and Kneser-Ney (Kneser
// and Ney, ICASSP 1995, with one discount an order). Files are ARPA's, as SRILM and KenLM have
// them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

enum class NGramSmoothing : std::uint8_t {
  witten_bell,  ///< as much unseen as there were different continuations: fit for few sentences
  kneser_ney,   ///< absolute discount; lower orders count contexts: fit for many
};
constexpr auto enum_names(NGramSmoothing) { return std::array{"witten_bell", "kneser_ney"}; }

struct NGramOptions {
  int order = 2;
  NGramSmoothing smoothing = NGramSmoothing::witten_bell;

  static constexpr const char* kName = "NGramOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("order", o.order, within(1, 6), "words of an n-gram; 2: bigram");
    v("smoothing", o.smoothing, any_value, "how n-grams that were not seen get their share");
  }
};

/// The words of one sentence, without markers of its ends.
using Sentence = std::vector<std::string>;

/// How well a model predicts sentences; the end of each counts as a word.
struct NGramFit {
  double log_probability = 0;  ///< natural log, of all words that the model knows
  std::int64_t num_words = 0;  ///< predicted: known words and ends of sentences
  std::int64_t num_unknown = 0;

  /// exp(-log_probability / num_words); 0 where nothing was predicted.
  [[nodiscard]] double perplexity() const;
};

/// Immutable; const calls are safe from several threads. Word numbers count from 0 in the order of
/// words(); kStart and kEnd are words, too.
class HRI_API NGramModel {
 public:
  static constexpr const char* kStart = "<s>";
  static constexpr const char* kEnd = "</s>";
  static constexpr const char* kUnknown = "<unk>";
  static constexpr int kMaxOrder = 6;

  /// Trains on sentences; `vocabulary` names words beside those in them. Of every history the
  /// probabilities of all words and of kEnd sum to 1. Throws InvalidArgument for no sentence, and
  /// for a word that is empty, a marker, not UTF-8 or has white space in it (names the sentence).
  static NGramModel train(const std::vector<Sentence>& sentences, const NGramOptions& options = {},
                          const std::vector<std::string>& vocabulary = {});

  /// Reads an ARPA file. Throws IoError, and FormatError naming file and line for counts that
  /// differ from what is there, orders above kMaxOrder, n-grams twice or of words that are no
  /// unigrams, probabilities above 1, and whatever else is no ARPA file.
  static NGramModel load(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static NGramModel parse(const std::string& text, const std::string& name);
  void save(const std::string& path) const;
  /// The text of the ARPA file: that which it was read from, byte for byte; of a model that was
  /// trained numbers have 17 digits and read back equal to the bit.
  [[nodiscard]] std::string to_arpa() const;

  [[nodiscard]] int order() const { return static_cast<int>(ngrams_.size()); }
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
  /// The number of n-grams of an order, 1..order().
  [[nodiscard]] std::int64_t num_ngrams(int order) const;
  /// The number of a word: that of kUnknown for one unknown, -1 where the model has no kUnknown
  /// either.
  [[nodiscard]] int index_of(const std::string& word) const;
  [[nodiscard]] int start() const { return start_; }
  [[nodiscard]] int end() const { return end_; }

  /// log P(word | history), natural log; the last order() - 1 words of the history count, -1 (an
  /// unknown word) ends it. -inf for kStart and for -1. Throws InvalidArgument for numbers that
  /// there are not.
  [[nodiscard]] double log_probability(Span<const int> history, int word) const;

  /// Whether the model has the n-gram of a history, of order() - 1 words at most, and a word.
  [[nodiscard]] bool has(Span<const int> history, int word) const;
  /// What log_probability() adds where it leaves out the first word of a history, natural log.
  [[nodiscard]] double log_backoff(Span<const int> history) const;

  [[nodiscard]] NGramFit fit_of(const std::vector<Sentence>& sentences) const;

 private:
  struct Entry {
    double log10_probability = 0;
    double log10_backoff = 0;
  };
  using NGram = std::vector<std::int32_t>;
  friend class NGramTrainer;
  friend class ArpaReader;

  NGramModel() = default;
  void index_words();
  [[nodiscard]] double log10_probability(NGram history, int word) const;

  std::string text_;  // of the file that it was read from
  std::vector<std::string> words_;
  std::map<std::string, int> index_;
  std::vector<std::map<NGram, Entry>> ngrams_;  // by order, from 1
  int start_ = -1;
  int end_ = -1;
  int unknown_ = -1;
};

}  // namespace hri
