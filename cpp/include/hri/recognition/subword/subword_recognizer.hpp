// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Isolated words whose models are put together of sub-word units, such as phonemes, so that a word
// can be added by its spelling alone. Units are trained by embedded Baum-Welch: recordings of words
// and a pronunciation dictionary, no times (Young et al., "The HTK Book", sections 8.5 and 12.7).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/dictionary.hpp"
#include "hri/io/model_file.hpp"
#include "hri/language/word_emissions.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/decision.hpp"
#include "hri/recognition/training.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri {

struct HRI_API SubwordRecognizerOptions {
  WordRecognizerOptions words;
  int num_states = 2;
  int num_mixtures = 1;
  int num_passes = 4;
  double variance_floor = 1;
  int num_folds = 4;
  double false_reject_rate = 0.05;
  int num_word_folds = 5;
  double unrecorded_bonus = 0;
  double prior_frames = 3;
  int num_adaptations = 3;

  SubwordRecognizerOptions() { words.level_stream = false; }

  static constexpr const char* kName = "SubwordRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("words", o.words, any_value,
      "front end and warped copies as of isolated words; models and rejection are not used");
    v("num_states", o.num_states, within(1, 10), "left-right states of a unit, and of silence");
    v("num_mixtures", o.num_mixtures, within(1, 64), "Gaussians of a state");
    v("num_passes", o.num_passes, within(1, 100),
      "passes of embedded Baum-Welch with every number of Gaussians, which doubles from 1");
    v("variance_floor", o.variance_floor, above(0, 1),
      "share of the variance of all frames; wide Gaussians leave room for neighbours that a unit "
      "had not in training");
    v("num_folds", o.num_folds, within(0, 10),
      "groups of speakers that are held out for confidences and rejection at most; 0, 1: none, and "
      "no word is rejected");
    v("false_reject_rate", o.false_reject_rate, within(0, 0.5),
      "share of correct held-out words that the threshold may reject");
    v("num_word_folds", o.num_word_folds, within(0, 20),
      "groups of words that are left out, with speakers, to choose unrecorded_bonus; 0, 1: it is "
      "not chosen");
    v("unrecorded_bonus", o.unrecorded_bonus, within(0, 1000),
      "added to the score of words added without recordings, as units fit the words better that "
      "they were trained on");
    v("prior_frames", o.prior_frames, above(0, 1e6),
      "recordings of an added word move the means of its units from their own, which weigh as "
      "much as so many frames");
    v("num_adaptations", o.num_adaptations, within(1, 100), "passes in which they do");
  }
};

/// Models of units, silence among them.
struct HRI_API UnitModels {
  static constexpr const char* kSilence = "sil";

  std::vector<std::string> names;
  std::vector<GaussianMixtureHmm> models;  ///< left-right without skips
  std::vector<double> final_stays;         ///< probability to stay in the last state

  /// -1 where there is none.
  [[nodiscard]] int find(const std::string& name) const;
};

namespace detail {
class SentenceFrontEnd;
}

/// Immutable; const calls are safe from several threads. Copies share their front end and models.
class HRI_API SubwordRecognizer {
 public:
  /// Between a word and a number in the names of units that are its own.
  static constexpr char kOwnUnit = '/';

  /// From trained parts; a word may have several pronunciations in `lexicon`, and those in
  /// `unrecorded` were added without recordings. Throws InvalidArgument for fewer than two words,
  /// units that are not in `units`, or not left-right without skips, models of another dimension
  /// than the front end, unrecorded words that are not in the lexicon, and options out of range.
  SubwordRecognizer(const SubwordRecognizerOptions& options, htk::Dictionary lexicon,
                    UnitModels units, const Calibration& calibration,
                    std::vector<std::string> unrecorded = {});

  /// Trains units on recordings of words; of `lexicon` it takes those that are recorded, and for
  /// training the first pronunciation of each. Throws InvalidArgument for a word that the lexicon
  /// has not, a unit named kSilence or with kOwnUnit in it, a recording that is not finite or too
  /// short (named), and a label without speech; Interrupted.
  static SubwordRecognizer train(const std::vector<WordSample>& samples,
                                 const htk::Dictionary& lexicon,
                                 const SubwordRecognizerOptions& options,
                                 const TrainingProgress& progress = {},
                                 const StopCheck& should_stop = {});

  /// With one word more, by its pronunciations. With `samples` of it, it gets units of its own: the
  /// means move towards the recordings (maximum a posteriori; Gauvain and Lee, IEEE Trans. Speech
  /// and Audio Proc. 2(2), 1994, eq. 25), along the first pronunciation. All else stays as it is.
  /// Throws InvalidArgument for a label that there is already, no pronunciation, units without a
  /// model (named), and recordings without speech or too short for it; Interrupted.
  [[nodiscard]] SubwordRecognizer with_word(
      const std::string& label, const std::vector<std::vector<std::string>>& pronunciations,
      const std::vector<WordSample>& samples = {}, const StopCheck& should_stop = {}) const;
  /// Throws InvalidArgument for a label that it does not have, or where fewer than two were left.
  [[nodiscard]] SubwordRecognizer without_word(const std::string& label) const;

  static SubwordRecognizer load(const std::string& path);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static SubwordRecognizer from_model_file(const ModelFile& file);

  /// Recognises one word. NBest::log_score and Decision::score are scores(). Throws InvalidArgument
  /// for audio that is not finite, and rates outside 1000..384000 Hz.
  [[nodiscard]] Decision recognise(Span<const float> audio, int sample_rate_hz) const;
  /// Of every label: the log probability of the best path through the best pronunciation, less that
  /// of the best states of the units in any order, a frame; unrecorded words have their bonus on
  /// top. Empty without speech.
  [[nodiscard]] VectorF scores(Span<const float> audio, int sample_rate_hz) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const SubwordRecognizerOptions& options() const { return options_; }
  [[nodiscard]] const htk::Dictionary& lexicon() const { return lexicon_; }
  [[nodiscard]] const UnitModels& units() const { return units_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  /// Words that were added without recordings.
  [[nodiscard]] const std::vector<std::string>& unrecorded() const { return unrecorded_; }

 private:
  // A pronunciation between silences: columns of the emissions, and how each state is left.
  struct Path {
    int label = 0;
    double log_weight = 0;
    std::vector<int> columns;
    std::vector<float> log_stay;
    std::vector<float> log_go;
  };

  static SubwordRecognizer read(const ModelFile& file);
  void add_path(const htk::Pronunciation& entry);
  [[nodiscard]] VectorF scores_of(ConstMatrixRefF frames) const;

  SubwordRecognizerOptions options_;
  htk::Dictionary lexicon_;  // sorted by word
  std::vector<std::string> labels_;
  UnitModels units_;
  Calibration calibration_;
  std::vector<std::string> unrecorded_;
  VectorF bonuses_;  // of every label
  std::shared_ptr<const detail::SentenceFrontEnd> front_end_;
  std::shared_ptr<const GaussianEmissions> emissions_;
  std::vector<int> first_columns_;   // of every unit
  std::vector<int> shared_columns_;  // of units that are not those of a single word
  std::vector<Path> paths_;
};

}  // namespace hri
