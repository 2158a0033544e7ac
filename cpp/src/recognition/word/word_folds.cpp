// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_folds.hpp"

#include <map>

#include "hri/recognition/training.hpp"
#include "recognition/recording_folds.hpp"

namespace hri::detail {

std::vector<int> word_folds(const std::vector<WordOrigin>& words, int max_folds) {
  std::vector<int> labels;
  std::vector<std::string> groups;
  std::vector<std::size_t> recording_of;
  std::map<std::string, std::size_t> numbers;
  for (const WordOrigin& word : words) {
    const std::size_t next = labels.size();
    const std::size_t number =
        word.recording.empty() ? next : numbers.try_emplace(word.recording, next).first->second;
    recording_of.push_back(number);
    if (number != next) continue;
    labels.push_back(word.label);
    groups.push_back(word.group);
  }
  // Asked of the words, not of their recordings: one of these may have several labels.
  std::vector<int> of_words;
  of_words.reserve(words.size());
  for (const WordOrigin& word : words) of_words.push_back(word.label);
  const auto of_each = [&](const std::vector<int>& of_recordings) {
    std::vector<int> folds;
    folds.reserve(words.size());
    for (const std::size_t number : recording_of) folds.push_back(of_recordings[number]);
    return folds;
  };
  std::vector<int> folds = of_each(held_out_folds(labels, groups, max_folds));
  if (!any_fold_is_usable(of_words, folds)) folds = of_each(dealt_folds(labels, max_folds));
  return folds;
}

}  // namespace hri::detail
