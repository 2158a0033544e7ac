// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected words, trained on isolated ones: recordings of each speaker are joined to strings whose
// word boundaries are known, and one HMM a word and one of silence are trained on the frames of
// these strings. Cepstra are normalised over the utterance, so that a model trained on words by
// themselves would meet other cepstra in a sentence; here training and decoding see the same.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/ngram_model.hpp"
#include "hri/language/word_emissions.hpp"
#include "hri/recognition/training.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri {

struct HRI_API ConnectedWordRecognizerOptions {
  WordRecognizerOptions words;
  int silence_states = 3;
  int silence_mixtures = 4;
  int max_words = 7;
  double max_pause_ms = 300;
  int num_alignments = 1;
  bool choose_penalty = true;
  ConnectedDecoderOptions decoder;

  static constexpr const char* kName = "ConnectedWordRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("words", o.words, any_value,
      "front end, models and augmentation as of isolated words, models of the kind hmm; what these "
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
      "decoder.insertion_penalty is chosen on strings of speakers held out");
    v("decoder", o.decoder, any_value, "how sentences are searched");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

struct TranscribedWord {
  std::string label;
  double first_s = 0;  ///< from the beginning of the recording
  double last_s = 0;
  double log_score = 0;  ///< what it adds to the transcript's
};

struct Transcript {
  std::vector<TranscribedWord> words;
  double log_score = 0;            ///< natural log, of the best path; 0 without speech
  bool complete = true;            ///< false: too short for so many words, these are what was found
  std::vector<std::string> notes;  ///< what was converted or assumed on the way

  /// The words, with spaces between.
  [[nodiscard]] std::string text() const;
};

namespace detail {
class SentenceFrontEnd;
}

/// Immutable; const calls are safe from several threads. Copies share their models.
class HRI_API ConnectedWordRecognizer {
 public:
  /// From trained parts: `models` are those of the sorted `labels` and behind them that of silence;
  /// `final_stays` the probability of each to stay in its last state. Throws InvalidArgument for
  /// parts that do not fit each other, and options out of range.
  ConnectedWordRecognizer(const ConnectedWordRecognizerOptions& options,
                          std::vector<std::string> labels, std::vector<GaussianMixtureHmm> models,
                          const VectorD& final_stays);

  /// Trains on isolated words. Throws InvalidArgument as WordRecognizer::train() does; Interrupted.
  static ConnectedWordRecognizer train(const std::vector<WordSample>& samples,
                                       const ConnectedWordRecognizerOptions& options,
                                       const TrainingProgress& progress = {},
                                       const StopCheck& should_stop = {});

  /// The same with a language model of order 1 or 2, which has to know all labels; the scale is
  /// options().decoder.language_scale. Throws InvalidArgument.
  [[nodiscard]] ConnectedWordRecognizer with_language(NGramModel language) const;
  /// The same with other options of the decoder. Throws InvalidArgument for values out of range.
  [[nodiscard]] ConnectedWordRecognizer with_decoder(const ConnectedDecoderOptions& decoder) const;

  static ConnectedWordRecognizer load(const std::string& path);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static ConnectedWordRecognizer from_model_file(const ModelFile& file);

  /// The words of a recording: any number, in any order or as the language model weighs them; or
  /// `num_words` (1..1000) in any order, without the language model. No word without speech. Throws
  /// InvalidArgument for audio that is not finite or shorter than one frame, and rates and numbers
  /// out of range.
  [[nodiscard]] Transcript recognise(Span<const float> audio, int sample_rate_hz,
                                     int num_words = 0) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const ConnectedWordRecognizerOptions& options() const { return options_; }
  /// nullptr: there is none.
  [[nodiscard]] const std::shared_ptr<const NGramModel>& language() const { return language_; }
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& models() const {
    return emissions_->models();
  }
  [[nodiscard]] const VectorD& final_stays() const { return final_stays_; }

 private:
  static ConnectedWordRecognizer read(const ModelFile& file);
  [[nodiscard]] WordNetwork network(int num_words) const;

  ConnectedWordRecognizerOptions options_;
  std::vector<std::string> labels_;
  VectorD final_stays_;
  std::shared_ptr<const detail::SentenceFrontEnd> front_end_;
  std::shared_ptr<const GaussianEmissions> emissions_;
  std::vector<WordChain> chains_;
  std::shared_ptr<const NGramModel> language_;
};

}  // namespace hri
