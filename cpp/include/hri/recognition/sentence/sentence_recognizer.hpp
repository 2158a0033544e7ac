// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sentences of signs, from tracks of both hands or from features of one: HMMs or
// possibility-theory HMMs of words, one of what lies between words (rest, and the movement from one
// sign to the next), a bigram of the sentences trained on, decoded in one pass (ConnectedDecoder).
// A word has variants, one for each of its recordings, as it may have several pronunciations in
// speech: few recordings of a sign differ too much for one model.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/two_hand_features.hpp"
#include "hri/io/model_file.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/ngram_model.hpp"
#include "hri/language/word_emissions.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/training.hpp"

namespace hri {

/// What a sentence is given as.
enum class SentenceInput : std::uint8_t {
  tracks,  ///< places of both hands and of the head, kNumTwoHandTrackColumns
  rows,    ///< features of one hand or two, whatever they are; NaN in a frame without a hand
};
constexpr auto enum_names(SentenceInput) { return std::array{"tracks", "rows"}; }

struct HRI_API SentenceRecognizerOptions {
  SentenceInput input = SentenceInput::tracks;
  TwoHandFeatureOptions features;
  SequenceModelKind model = SequenceModelKind::hmm;
  int num_codewords = 64;
  int frames_per_state = 3;
  int max_states = 8;
  int max_iterations = 8;
  int margin_frames = 1;
  int max_variant_frames = 1200;
  double variant_weight = 0.6;
  double variant_variance = 0.7;
  int between_states = 2;
  int between_mixtures = 2;
  int language_order = 2;
  bool choose_weights = true;
  double known_language_scale = 1;
  ConnectedDecoderOptions decoder;
  std::uint64_t seed = 0;

  static constexpr const char* kName = "SentenceRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("input", o.input, any_value, "what sentences are given as");
    v("features", o.features, any_value,
      "what is computed of the tracks; of rows, only deltas are appended");
    v("model", o.model, any_value,
      "kind of the models; ptbhmm: the same densities as possibilities over codewords");
    v("num_codewords", o.num_codewords, within(2, 4096),
      "codewords of every column of the features (ptbhmm)");
    v("frames_per_state", o.frames_per_state, within(0, 100),
      "a word has a state for so many frames of its mean length; 0: 2, 3 or 4, chosen on sentences "
      "held out");
    v("max_states", o.max_states, within(1, 64), "left-right states of a word, at most");
    v("max_iterations", o.max_iterations, within(1, 100000),
      "iterations of Viterbi training at most");
    v("margin_frames", o.margin_frames, within(0, 100),
      "frames before and behind its span that count as a word's");
    v("max_variant_frames", o.max_variant_frames, within(0, 1000000),
      "frames, of all together at most, of those recordings of a word that have a model of their "
      "own, of a state a frame; 0: one model a word");
    v("variant_weight", o.variant_weight, within(0, 1),
      "where the mean of such a state lies: 0 at that of the word's state, 1 at the frame");
    v("variant_variance", o.variant_variance, within(1e-3, 1e3),
      "factor on the variances of the word's states in its variants");
    v("between_states", o.between_states, within(1, 16),
      "ergodic states of what lies between words: rest and movement");
    v("between_mixtures", o.between_mixtures, within(1, 64), "Gaussians of each of them");
    v("language_order", o.language_order, within(0, 2),
      "words of an n-gram of the sentences trained on; 0: any word may follow any");
    v("choose_weights", o.choose_weights, any_value,
      "decoder.insertion_penalty, decoder.language_scale and known_language_scale are chosen on "
      "sentences held out");
    v("known_language_scale", o.known_language_scale, within(0, 1e6),
      "factor on the log probabilities of words whose frames are known");
    v("decoder", o.decoder, any_value, "how sentences are searched");
    v("seed", o.seed, any_seed, "of the start of training by k-means");
  }
};

/// Frames first up to last, last excluded, of a word of a sentence.
struct SignedWordSpan {
  std::string label;
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;
};

/// A recording of a word that has a model of its own.
struct SignVariant {
  int word = 0;             ///< number of its label
  MatrixF frames;           ///< (num_frames, num_features)
  std::vector<int> states;  ///< of the word's HMM, one a frame
};

/// How far hands are from the head, all but a twentieth of the frames, in lengths of the signer: of
/// who shows one hand alone, the length is measured by it. 0: not known.
struct HandReaches {
  double right = 0;
  double left = 0;
};

/// A sentence to train on. Words are in the order of time; they may overlap by some frames.
struct SignedSample {
  /// (num_frames, kNumTwoHandTrackColumns), see TwoHandFeatureComputer; or rows of features of as
  /// many columns in every sentence, all NaN in a frame that shows no hand: those of the frame
  /// before stay, at the beginning those of the first frame that has some.
  MatrixF tracks;
  /// Of the signer; 0: hand_scale_px() of the tracks, and where they show one hand alone, by how
  /// far it reaches in the other sentences. Rows have none: 0.
  double scale_px = 0;
  std::vector<SignedWordSpan> words;
  std::string group;  ///< signer or session: never both trained on and held out
  std::string name;   ///< what errors call it
};

struct RecognisedSign {
  std::string label;
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  double log_score = 0;         ///< what it adds to the sentence's
};

struct RecognisedSentence {
  std::vector<RecognisedSign> words;
  double log_score = 0;  ///< natural log, of the best path

  /// The words, with spaces between.
  [[nodiscard]] std::string text() const;
};

/// A sentence as models score it.
struct ScoredSentence {
  MatrixF log_emissions;  ///< (num_frames, states of all models that are searched)
};

/// Immutable; const calls are safe from several threads. Copies share their models.
class HRI_API SentenceRecognizer {
 public:
  /// From trained parts: `models` are left-right ones of the sorted `labels` and behind them the
  /// one of what lies between; `final_stays` the probability of each word to stay in its last
  /// state, and of what lies between to go on; `language` may be null; `codebook` is that of the
  /// kind ptbhmm; `variants`, in the order of their words, take the place of the models of these;
  /// `reaches` are those of the sentences trained on.
  /// Throws InvalidArgument for parts that do not fit each other, and options out of
  /// range.
  SentenceRecognizer(const SentenceRecognizerOptions& options, std::vector<std::string> labels,
                     std::vector<GaussianMixtureHmm> models, const VectorD& final_stays,
                     std::shared_ptr<const NGramModel> language,
                     std::optional<MultiStreamCodebook> codebook = std::nullopt,
                     std::vector<SignVariant> variants = {}, const HandReaches& reaches = {});

  /// A hand that a sentence never shows is where it is on average in the others; where no sentence
  /// shows the left hand, features.use_left of options() is false. Throws InvalidArgument (naming
  /// the sentence) for tracks that TwoHandFeatureComputer refuses, no right hand in all sentences,
  /// rows that are none, differ in their columns, show no hand, or are NaN in part or infinite,
  /// words outside the frames, empty or not in the order of time, labels with white space in them,
  /// and where all frames lie in words; Interrupted.
  static SentenceRecognizer train(const std::vector<SignedSample>& samples,
                                  const SentenceRecognizerOptions& options,
                                  const TrainingProgress& progress = {},
                                  const StopCheck& should_stop = {});

  /// The same with other options of the decoder. Throws InvalidArgument for values out of range.
  [[nodiscard]] SentenceRecognizer with_decoder(const ConnectedDecoderOptions& decoder) const;
  /// The same with another scale of the language model where frames are known.
  [[nodiscard]] SentenceRecognizer with_known_language_scale(double scale) const;

  static SentenceRecognizer load(const std::string& path);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static SentenceRecognizer from_model_file(const ModelFile& file);

  /// The sentence that tracks (num_frames, kNumTwoHandTrackColumns) or rows show; `scale_px` as in
  /// training (0: of the tracks). Of a hand that no frame shows, nothing is compared: densities are
  /// those of the other features, marginalised over its own. Throws InvalidArgument as train()
  /// does.
  [[nodiscard]] RecognisedSentence recognise(ConstMatrixRefF tracks, double scale_px = 0) const;
  /// The same in two steps: the scores of a sentence do not depend on how it is searched.
  [[nodiscard]] ScoredSentence score(ConstMatrixRefF tracks, double scale_px = 0) const;
  /// Throws InvalidArgument for scores of another recogniser.
  [[nodiscard]] RecognisedSentence recognise(const ScoredSentence& scored) const;
  /// At most `count` (1..1000) sentences that differ in their words, the best first; none where no
  /// sentence covers all frames. Throws InvalidArgument as train() does, for other counts, and for
  /// more than 64 million states times frames.
  [[nodiscard]] std::vector<RecognisedSentence> recognise_n_best(ConstMatrixRefF tracks, int count,
                                                                 double scale_px = 0) const;
  /// What is best so far of a sentence that goes on: its last word may be one that has not ended.
  /// Throws InvalidArgument as train() does.
  [[nodiscard]] RecognisedSentence recognise_begun(ConstMatrixRefF tracks,
                                                   double scale_px = 0) const;
  /// The same where the frames of the words are known: one word for each of `spans`, whose labels
  /// are not read; with_language false: each by itself. Throws InvalidArgument as train() does.
  [[nodiscard]] RecognisedSentence recognise_spans(ConstMatrixRefF tracks,
                                                   const std::vector<SignedWordSpan>& spans,
                                                   double scale_px = 0,
                                                   bool with_language = true) const;
  /// Log scores (num_spans, num_labels) of every label in every span. Throws InvalidArgument for
  /// scores of another recogniser, and spans that train() refuses.
  [[nodiscard]] MatrixD score_spans(const ScoredSentence& scored,
                                    const std::vector<SignedWordSpan>& spans) const;
  /// The best words for spans with such scores. Throws InvalidArgument for shapes that do not fit.
  [[nodiscard]] RecognisedSentence best_of_spans(const MatrixD& scores,
                                                 const std::vector<SignedWordSpan>& spans,
                                                 bool with_language = true) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const SentenceRecognizerOptions& options() const { return options_; }
  /// nullptr: there is none.
  [[nodiscard]] const std::shared_ptr<const NGramModel>& language() const { return language_; }
  /// Of the labels, and of what lies between.
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& models() const { return *models_; }
  [[nodiscard]] const VectorD& final_stays() const { return final_stays_; }
  [[nodiscard]] const std::vector<SignVariant>& variants() const { return *variants_; }
  [[nodiscard]] const HandReaches& reaches() const { return reaches_; }

 private:
  static SentenceRecognizer read(const ModelFile& file);
  void check_variants() const;
  [[nodiscard]] std::vector<GaussianMixtureHmm> make_chains();
  [[nodiscard]] VectorD scores_of(ConstMatrixRefF of_states) const;
  [[nodiscard]] MatrixD language_table() const;
  [[nodiscard]] ConnectedDecoder decoder_behind(const ScoredSentence& scored) const;
  [[nodiscard]] std::vector<DecodedWord> named(std::vector<DecodedWord> words) const;
  [[nodiscard]] RecognisedSentence sentence_of(double log_score,
                                               const std::vector<DecodedWord>& words) const;

  SentenceRecognizerOptions options_;
  std::vector<std::string> labels_;
  VectorD final_stays_;
  HandReaches reaches_;
  std::shared_ptr<const std::vector<GaussianMixtureHmm>> models_;
  std::shared_ptr<const std::vector<SignVariant>> variants_;
  // Of what is searched: the variants of a word, or the model of one without; what lies between.
  std::shared_ptr<const GaussianEmissions> emissions_;
  std::shared_ptr<const CodedPossibilities> possibilities_;  // of the kind ptbhmm
  std::vector<WordChain> chains_;
  std::vector<int> words_;  // number of the label of each, of what lies between one more
  std::shared_ptr<const NGramModel> language_;
  std::shared_ptr<const WordNetwork> network_;
};

}  // namespace hri
