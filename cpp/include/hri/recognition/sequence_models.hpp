// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// One sequence model a class over one stream of frames; a garbage model of all classes: what words
// and movements share; and, where there are any, models of background words: what else is said.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/adaptation/linear_adaptation.hpp"
#include "hri/models/adaptation/map_adaptation.hpp"
#include "hri/models/codebook/codebook.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"

namespace hri {

enum class SequenceModelKind : std::uint8_t {
  hmm,     ///< Gaussian-mixture HMM a class, forward score
  ptbhmm,  ///< vector quantisation and the possibility-theory HMM set, product conjunction
};

struct SequenceModelOptions {
  SequenceModelKind model = SequenceModelKind::hmm;
  int num_states = 8;       ///< left-right states a class, 1..64
  int num_mixtures = 1;     ///< Gaussians a state (hmm), 1..64
  int num_codewords = 128;  ///< codebook size (ptbhmm), 2..4096
  int garbage_mixtures =
      16;  ///< Gaussians of the garbage model that rejection compares with (hmm), 1..256
  int max_iterations = 12;  ///< Baum-Welch iterations, 1..1000
  std::uint64_t seed = 0;
};

/// How models are adapted to a speaker, a microphone or a room: first all of them together
/// (linear_adaptation.hpp), then each to its own words (map_adaptation.hpp).
struct AdaptationOptions {
  double shared_frames = 400;  ///< imagined frames that hold the common change back, > 0
  double prior_frames = 5;     ///< frames a state that weigh as much as the training, > 0
  int num_iterations = 3;      ///< EM iterations of the second part, 1..1000
  bool each_word = true;       ///< false leaves the second part out
  StopCheck should_stop;
};

/// Immutable but for `train`; const calls are safe from several threads.
class HRI_API SequenceModels {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit SequenceModels(const SequenceModelOptions& options);

  /// Replaces the models; `per_label[c]` holds the frames of every sample of class c.
  void train(const std::vector<std::vector<MatrixF>>& per_label, const StopCheck& should_stop);

  /// These models adapted to new data: `per_label[c]` holds the frames of the new samples of class
  /// c, which may be none. The garbage model follows them all, so that ratios to it stay what they
  /// were. Throws InvalidArgument for models that cannot adapt (ptbhmm).
  [[nodiscard]] SequenceModels adapted(const std::vector<std::vector<MatrixF>>& per_label,
                                       const AdaptationOptions& options) const;

  /// These models with one class more, which gets the number `index`, from the frames of few
  /// recordings and their copies (few_samples.hpp). Codebook and garbage model stay.
  [[nodiscard]] SequenceModels with_class(int index, const std::vector<MatrixF>& sequences,
                                          int num_recordings, const StopCheck& should_stop) const;
  /// These models without one class, of two or more.
  [[nodiscard]] SequenceModels without_class(int index) const;

  /// Replaces the models of background words, which no score tells of but `background_scores`;
  /// `per_word[w]` holds the frames of every sample of one. Throws InvalidArgument for ptbhmm.
  void train_background(const std::vector<std::vector<MatrixF>>& per_word,
                        const StopCheck& should_stop);

  /// Log score of every class (natural log; -1e30 for impossible), shape (num_classes,).
  [[nodiscard]] VectorF scores(ConstMatrixRefF frames) const;

  /// What the best class is compared with for rejection, in the unit of `scores`.
  [[nodiscard]] float garbage_score(ConstMatrixRefF frames) const;

  /// Log score of every background word, shape (num_background,).
  [[nodiscard]] VectorF background_scores(ConstMatrixRefF frames) const;
  [[nodiscard]] int num_background() const { return static_cast<int>(background_.size()); }

  /// One a class; empty for ptbhmm.
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& hmms() const { return hmms_; }

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError where the models do not fit `num_classes` or frames of `dim` columns.
  void read(const ModelFile& file, const std::string& prefix, int num_classes, int dim);

 private:
  [[nodiscard]] std::vector<GaussianMixtureHmm> hmms_of(
      const std::vector<std::vector<MatrixF>>& per_label, const StopCheck& should_stop) const;
  void train_hmms(const std::vector<std::vector<MatrixF>>& per_label, const StopCheck& should_stop);
  [[nodiscard]] std::vector<SymbolSequence> quantised(const std::vector<MatrixF>& sequences) const;
  void train_ptbhmm(const std::vector<std::vector<MatrixF>>& per_label,
                    const StopCheck& should_stop);

  SequenceModelOptions options_;
  std::vector<GaussianMixtureHmm> hmms_;        // one a class, model == hmm
  std::vector<GaussianMixture> garbage_;        // one, model == hmm
  std::vector<GaussianMixtureHmm> background_;  // one a background word, model == hmm
  std::vector<Codebook> codebook_;              // one, model == ptbhmm
  std::vector<PossibilisticHmmSet> ptbhmm_;     // one, model == ptbhmm
};

}  // namespace hri
