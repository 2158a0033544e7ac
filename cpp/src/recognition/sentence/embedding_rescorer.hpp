// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Words of a first search by how they sound as a whole. A speech embedding knows words, and not
// where in the utterance they lie; the models of cepstra find that better than which words they
// are. Where a first search finds a word, every word of the vocabulary is therefore lowered by how
// far its posterior by the embedding lies below that of the likeliest one, and the utterance is
// searched again: two-pass decoding. A word that is none may be the likeliest, and is never
// lowered: it is trained on synthetic voices, which a person's word is unlike, known or not.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"

namespace hri::detail {

/// What a word of the first search may have been.
struct RescoredSpan {
  Eigen::Index first_frame = 0;
  Eigen::Index last_frame = 0;
  VectorF log_odds;  ///< of every label against the likeliest word, which may be none of them
};

class EmbeddingRescorer {
 public:
  explicit EmbeddingRescorer(EmbeddedWords words) : words_(std::move(words)) {}

  [[nodiscard]] const EmbeddedWords& words() const { return words_; }

  /// The vector of a word that lies in [first, last) of `audio`, and what is around it: of
  /// training, too.
  static VectorF vector_of(const SpeechEmbedding& embedding, Span<const float> audio,
                           int sample_rate_hz, std::ptrdiff_t first, std::ptrdiff_t last);
  /// Log posterior of every class but for a constant, of such a word.
  [[nodiscard]] VectorF scores(Span<const float> audio, int sample_rate_hz, std::ptrdiff_t first,
                               std::ptrdiff_t last) const;

  /// Adds `weight` times the log odds, over the frames of a span alike, to the states of the words
  /// in `log_emissions`; `chains` are those of the words and others behind them.
  static void rescore(const std::vector<RescoredSpan>& spans, double weight,
                      const std::vector<WordChain>& chains, MatrixF* log_emissions);

 private:
  EmbeddedWords words_;
};

}  // namespace hri::detail
