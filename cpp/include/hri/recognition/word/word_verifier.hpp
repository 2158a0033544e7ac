// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Verification: was that a word of the vocabulary at all? Confidence features of the best word (its
// score against a garbage model, its rivals, filler words and the best states frame by frame, and
// the durations of its states) are weighed by two logistic regressions, trained on held-out
// decisions: one against other words, one against sounds that are no speech.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/recognition/word/multi_stream_scorer.hpp"

namespace hri {

/// What a verifier is trained on.
struct VerifierExample {
  enum class Kind : std::uint8_t {
    word,        ///< a word that was recognised
    other_word,  ///< speech outside the vocabulary, such as a word scored without its own model
    sound,       ///< a sound that is no speech
  };

  VectorD features;
  Kind kind = Kind::word;
};

/// What the features of a word are made from, whichever class is left out.
struct WordEvidence {
  VectorF scores;      ///< of all parts of the scorer together
  VectorF of_streams;  ///< by the streams alone; of vectors where there is no stream
  VectorF nearness;    ///< of vectors, where they are scored: minus the squared distances
  VectorF of_network;  ///< where there is one
  double garbage = 0;
  double fillers = 0;  ///< of those that fit best
  double nearness_of_fillers = 0;
};

/// Immutable; const calls are safe from several threads. An untrained one takes the first feature
/// for the score.
class HRI_API WordVerifier {
 public:
  WordVerifier() = default;

  /// The features, in their order: of streams "ratio"; "rivals"; of hidden Markov models also
  /// "states", "length" and "pace"; of vectors "vector_rivals"; of a network "network_rivals";
  /// where there are filler words, of streams "fillers" and of vectors "vector_fillers". Those of
  /// vectors are logs of ratios of squared distances; without streams "rivals" compares their log
  /// posteriors.
  static std::vector<std::string> feature_names(const MultiStreamScorer& scorer);

  /// `scores` are what `scorer` gives the frames.
  static WordEvidence evidence(const MultiStreamScorer& scorer, const StreamFrames& frames,
                               const VectorF& scores);
  /// Features of the best word, as if there were no class `left_out` (-1: none).
  static VectorD features(const MultiStreamScorer& scorer, const StreamFrames& frames,
                          const WordEvidence& evidence, int left_out = -1);

  /// Trains on held-out examples: words against other words by their features `of_words`, and words
  /// against sounds by all, both kinds of equal weight. Without examples of a kind that regression
  /// stays untrained.
  static WordVerifier fit(const std::vector<VerifierExample>& examples, std::vector<int> of_words);
  /// Which features decide against other words, by how many pairs of word and speaker were scored
  /// without the word's own model. Without fillers all do. With them those of fillers and of a
  /// network: what separates a few words holds for others less well. From `kManyWords` pairs on
  /// "rivals" and "states" of hidden Markov models do, too.
  static std::vector<int> features_of_words(const MultiStreamScorer& scorer, int num_words);
  static constexpr int kManyWords = 50;

  /// Log odds that a word of the vocabulary was said, and neither another word nor a mere sound.
  [[nodiscard]] float verification_score(const VectorD& features) const;

  /// Weights of the features against other words (of `features_of_words` alone); empty if
  /// untrained.
  [[nodiscard]] const VectorD& word_weights() const { return words_.weights(); }
  /// Weights of all features against sounds; empty if untrained.
  [[nodiscard]] const VectorD& sound_weights() const { return sounds_.weights(); }

  void write(ModelFile& file, const MultiStreamScorer& scorer) const;
  /// Throws FormatError where the weights do not belong to the features of `scorer`. A file without
  /// a verifier gives an untrained one.
  static WordVerifier read(const ModelFile& file, const MultiStreamScorer& scorer);

 private:
  LogisticRegression words_;
  std::vector<int> of_words_;  // features that it weighs
  LogisticRegression sounds_;
};

}  // namespace hri
