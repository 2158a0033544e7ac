// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/word_vectors.hpp"

#include <algorithm>
#include <iterator>

#include "core/parallel_for.hpp"
#include "recognition/sentence/embedding_rescorer.hpp"

namespace hri::detail {

void WordVectors::add(const std::vector<SpokenWord>& words, const StringMaker& maker,
                      const StopCheck& should_stop) {
  std::vector<const SpokenWord*> all;
  all.reserve(words.size());
  for (const SpokenWord& word : words) all.push_back(&word);
  std::vector<WordString> strings;
  for (int copy = 0; copy <= options_.num_embedding_copies; ++copy) {
    for (WordString& string : maker.join(all, options_.seed + static_cast<std::uint64_t>(copy))) {
      if (copy > 0) string.audio = maker.in_noise(string, options_.seed + strings.size());
      strings.push_back(std::move(string));
    }
  }
  std::vector<std::vector<Embedded>> of_strings(strings.size());
  const int rate_hz = maker.front_end().sample_rate_hz();
  parallel_for(strings.size(), should_stop, [&](std::size_t i, const StopCheck& stop) {
    const WordString& string = strings[i];
    for (std::size_t w = 0; w < string.words.size(); ++w) {
      poll(stop);
      of_strings[i].push_back(
          {string.words[w]->label, string.words[w]->fold,
           EmbeddingRescorer::vector_of(*embedding_, string.audio, rate_hz,
                                        static_cast<std::ptrdiff_t>(string.firsts[w]),
                                        static_cast<std::ptrdiff_t>(string.lasts[w]))});
    }
  });
  for (auto& of_string : of_strings)
    std::move(of_string.begin(), of_string.end(), std::back_inserter(words_));
}

EmbeddedWords WordVectors::train_without(int fold, const StopCheck& should_stop) const {
  std::vector<const Embedded*> used;
  std::vector<int> classes;
  for (const Embedded& word : words_) {
    if (word.fold == fold) continue;
    used.push_back(&word);
    classes.push_back(word.label);
  }
  MatrixF rows(static_cast<Eigen::Index>(used.size()), embedding_->vector_size());
  for (std::size_t i = 0; i < used.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = used[i]->vector.transpose();
  SoftmaxRegressionOptions options;
  options.penalty = options_.embedding_penalty;
  const int num_classes = *std::max_element(classes.begin(), classes.end()) + 1;
  return {embedding_, SoftmaxRegression::train(rows, classes, num_classes, options, should_stop)};
}

}  // namespace hri::detail
