// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Speaker adaptation of a word recogniser, supervised (with labels) and unsupervised, by linear and
// maximum a posteriori adaptation of its models (sequence_scorer.hpp). Words without a label are
// learned as what they were recognised as, if by a clear margin.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/recognition/decision.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri {

struct SpeakerAdapterOptions {
  double words_per_label = 5;
  double shared_frames = 400;
  double prior_frames = 5;
  int num_iterations = 3;
  double trusted_share = 1;
  int max_words = 300;

  static constexpr const char* kName = "SpeakerAdapterOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("words_per_label", o.words_per_label, within(0, 1000),
      "words a label, on average, from which on each word's model is adapted too; before, only "
      "what all have in common");
    v("shared_frames", o.shared_frames, above(0, 1e12),
      "imagined frames that hold back what changes all words in each of two passes, of which the "
      "second starts from the first: of as many real frames, three quarters of the change come "
      "through, not half");
    v("prior_frames", o.prior_frames, above(0, 1e12),
      "frames a state that weigh as much as the training");
    v("num_iterations", o.num_iterations, within(1, 1000), "EM iterations of an update");
    v("trusted_share", o.trusted_share, within(0, 1),
      "share of the words without a label to learn from, those of the largest margins first");
    v("max_words", o.max_words, within(1, 100000), "words remembered; the oldest goes first");
  }
};

/// Not safe from several threads at once. Invariant: recognizer() is the recogniser it was made
/// from, adapted to the words remembered at the last update.
class HRI_API SpeakerAdapter {
 public:
  /// Throws InvalidArgument for options out of range and for a recogniser whose models do not adapt
  /// (kind ptbhmm).
  explicit SpeakerAdapter(WordRecognizer recognizer, const SpeakerAdapterOptions& options = {});

  /// Recognises as WordRecognizer does, by what was learned up to the last update, and remembers
  /// the word.
  Decision recognise(Span<const float> audio, int sample_rate_hz);

  /// Remembers a word with its label (supervised). Throws InvalidArgument for a label that is not
  /// in the vocabulary and for audio without speech.
  void learn(Span<const float> audio, int sample_rate_hz, const std::string& label);

  /// Whether one word in eight is newer than the last update.
  [[nodiscard]] bool update_due() const;
  /// Adapts to the words remembered. Takes some milliseconds a word: call it between utterances.
  /// Throws Interrupted when `should_stop` says so, and is then as it was.
  void update(const StopCheck& should_stop = {});
  /// Forgets the speaker.
  void reset();

  [[nodiscard]] const WordRecognizer& recognizer() const { return adapted_; }
  [[nodiscard]] int num_words() const { return static_cast<int>(words_.size()); }
  /// Words that the last update learned from: those with a label, and those trusted.
  [[nodiscard]] int num_learned() const { return num_learned_; }
  [[nodiscard]] const SpeakerAdapterOptions& options() const { return options_; }

 private:
  struct Word {
    StreamFrames frames;
    int label = -1;  // -1: unsupervised
  };
  struct Guess {
    int label = -1;
    float margin = 0;
  };
  void remember(Word word);
  [[nodiscard]] Guess guess(const Word& word) const;
  [[nodiscard]] std::vector<int> trusted_labels() const;

  SpeakerAdapterOptions options_;
  WordRecognizer base_;
  WordRecognizer adapted_;
  std::deque<Word> words_;
  int num_new_ = 0;
  int num_learned_ = 0;
};

}  // namespace hri
