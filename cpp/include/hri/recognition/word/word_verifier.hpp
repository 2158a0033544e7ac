// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Was that one of the words at all? What the best word's alignment tells (how far it is ahead of a
// garbage model, of its rivals, of background words and of the states that fit best frame by frame,
// and whether its states last as long as they should) is weighed by logistic regressions, learned
// on held-out decisions: one against other words, one against sounds that are no speech.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/recognition/sequence_models.hpp"

namespace hri {

/// What was heard in a trial that a verifier learns from.
enum class TrialKind : std::uint8_t {
  word,        ///< a word that was recognised
  other_word,  ///< speech outside the vocabulary, such as a word decided upon without its own model
  sound,       ///< a sound that is no speech
};

struct VerifierTrial {
  VectorD features;
  TrialKind kind = TrialKind::word;
};

/// Immutable; const calls are safe from several threads. One that has learned nothing takes the
/// first feature for the score.
class HRI_API WordVerifier {
 public:
  WordVerifier() = default;

  /// The features, in their order: "ratio", "rivals"; of hidden Markov models also "states",
  /// "length" and "pace"; where there are background words, "background".
  static std::vector<std::string> feature_names(SequenceModelKind kind, bool background);

  /// Features of the best word by `scores`. `streams` are the models that voted, `frames` what each
  /// heard. The class `left_out` (-1: none) is treated as if there were no such word.
  static VectorD features(const std::vector<const SequenceModels*>& streams,
                          const std::vector<MatrixF>& frames, const VectorF& scores,
                          int left_out = -1);

  /// Learns from held-out trials: words against other words, and words against sounds, each as
  /// often as the other. With `background` the last feature alone tells other words: few words are
  /// left out in training, and what tells those apart holds for others less well. Without trials of
  /// a kind nothing is learned about it.
  static WordVerifier fit(const std::vector<VerifierTrial>& trials, bool background);

  /// Log odds that a word of the vocabulary was said, and neither another word nor a mere sound;
  /// higher is surer.
  [[nodiscard]] float verification_score(const VectorD& features) const;

  /// Weights of the features against other words (with background words: of the last one); empty
  /// where nothing was learned.
  [[nodiscard]] const VectorD& word_weights() const { return words_.weights(); }
  /// Weights of all features against sounds; empty where nothing was learned.
  [[nodiscard]] const VectorD& sound_weights() const { return sounds_.weights(); }

  void write(ModelFile& file, SequenceModelKind kind, bool background) const;
  /// Throws FormatError where the weights do not belong to these features. A file without
  /// a verifier gives one that has learned nothing.
  static WordVerifier read(const ModelFile& file, SequenceModelKind kind, bool background);

 private:
  LogisticRegression words_;
  LogisticRegression sounds_;
};

}  // namespace hri
