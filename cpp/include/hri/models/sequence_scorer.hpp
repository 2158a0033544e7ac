// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scores a sequence of feature frames against one sequence model a class: Gaussian-mixture hidden
// Markov models or possibility-theory HMMs behind one interface, for words and for gestures.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

enum class SequenceModelKind : std::uint8_t {
  hmm,     ///< Gaussian-mixture HMM a class, forward score
  ptbhmm,  ///< vector quantisation and the possibility-theory HMM set, product conjunction
};
constexpr auto enum_names(SequenceModelKind) { return std::array{"hmm", "ptbhmm"}; }

struct SequenceModelOptions {
  SequenceModelKind model = SequenceModelKind::hmm;
  int num_states = 8;
  int num_mixtures = 1;
  int num_codewords = 128;
  int garbage_mixtures = 16;
  int max_iterations = 12;
  std::uint64_t seed = 0;

  static constexpr const char* kName = "SequenceModelOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("model", o.model, any_value, "kind of the models");
    v("num_states", o.num_states, within(1, 64), "left-right states a class");
    v("num_mixtures", o.num_mixtures, within(1, 64).or_zero(),
      "Gaussians a state (hmm); 0: of words one for every two speakers, 1 to 4; else 1");
    v("num_codewords", o.num_codewords, within(2, 4096), "size of the codebook (ptbhmm)");
    v("garbage_mixtures", o.garbage_mixtures, within(1, 256),
      "Gaussians of the garbage model that rejection compares with (hmm)");
    v("max_iterations", o.max_iterations, within(1, 1000), "iterations of Baum-Welch at most");
    v("seed", o.seed, any_seed, "of everything random in training");
  }
};

/// Adaptation to a speaker, a microphone or a room: first one linear transform of all models
/// (linear_adaptation.hpp), then maximum a posteriori estimation of each (map_adaptation.hpp).
struct AdaptationOptions {
  double shared_frames = 400;
  double prior_frames = 5;
  int num_iterations = 3;
  bool each_class = true;
  StopCheck should_stop;

  static constexpr const char* kName = "AdaptationOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("shared_frames", o.shared_frames, above(0, 1e12),
      "imagined frames that hold the common change back in each of two passes, of which the second "
      "starts from the first: of as many real frames, three quarters of the change come through, "
      "not half");
    v("prior_frames", o.prior_frames, above(0, 1e12),
      "frames a state that weigh as much as the training");
    v("num_iterations", o.num_iterations, within(1, 1000), "EM iterations of the second part");
    v("each_class", o.each_class, any_value, "False leaves the second part out");
  }
};

/// How the best path of one class explains a sequence.
struct PathFit {
  /// Sum over frames of the log density in the aligned state, less the mean of the densities in
  /// the best states of all classes.
  double state_margin = 0;
  double log_duration_ratio =
      0;  ///< log of the duration before the last state over its expectation
  double duration_deviation = 0;  ///< sum over states of |log of the duration over its expectation|
  int num_states = 0;             ///< states in that sum
};

/// Training sequences of every class: `sequences[c]` holds the frames of the samples of class c.
using ClassSequences = std::vector<std::vector<MatrixF>>;

/// HMMs of words outside the vocabulary, one a word, for rejection.
using FillerModels = std::vector<GaussianMixtureHmm>;

/// Immutable; const calls are safe from several threads.
class HRI_API SequenceScorer {
 public:
  SequenceScorer() = default;
  SequenceScorer(const SequenceScorer&) = delete;
  SequenceScorer& operator=(const SequenceScorer&) = delete;
  virtual ~SequenceScorer() = default;

  [[nodiscard]] virtual SequenceModelKind kind() const = 0;
  [[nodiscard]] virtual int num_classes() const = 0;

  /// Log score of every class (natural log; -1e30 for impossible), shape (num_classes,).
  [[nodiscard]] virtual VectorF scores(ConstMatrixRefF frames) const = 0;
  /// Score of the garbage model, in the unit of scores().
  [[nodiscard]] virtual float garbage_score(ConstMatrixRefF frames) const = 0;
  /// Log score of every filler model, shape (num_fillers,).
  [[nodiscard]] virtual VectorF filler_scores(ConstMatrixRefF /*frames*/) const { return {}; }
  [[nodiscard]] virtual int num_fillers() const { return 0; }

  /// Whether the models align frames with states, so that path_fit() can be called.
  [[nodiscard]] virtual bool has_paths() const { return false; }
  /// How the best path of class `index` fits, as if there were no class `left_out` (-1: none).
  /// Throws InvalidArgument for models without paths.
  [[nodiscard]] virtual PathFit path_fit(ConstMatrixRefF frames, int index, int left_out) const;

  // What trains is not virtual, so that a program that only recognises does not link it.

  /// A scorer adapted to `sequences`, of which a class may have none. The garbage model and the
  /// fillers follow, so that ratios to them stay comparable. Throws InvalidArgument for models that
  /// cannot adapt (ptbhmm).
  [[nodiscard]] std::shared_ptr<const SequenceScorer> adapted(
      const ClassSequences& sequences, const AdaptationOptions& options) const;
  /// A scorer with one class more, of number `index`, from the frames of few recordings and their
  /// augmented copies (few_samples.hpp). Everything else stays as it is, to the bit.
  [[nodiscard]] std::shared_ptr<const SequenceScorer> with_class(
      int index, const std::vector<MatrixF>& sequences, int num_recordings,
      const StopCheck& should_stop) const;
  /// A scorer without class `index`, of two or more.
  [[nodiscard]] virtual std::shared_ptr<const SequenceScorer> without_class(int index) const = 0;

  virtual void write(ModelFile& file, const std::string& prefix) const = 0;
};

/// Trains one model a class, no class empty. Throws InvalidArgument for options out of range and
/// for fillers where the kind is ptbhmm, which cannot compare with them; Interrupted.
HRI_API std::shared_ptr<const SequenceScorer> train_sequence_scorer(
    const ClassSequences& sequences, const SequenceModelOptions& options,
    const StopCheck& should_stop, const FillerModels& fillers = {});

/// Trains one filler model a word; `sequences[w]` holds the frames of word w.
HRI_API FillerModels train_fillers(const ClassSequences& sequences,
                                   const SequenceModelOptions& options,
                                   const StopCheck& should_stop);

/// Throws FormatError where the models do not fit `num_classes` or frames of `dim` columns.
HRI_API std::shared_ptr<const SequenceScorer> read_sequence_scorer(
    const ModelFile& file, const std::string& prefix, const SequenceModelOptions& options,
    int num_classes, int dim);

}  // namespace hri
