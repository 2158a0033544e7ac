// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Isolated words: audio -> endpointing -> cepstra -> one sequence model a word -> rejection ->
// Decision (thesis section 6.2). A speech embedding votes beside the models of cepstra, or decides
// in their place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/decision.hpp"
#include "hri/recognition/held_out_report.hpp"
#include "hri/recognition/training.hpp"
#include "hri/recognition/word/multi_stream_scorer.hpp"
#include "hri/recognition/word/word_front_end.hpp"
#include "hri/recognition/word/word_verifier.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

enum class FrontEndKind : std::uint8_t {
  cepstra,    ///< streams of cepstra alone
  both,       ///< and a pretrained speech embedding, which votes too (speech_embedding.hpp)
  embedding,  ///< the embedding alone
};
constexpr auto enum_names(FrontEndKind) { return std::array{"cepstra", "both", "embedding"}; }
constexpr bool has_cepstra(FrontEndKind kind) { return kind != FrontEndKind::embedding; }
constexpr bool has_embedding(FrontEndKind kind) { return kind != FrontEndKind::cepstra; }

/// The fields of SequenceModelOptions are those of the models trained on each stream of cepstra.
struct HRI_API WordRecognizerOptions : SequenceModelOptions {
  WordRecognizerOptions() {
    num_mixtures = 0;
    cepstra.sample_rate_hz = 0;
    activity.padding_ms = 60;
  }

  FrontEndKind front_end = FrontEndKind::cepstra;
  CepstraOptions cepstra;
  ActivityOptions activity;
  bool trim = true;
  double noise_floor_db = 45;
  bool level_stream = true;
  int num_vtlp_factors = 3;
  double vtlp_step = 0.08;
  int num_noisy_copies = 2;
  double min_snr_db = 0;
  double max_snr_db = 20;
  double false_reject_rate = 0.05;
  int num_embedding_copies = 4;
  double embedding_weight = 0;
  double embedding_penalty = 100;
  double embedding_shrinkage = 0.8;
  double embedding_false_accept_rate = 0.1;
  bool use_network = false;
  SequenceNetworkOptions network;
  double network_weight = 0;

  static constexpr const char* kName = "WordRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    SequenceModelOptions::visit(o, v);
    v("front_end", o.front_end, any_value,
      "cepstra, both: with a pretrained speech embedding, whose weights are an extra, or that "
      "embedding alone, without models of cepstra");
    v("cepstra", o.cepstra, any_value,
      "features of the speech; sample_rate_hz is the rate of the model whatever the front end");
    v("activity", o.activity, any_value, "how the word is found in the clip");
    v("trim", o.trim, any_value,
      "trim the clip to the word, and activity.padding_ms before and after it");
    v("noise_floor_db", o.noise_floor_db, within(20, 120),
      "level of the noise added under a trimmed word, below its peak, under which quiet rooms and "
      "digital silence are the same",
      formerly("floor_db"));
    v("level_stream", o.level_stream, any_value,
      "a second stream votes, whose cepstra are normalised in level only");
    v("num_vtlp_factors", o.num_vtlp_factors, within(1, 5).odd(),
      "vocal-tract-length perturbation: training copies with a warped frequency axis, itself "
      "included; 1: none",
      formerly("num_warps"));
    v("vtlp_step", o.vtlp_step, within(0, 0.2), "step of the warp factor between these copies",
      formerly("warp_step"));
    v("num_noisy_copies", o.num_noisy_copies, within(0, 10),
      "noise augmentation: training copies of every word with noise added, warped in turn",
      formerly("noise_copies"));
    v("min_snr_db", o.min_snr_db, within(-20, 100),
      "least signal-to-noise ratio of the noisy copies", formerly("noise_low_db"));
    v("max_snr_db", o.max_snr_db, within(-20, 100), "largest; each copy has its own, at random",
      formerly("noise_high_db"));
    v("false_reject_rate", o.false_reject_rate, within(0, 0.5),
      "share of correct held-out words that the threshold may reject; noisy copies included, but "
      "for front_end both or embedding");
    v("num_embedding_copies", o.num_embedding_copies, within(0, 20),
      "front_end both or embedding: training copies of every word for the embedding alone, with "
      "noise added and faster or slower by up to 15 %");
    v("embedding_weight", o.embedding_weight, within(0, 1000000),
      "front_end both or embedding: factor on the log posteriors by the speech embedding, which "
      "join the scores of the cepstra; 0: chosen on words of speakers held out, 1 without cepstra");
    v("embedding_penalty", o.embedding_penalty, above(0, 1e12),
      "front_end both or embedding: of half the squared weights of the embedding's softmax "
      "regression");
    v("embedding_shrinkage", o.embedding_shrinkage, within(0, 1),
      "front_end both or embedding: of the embedding's linear discriminants, by which words are "
      "rejected");
    v("embedding_false_accept_rate", o.embedding_false_accept_rate, within(0, 1),
      "front_end both or embedding: share of other words that the threshold may accept; where it "
      "and false_reject_rate cannot both be kept to, both are exceeded by the same factor");
    v("use_network", o.use_network, any_value,
      "a small network of log mel energies, trained on the same words, votes too: for many "
      "speakers");
    v("network", o.network, any_value,
      "how that network is made and trained; its random numbers follow `seed`, too");
    v("network_weight", o.network_weight, within(0, 1000000),
      "factor on the network's log posteriors, which join the other scores; 0: chosen on words of "
      "speakers held out");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// One training word. `group` is the speaker: calibration holds whole groups out. Words that were
/// made of one recording, such as its copy in noise, have the same `recording`: without groups they
/// are held out together.
struct WordSample {
  Span<const float> samples;  ///< mono, -1..1, at `sample_rate_hz`
  int sample_rate_hz = 16000;
  std::string label;
  std::string group;
  std::string name = {};       ///< what errors call it, such as a file; by default "samples[i]"
  std::string recording = {};  ///< by default one of its own
};

/// The decision on one utterance of a longer recording.
struct UtteranceDecision {
  double first_s = 0;  ///< end points from the beginning of the recording
  double last_s = 0;
  Decision decision;
};

/// Front end, scorer, verifier and calibration. Immutable; const calls are safe from several
/// threads. Copies share their models.
class HRI_API WordRecognizer {
 public:
  /// From trained parts. Throws InvalidArgument for labels that are not sorted or do not fit the
  /// scorer, for options out of range, and as WordFrontEnd does for the embedding.
  WordRecognizer(const WordRecognizerOptions& options, std::vector<std::string> labels,
                 MultiStreamScorer scorer, WordVerifier verifier, const Calibration& calibration,
                 std::shared_ptr<const SpeechEmbedding> embedding = nullptr,
                 HeldOutReport held_out = {});

  /// Trains one model a label. `fillers` are words outside the vocabulary, of any speakers: they
  /// serve rejection alone (where there are models of cepstra only by those of kind hmm; ptbhmm
  /// leaves them aside). `embedding_fillers` are more of them without such models, which the
  /// embedding alone compares with, so that hundreds cost next to nothing. Throws InvalidArgument
  /// for a recording that is not finite (with its index) or too short, naming it, for a label
  /// without a recording that holds speech, and for `embedding_fillers` without an embedding or
  /// other fillers; Interrupted when `should_stop` says so. Labels are kept in sorted order.
  static WordRecognizer train(const std::vector<WordSample>& samples,
                              const WordRecognizerOptions& options,
                              const TrainingProgress& progress = {},
                              const StopCheck& should_stop = {},
                              const std::vector<WordSample>& fillers = {},
                              const std::shared_ptr<const SpeechEmbedding>& embedding = nullptr,
                              const std::vector<WordSample>& embedding_fillers = {});

  /// This recogniser with one word more, trained on few recordings (from one on, all of one label)
  /// and on the statistics of the words it has. Their models stay as they are, to the bit, and so
  /// does the calibration; held_out() knows nothing of the new word. Throws InvalidArgument for no
  /// recording, one without speech (names it), labels that differ or that the recogniser has
  /// already; Interrupted.
  [[nodiscard]] WordRecognizer with_word(const std::vector<WordSample>& samples,
                                         const StopCheck& should_stop = {}) const;
  /// The same without a word. Throws InvalidArgument for a label that it does not have, or where
  /// fewer than two would be left.
  [[nodiscard]] WordRecognizer without_word(const std::string& label) const;
  /// The same with another scorer of the same labels, such as an adapted one.
  [[nodiscard]] WordRecognizer with_scorer(MultiStreamScorer scorer) const;

  /// One whose front end has an embedding needs the one that it was trained with: throws
  /// InvalidArgument without one, and FormatError for one of other weights.
  static WordRecognizer load(const std::string& path,
                             std::shared_ptr<const SpeechEmbedding> embedding = nullptr);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static WordRecognizer from_model_file(const ModelFile& file,
                                        std::shared_ptr<const SpeechEmbedding> embedding = nullptr);

  /// Recognises one utterance; notes report resampling, and more than one utterance in the audio.
  /// Decision::score is the log odds that a word of the vocabulary was said (word_verifier.hpp).
  /// Throws InvalidArgument as WordFrontEnd::trim() does.
  [[nodiscard]] Decision recognise(Span<const float> audio, int sample_rate_hz) const;
  /// Recognises every utterance of a recording by itself, as a stream does: endpointed by
  /// Endpointer with its default options and the recogniser's `activity`.
  [[nodiscard]] std::vector<UtteranceDecision> recognise_utterances(Span<const float> audio,
                                                                    int sample_rate_hz) const;
  /// The decision for what front_end() made of an utterance.
  [[nodiscard]] Decision decide(const WordFeatures& word) const;

  /// Raw score of every label for one utterance (log-likelihood or log-possibility, of the
  /// embedding alone log posterior but for a constant), without rejection. Throws InvalidArgument
  /// as recognise() does, and for audio without speech.
  [[nodiscard]] VectorF scores(Span<const float> audio, int sample_rate_hz) const;
  /// The score for rejection of an utterance whose raw scores are `scores`.
  [[nodiscard]] float verification_score(const StreamFrames& frames, const VectorF& scores) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const WordRecognizerOptions& options() const { return options_; }
  [[nodiscard]] const WordFrontEnd& front_end() const { return front_end_; }
  [[nodiscard]] const MultiStreamScorer& scorer() const { return scorer_; }
  [[nodiscard]] const WordVerifier& verifier() const { return verifier_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  /// On words held out in training, as recorded: of people where every word is left without them,
  /// else of recordings; empty where none could be held out. Of three words or more each is also
  /// treated as unknown. Words added since are not in it.
  [[nodiscard]] const HeldOutReport& held_out() const { return held_out_; }

 private:
  static WordRecognizer read(const ModelFile& file,
                             std::shared_ptr<const SpeechEmbedding> embedding);

  WordRecognizerOptions options_;
  std::vector<std::string> labels_;
  WordFrontEnd front_end_;
  MultiStreamScorer scorer_;
  WordVerifier verifier_;
  Calibration calibration_;
  HeldOutReport held_out_;
};

}  // namespace hri
