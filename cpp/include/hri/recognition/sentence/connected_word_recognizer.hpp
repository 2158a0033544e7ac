// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected words, trained on isolated ones: recordings of each speaker are joined to strings whose
// word boundaries are known, and one HMM a word and one of silence are trained on the frames of
// these strings, or as many possibility-theory HMMs. Cepstra are normalised over the utterance, so
// that a model trained on words by themselves would meet other cepstra in a sentence; here training
// and decoding see the same.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/grammar.hpp"
#include "hri/language/lattice.hpp"
#include "hri/language/ngram_model.hpp"
#include "hri/language/word_emissions.hpp"
#include "hri/models/classifiers/softmax_regression.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "hri/recognition/training.hpp"
#include "hri/recognition/word/speech_embedding.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "hri/signal/activity_meter.hpp"

namespace hri {

struct HRI_API ConnectedWordRecognizerOptions {
  WordRecognizerOptions words;
  int silence_states = 3;
  int silence_mixtures = 4;
  int max_words = 7;
  double max_pause_ms = 300;
  int num_alignments = 1;
  bool choose_penalty = true;
  double confidence_scale = 0.02;
  double min_confidence = 0;
  bool unknown_words = false;
  int unknown_rank = 16;
  double unknown_lead = 12;
  double unknown_margin = 1;
  ConnectedDecoderOptions decoder;
  LatticeOptions lattice{1000, 200000};

  static constexpr const char* kName = "ConnectedWordRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("words", o.words, any_value,
      "front end, models and augmentation as of isolated words; ptbhmm: the same densities as "
      "possibilities over codewords, num_codewords for every column of the features; front_end "
      "both: words of a first search are named anew by a pretrained speech embedding; what these "
      "reject words by is not used");
    v("silence_states", o.silence_states, within(1, 64), "left-right states of silence");
    v("silence_mixtures", o.silence_mixtures, within(1, 64), "Gaussians of each of them");
    v("max_words", o.max_words, within(1, 100),
      "words of the strings that are trained on, at most");
    v("max_pause_ms", o.max_pause_ms, within(0, 10000), "longest pause in these strings");
    v("num_alignments", o.num_alignments, within(0, 10),
      "times that the boundaries of words are moved to where the models put them, and the models "
      "trained again");
    v("choose_penalty", o.choose_penalty, any_value,
      "decoder.insertion_penalty, confidence_scale, unknown_lead and, where it is 0, "
      "words.embedding_weight are chosen on strings of speakers held out");
    v("confidence_scale", o.confidence_scale, within(1e-6, 1),
      "factor on log scores in confidences, as neighbouring frames do not score independently");
    v("min_confidence", o.min_confidence, within(0, 1),
      "words of less confidence are marked unknown");
    v("unknown_words", o.unknown_words, any_value,
      "sounds that fit no word of the vocabulary become words marked unknown");
    v("unknown_rank", o.unknown_rank, within(1, 1000),
      "states that an unknown word's score in a frame is the mean of, the best of all words and "
      "filler words");
    v("unknown_lead", o.unknown_lead, within(0, 1e6),
      "how far the best state of the words lies above this mean on average, before the speaker is "
      "known");
    v("unknown_margin", o.unknown_margin, within(0, 1000),
      "an unknown word scores as much below the average of the best states, as a share of "
      "unknown_lead; larger: fewer words are unknown");
    v("decoder", o.decoder, any_value, "how sentences are searched");
    v("lattice", o.lattice, any_value, "which other sentences are kept, for confidences");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

struct TranscribedWord {
  static constexpr const char* kUnknown = "<unk>";
  static constexpr const char* kSilence = "<sil>";  ///< in lattices; it is in no transcript

  std::string label;     ///< kUnknown: no word of the vocabulary fits
  double first_s = 0;    ///< from the beginning of the recording; where its sound begins
  double last_s = 0;     ///< where it ends, beside a pause by the rule of find_speech()
  double log_score = 0;  ///< what it adds to the transcript's
  /// How probable it is that this word was said here, by the other sentences that might have been;
  /// nothing where it was not asked for, or the recording is too long for a lattice.
  std::optional<double> confidence;
  bool unknown = false;  ///< label is kUnknown, or confidence below min_confidence
};

/// Another sentence that might have been said.
struct TranscriptAlternative {
  std::vector<TranscribedWord> words;  ///< without confidence
  double log_score = 0;
};

struct Transcript {
  std::vector<TranscribedWord> words;
  /// As many as were asked for, the best first, which is `words`; they differ in their words.
  std::vector<TranscriptAlternative> alternatives;
  Slots slots;                     ///< of the grammar, where all words are known
  double log_score = 0;            ///< natural log, of the best path; 0 without speech
  bool complete = true;            ///< false: too short for so many words, these are what was found
  std::vector<std::string> notes;  ///< what was converted or assumed on the way

  /// The words, with spaces between; kUnknown for those that are unknown.
  [[nodiscard]] std::string text() const;
};

/// What is known of a recording before, and wanted of it.
struct TranscriptionQuery {
  int num_words = 0;         ///< 1..1000: so many, in any order, without language model and grammar
  int num_alternatives = 0;  ///< 0..1000
  bool confidences = true;   ///< of the words
};

/// A recording as models score it.
struct ScoredRecording {
  MatrixF log_emissions;  ///< (num_frames, states of all chains); no frame without speech
  double first_s = 0;     ///< where the first frame begins
  double frame_s = 0;     ///< from one frame to the next
  /// How the same audio sounds, for the times of words beside pauses; without these frames the
  /// times are the decoder's.
  std::vector<ActivityFrame> activity;
  double activity_first_s = 0;  ///< where the first of them begins
  std::vector<std::string> notes;

  /// Where a frame begins, in seconds of the recording.
  [[nodiscard]] double seconds_of(std::int64_t frame) const;
};

/// How the words of a vocabulary sound to a pretrained speech embedding.
struct EmbeddedWords {
  std::shared_ptr<const SpeechEmbedding> embedding;
  /// Of SpeechEmbedding::vector_of() to the labels, and behind them words that are none of them.
  SoftmaxRegression classifier;
};

namespace detail {
class EmbeddingRescorer;
struct RescoredSpan;
class HeldOutChoices;
class SentenceFrontEnd;
class WordTimes;
}  // namespace detail

/// Immutable; const calls are safe from several threads. Copies share their models.
class HRI_API ConnectedWordRecognizer {
 public:
  /// From trained parts: `models` are those of the sorted `labels` and behind them that of silence;
  /// `final_stays` the probability of each to stay in its last state; `codebook` is that of the
  /// kind ptbhmm; with options.unknown_words the states of `fillers` count as sounds of unknown
  /// words; `embedded` goes with options.words.front_end both, and counts with the weight
  /// options.words.embedding_weight. Throws InvalidArgument for parts that do not fit each other,
  /// and options out of range.
  ConnectedWordRecognizer(const ConnectedWordRecognizerOptions& options,
                          std::vector<std::string> labels, std::vector<GaussianMixtureHmm> models,
                          const VectorD& final_stays,
                          std::optional<MultiStreamCodebook> codebook = std::nullopt,
                          FillerModels fillers = {},
                          std::optional<EmbeddedWords> embedded = std::nullopt);

  /// Trains on isolated words. `fillers` are words outside the vocabulary, of any speakers, which
  /// are used with options.unknown_words alone: unknown words are found by their sounds, too.
  /// `embedding` goes with options.words.front_end both. Throws InvalidArgument as
  /// WordRecognizer::train() does; Interrupted.
  static ConnectedWordRecognizer train(
      const std::vector<WordSample>& samples, const ConnectedWordRecognizerOptions& options,
      const TrainingProgress& progress = {}, const StopCheck& should_stop = {},
      const std::vector<WordSample>& fillers = {},
      const std::shared_ptr<const SpeechEmbedding>& embedding = nullptr);

  /// The same with a language model of order 1 or 2, which has to know all labels; the scale is
  /// options().decoder.language_scale. Throws InvalidArgument.
  [[nodiscard]] ConnectedWordRecognizer with_language(NGramModel language) const;
  /// The same with a grammar, whose words have to be labels: only its sentences are found, with the
  /// scale of a language model on its weights. With options().unknown_words a sentence of unknown
  /// words alone is found, too. A language model is gone. Throws InvalidArgument.
  [[nodiscard]] ConnectedWordRecognizer with_grammar(Grammar grammar) const;
  /// The same with other options of the decoder. Throws InvalidArgument for values out of range.
  [[nodiscard]] ConnectedWordRecognizer with_decoder(const ConnectedDecoderOptions& decoder) const;

  /// The same with another words.embedding_weight, which has no effect without an embedding. Throws
  /// InvalidArgument for one out of range.
  [[nodiscard]] ConnectedWordRecognizer with_embedding_weight(double weight) const;

  /// One that was trained with an embedding needs the same: throws InvalidArgument without, and
  /// FormatError for other weights.
  static ConnectedWordRecognizer load(const std::string& path,
                                      std::shared_ptr<const SpeechEmbedding> embedding = nullptr);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static ConnectedWordRecognizer from_model_file(
      const ModelFile& file, std::shared_ptr<const SpeechEmbedding> embedding = nullptr);

  /// The words of a recording: any number, in any order or as the language model weighs them, a
  /// sentence of the grammar, or as `query` says. No word without speech. Throws InvalidArgument
  /// for audio that is not finite or shorter than one frame, and rates and numbers out of range.
  [[nodiscard]] Transcript recognise(Span<const float> audio, int sample_rate_hz,
                                     const TranscriptionQuery& query = {}) const;

  /// The same in two steps: the scores of a recording do not depend on how it is searched.
  [[nodiscard]] ScoredRecording score(Span<const float> audio, int sample_rate_hz) const;
  /// The same of a recording that goes on: by cepstra alone, as what is named now is named anew
  /// with every further sound.
  [[nodiscard]] ScoredRecording score_begun(Span<const float> audio, int sample_rate_hz) const;
  /// Throws InvalidArgument for scores of another recogniser.
  [[nodiscard]] Transcript recognise(const ScoredRecording& recording,
                                     const TranscriptionQuery& query = {}) const;
  /// Forced alignment: the given words in their order, and when each was spoken. Silence may stand
  /// before, between and after them; language model and grammar have no say, and nothing is pruned.
  /// TranscribedWord::kUnknown is a word like others with options().unknown_words. Confidences are
  /// those that the words have among all sentences of words in any order, near 0 where another word
  /// was said; none of the words is marked unknown for it. Not complete without speech, and where
  /// there are too few frames for so many words: these are then those of the best beginning. Throws
  /// InvalidArgument as recognise() does, for no word, more than 1000, and one that there is not,
  /// which it names.
  [[nodiscard]] Transcript align(Span<const float> audio, int sample_rate_hz,
                                 const std::vector<std::string>& words,
                                 bool confidences = true) const;
  /// Throws InvalidArgument for scores of another recogniser, too.
  [[nodiscard]] Transcript align(const ScoredRecording& recording,
                                 const std::vector<std::string>& words,
                                 bool confidences = true) const;
  /// Of a recording that goes on: the best beginning of a sentence, without confidences; its first
  /// `num_decided` words are on every path that is left.
  [[nodiscard]] Transcript recognise_begun(const ScoredRecording& recording,
                                           std::size_t* num_decided) const;
  /// All sentences near the best; model i is labels()[i], then silence and the unknown word. Throws
  /// InvalidArgument as Lattice::decode() does.
  [[nodiscard]] Lattice lattice(const ScoredRecording& recording, int num_words = 0) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const ConnectedWordRecognizerOptions& options() const { return options_; }
  /// nullptr: there is none.
  [[nodiscard]] const std::shared_ptr<const NGramModel>& language() const { return language_; }
  [[nodiscard]] const std::shared_ptr<const Grammar>& grammar() const { return grammar_; }
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& models() const {
    return emissions_->models();
  }
  /// Of filler words; none without options().unknown_words.
  [[nodiscard]] int num_fillers() const {
    return fillers_ == nullptr ? 0 : static_cast<int>(fillers_->models().size());
  }
  [[nodiscard]] const VectorD& final_stays() const { return final_stays_; }
  /// nullptr: there is none.
  [[nodiscard]] std::shared_ptr<const SpeechEmbedding> embedding() const;
  /// Of the words, of silence, and with options().unknown_words that of the unknown word.
  [[nodiscard]] const std::vector<WordChain>& chains() const { return chains_; }
  [[nodiscard]] int silence() const { return static_cast<int>(labels_.size()); }
  [[nodiscard]] int unknown_word() const { return silence() + 1; }

 private:
  friend class detail::HeldOutChoices;

  // Throws InvalidArgument for labels that transcripts and lattices have a meaning of their own
  // for.
  static void check_labels(const std::vector<std::string>& labels);
  static ConnectedWordRecognizer read(const ModelFile& file,
                                      const std::shared_ptr<const SpeechEmbedding>& embedding);
  /// score_begun() without the unknown word; `fillers` gets the scores of the states of filler
  /// words, `recorded` the audio that the activity is of; either may be nullptr.
  [[nodiscard]] ScoredRecording score_models(Span<const float> audio, int sample_rate_hz,
                                             MatrixF* fillers, std::vector<float>* recorded) const;
  [[nodiscard]] ScoredRecording score_cepstra(Span<const float> audio, int sample_rate_hz,
                                              std::vector<float>* recorded) const;
  /// What the words of a first search may have been, by the embedding.
  [[nodiscard]] std::vector<detail::RescoredSpan> spans_of(const ScoredRecording& recording,
                                                           Span<const float> recorded) const;
  [[nodiscard]] std::shared_ptr<const WordNetwork> network(int num_words) const;
  // Its number among chains(). Throws InvalidArgument for a word that there is not.
  [[nodiscard]] int model_of(const std::string& word) const;
  [[nodiscard]] std::vector<TranscribedWord> words_of(const std::vector<DecodedWord>& decoded,
                                                      const ScoredRecording& recording) const;
  [[nodiscard]] Slots slots_of(const std::vector<TranscribedWord>& words) const;
  [[nodiscard]] std::vector<bool> states_of_words() const;
  // Adds confidences and alternatives.
  void weigh(const ScoredRecording& recording, const TranscriptionQuery& query,
             const WordNetwork& searched, const std::vector<DecodedWord>& decoded,
             Transcript* transcript) const;
  void add_confidences(const Lattice& lattice, const std::vector<DecodedWord>& decoded,
                       Transcript* transcript) const;

  ConnectedWordRecognizerOptions options_;
  std::vector<std::string> labels_;
  VectorD final_stays_;
  std::shared_ptr<const detail::SentenceFrontEnd> front_end_;
  std::shared_ptr<const detail::WordTimes> times_;
  std::shared_ptr<const detail::EmbeddingRescorer> rescorer_;  // nullptr: cepstra alone
  std::shared_ptr<const GaussianEmissions> emissions_;
  std::shared_ptr<const CodedPossibilities> possibilities_;         // of the kind ptbhmm
  std::shared_ptr<const GaussianEmissions> fillers_;                // nullptr: there are none
  std::shared_ptr<const CodedPossibilities> filler_possibilities_;  // of the kind ptbhmm
  std::vector<WordChain> chains_;
  std::shared_ptr<const WordNetwork> any_words_;  // any number of them in any order
  std::shared_ptr<const WordNetwork> sentences_;  // as language model or grammar allow them
  std::shared_ptr<const NGramModel> language_;
  std::shared_ptr<const Grammar> grammar_;
};

}  // namespace hri
