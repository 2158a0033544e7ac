// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the embedding of ConnectedWordRecognizer is trained on: words as they sound in strings.
#pragma once

#include <memory>
#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "recognition/sentence/training_strings.hpp"

namespace hri::detail {

class WordVectors {
 public:
  WordVectors(std::shared_ptr<const SpeechEmbedding> embedding,
              const WordRecognizerOptions& options)
      : embedding_(std::move(embedding)), options_(options) {}

  /// Joins the words to strings, once as they are and options.num_embedding_copies times in noise;
  /// the words around one are of the same speaker, who is of the same fold.
  void add(const std::vector<SpokenWord>& words, const StringMaker& maker,
           const StopCheck& should_stop);
  /// Of all words that are not of this fold.
  [[nodiscard]] EmbeddedWords train_without(int fold, const StopCheck& should_stop) const;

 private:
  struct Embedded {
    int label;
    int fold;
    VectorF vector;
  };

  std::shared_ptr<const SpeechEmbedding> embedding_;
  WordRecognizerOptions options_;
  std::vector<Embedded> words_;
};

}  // namespace hri::detail
