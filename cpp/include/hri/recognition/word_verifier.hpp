// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Was that one of the words at all? What the best word's alignment tells (how far it is ahead of a
// background model, of its rivals and of the states that fit best frame by frame, and whether its
// states last as long as they should) is weighed by a logistic regression, learned on held-out
// decisions against words left out of the vocabulary and against sounds that are no words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/logistic_regression.hpp"
#include "hri/recognition/sequence_models.hpp"

namespace hri {

/// What was said in a trial that a verifier learns from.
enum class TrialKind : std::uint8_t {
  word,      ///< a word that was recognised
  left_out,  ///< a word, decided upon without its own model
  non_word,  ///< a sound that is no word
};

struct VerifierTrial {
  VectorD features;
  TrialKind kind = TrialKind::word;
};

/// Immutable; const calls are safe from several threads. One that has learned nothing takes the
/// first feature for the evidence.
class WordVerifier {
 public:
  WordVerifier() = default;

  /// The features, in their order: "ratio", "rivals", and of hidden Markov models also "states",
  /// "length" and "pace".
  static std::vector<std::string> feature_names(SequenceModelKind kind);

  /// Features of the best word by `scores`. `streams` are the models that voted, `frames` what each
  /// heard. The class `left_out` (-1: none) is treated as if there were no such word.
  static VectorD features(const std::vector<const SequenceModels*>& streams,
                          const std::vector<MatrixF>& frames, const VectorF& scores,
                          int left_out = -1);

  /// Learns from held-out trials. Words count as much as all else together, and words left out as
  /// much as non-words. Without trials of both sorts nothing is learned.
  static WordVerifier fit(const std::vector<VerifierTrial>& trials);

  /// Log odds that a word of the vocabulary was said; higher is surer.
  [[nodiscard]] float evidence(const VectorD& features) const;

  /// Weight of every feature; empty where nothing was learned.
  [[nodiscard]] const VectorD& weights() const { return model_.weights(); }

  void write(ModelFile& file, SequenceModelKind kind) const;
  /// Throws FormatError where the weights do not belong to the features of `kind`. A file without
  /// a verifier gives one that has learned nothing.
  static WordVerifier read(const ModelFile& file, SequenceModelKind kind);

 private:
  LogisticRegression model_;
};

}  // namespace hri
