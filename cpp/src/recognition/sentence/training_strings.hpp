// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Strings of words, joined from isolated recordings of one speaker each, with known boundaries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "recognition/sentence/sentence_front_end.hpp"

namespace hri::detail {

/// A recording at the rate of the front end; samples [first, last) are the word.
struct SpokenWord {
  std::vector<float> clip;
  std::size_t first = 0;
  std::size_t last = 0;
  int label = 0;
  std::string group;
  int fold = 0;
};

struct WordString {
  std::vector<float> audio;
  std::vector<int> labels;
  std::vector<const SpokenWord*> words;  ///< that it was joined from
  std::vector<std::size_t> firsts;       ///< of every word, in samples
  std::vector<std::size_t> lasts;
};

class StringMaker {
 public:
  /// Throws InvalidArgument naming the option that is out of range.
  explicit StringMaker(const ConnectedWordRecognizerOptions& options);

  [[nodiscard]] const SentenceFrontEnd& front_end() const { return front_ends_.front(); }
  /// Copies of all recordings that training is to see: one for each warp, and noisy ones.
  [[nodiscard]] int num_copies() const;

  /// Every one of `words` once, in strings of random words of one group with random pauses, which
  /// are what was recorded around the words, as far as it goes. The noise floor is in them.
  [[nodiscard]] std::vector<WordString> join(const std::vector<const SpokenWord*>& words,
                                             std::uint64_t seed) const;
  /// The frames of copy `copy`.
  [[nodiscard]] MatrixF frames(const WordString& string, int copy, std::uint64_t seed) const;
  /// The audio in noise, of a kind and as loud as a noisy copy may have it.
  [[nodiscard]] std::vector<float> in_noise(const WordString& string, std::uint64_t seed) const;
  /// Where the words of a string and the pauses lie in its frames; those are model `silence`.
  [[nodiscard]] std::vector<DecodedWord> segments(const WordString& string, Eigen::Index num_frames,
                                                  int silence) const;

 private:
  [[nodiscard]] WordString join_one(const std::vector<const SpokenWord*>& words,
                                    Random* random) const;
  // The audio with the noise of copy `copy`, or as it is.
  [[nodiscard]] std::vector<float> heard(const WordString& string, int copy,
                                         std::uint64_t seed) const;

  ConnectedWordRecognizerOptions options_;
  std::vector<SentenceFrontEnd> front_ends_;  // at every warp, the first of 1
};

}  // namespace hri::detail
