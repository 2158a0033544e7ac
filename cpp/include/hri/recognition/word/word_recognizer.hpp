// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Isolated words: audio -> end points -> cepstra -> one sequence model a word -> Decision (thesis
// section 6.2).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/io/model_file.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/decision.hpp"
#include "hri/recognition/sequence_models.hpp"
#include "hri/recognition/training.hpp"
#include "hri/recognition/word/word_verifier.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

struct WordRecognizerOptions {
  WordRecognizerOptions() {
    cepstra.sample_rate_hz = 0;
    activity.padding_ms = 60;
  }

  CepstraOptions
      cepstra;  ///< sample_rate_hz 0 (default) takes the lowest training rate, at most 16000
  ActivityOptions activity;     ///< how the word is found in the clip
  SequenceModelOptions models;  ///< the models trained on each stream
  bool trim = true;      ///< cut the clip to the word and activity.padding_ms before and after it
  double floor_db = 45;  ///< of a word that is cut: noise this far below its peak, under which
                         ///< quiet rooms and digital silence are the same, 20..120
  bool level_stream = true;  ///< a second stream votes, whose cepstra are normalised in level only
  int num_warps = 3;         ///< training copies with warped frequency axis: 1 (none), 3 or 5
  int noise_copies = 2;  ///< training copies of every word with noise added, warped in turn, 0..10
  double noise_low_db = 10;   ///< least signal-to-noise ratio of these copies, -20..100
  double noise_high_db = 25;  ///< and the largest; each copy has its own, at random
  double warp_step = 0.08;    ///< step of the warp factor between copies, 0..0.2
  double false_reject_rate =
      0.02;  ///< share of correct held-out words that the threshold may reject, 0..0.5
};

/// A front end and the models trained on it; several vote by adding their log scores.
struct WordStream {
  CepstraComputer cepstra;
  SequenceModels models;
};

/// One training word. `group` is the speaker: calibration holds whole groups out.
struct WordSample {
  Span<const float> samples;  ///< mono, -1..1, at `sample_rate_hz`
  int sample_rate_hz = 16000;
  std::string label;
  std::string group;
};

/// Immutable once made; const calls are safe from several threads.
class HRI_API WordRecognizer {
 public:
  /// Trains one model a label. `background` are words outside the vocabulary, of any speakers: they
  /// are learned as what else may be said, for rejection alone (models of the kind hmm; ptbhmm
  /// leaves them aside). Throws InvalidArgument for NaN (with sample index), audio without a
  /// word, a label with no usable sample; Interrupted when `should_stop` says so. Labels are kept
  /// in sorted order.
  static WordRecognizer train(const std::vector<WordSample>& samples,
                              const WordRecognizerOptions& options,
                              const TrainingProgress& progress = {},
                              const StopCheck& should_stop = {},
                              const std::vector<WordSample>& background = {});

  /// This recogniser with one word more, learned from few recordings (from one on, all of one
  /// label) and from what the words it has tell of words. Their models stay as they are, to the
  /// bit, and so does the calibration. Throws InvalidArgument for no recording, one without speech
  /// (names it), labels that differ or that the recogniser has already; Interrupted.
  [[nodiscard]] WordRecognizer with_word(const std::vector<WordSample>& samples,
                                         const StopCheck& should_stop = {}) const;
  /// The same without a word. Throws InvalidArgument for a label that it does not have, or where
  /// fewer than two would be left.
  [[nodiscard]] WordRecognizer without_word(const std::string& label) const;

  static WordRecognizer load(const std::string& path);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static WordRecognizer from_model_file(const ModelFile& file);

  /// Recognises one utterance; other sample rates are resampled and said so in Decision::notes.
  /// Score is the log odds that a word of the vocabulary was said (word_verifier.hpp).
  [[nodiscard]] Decision recognise(Span<const float> samples, int sample_rate_hz) const;

  /// Raw score of every label for one utterance (log-likelihood or log-possibility), without end
  /// points or rejection beyond `trim`. Throws InvalidArgument "too short" for less than one frame.
  [[nodiscard]] VectorF scores(Span<const float> samples, int sample_rate_hz) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const WordRecognizerOptions& options() const { return options_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  [[nodiscard]] const WordVerifier& verifier() const { return verifier_; }

 private:
  WordRecognizer(const WordRecognizerOptions& options, std::vector<std::string> labels);
  static WordRecognizer read(const ModelFile& file);

  /// The word in the clip at the model's rate; empty when nobody speaks.
  [[nodiscard]] std::vector<float> locate(Span<const float> samples, int sample_rate_hz,
                                          std::vector<std::string>* notes) const;
  /// Recognises, and tells the frames of every stream; none where nobody speaks.
  [[nodiscard]] Decision recognise(Span<const float> samples, int sample_rate_hz,
                                   std::vector<MatrixF>* frames) const;
  /// The frames of `word` for every stream.
  [[nodiscard]] std::vector<MatrixF> frames(Span<const float> word) const;
  [[nodiscard]] VectorF score(const std::vector<MatrixF>& frames) const;
  [[nodiscard]] float verification_score(const std::vector<MatrixF>& frames,
                                         const VectorF& scores) const;
  /// What the verifier weighs; as if there were no class `left_out` (-1: none).
  [[nodiscard]] VectorD features(const std::vector<MatrixF>& frames, const VectorF& scores,
                                 int left_out = -1) const;

  friend class SpeakerAdapter;
  friend class WordFrames;
  friend class WordTrainer;

  WordRecognizerOptions options_;
  std::vector<std::string> labels_;
  std::vector<WordStream> streams_;
  WordVerifier verifier_;
  Calibration calibration_;
};

}  // namespace hri
