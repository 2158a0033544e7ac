// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Decoder of connected words, or signs: token passing in one pass over a word network (Young,
// Russell and Thornton, "Token passing: a simple conceptual model for connected speech recognition
// systems", CUED 1989), Viterbi with a beam. It knows models by their chains and by the log scores
// of their states in every frame, wherever these come from.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/language/word_network.hpp"
#include "hri/models/hmm/markov_chain.hpp"

namespace hri {

struct ConnectedDecoderOptions {
  double beam = 2000;
  double language_scale = 1;
  double insertion_penalty = 0;
  int max_open_words = 65536;

  static constexpr const char* kName = "ConnectedDecoderOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("beam", o.beam, above(0, 1e12),
      "states whose score falls this much below the best (natural log) are dropped");
    v("language_scale", o.language_scale, within(0, 1e6),
      "factor on the log weights of the network (HTK's grammar scale)");
    v("insertion_penalty", o.insertion_penalty, within(-1e6, 1e6),
      "added to the log score at every word; below 0: fewer words (HTK's -p)");
    v("max_open_words", o.max_open_words, within(64, 100000000),
      "words of all hypotheses that are kept at most while these differ; beyond, the oldest word "
      "of "
      "the best one is decided");
  }
};

/// The states of a model as the decoder passes them, in natural logs; -inf for what there is not.
struct HRI_API WordChain {
  VectorD log_start;        ///< (num_states)
  MatrixD log_transition;   ///< (num_states, num_states)
  VectorD log_exit;         ///< (num_states), out of the word
  bool is_silence = false;  ///< no word: without insertion penalty

  /// A left-right chain, which ends in its last state: this one is left with probability
  /// 1 - final_stay, whatever the chain says of it. Throws InvalidArgument for other topologies and
  /// for final_stay outside 0..1, 1 excluded.
  static WordChain of(const MarkovChain& chain, double final_stay, bool is_silence = false);
  /// The same in possibilities: what may come first, and what may follow each state, its exit among
  /// it, is divided by its largest value (thesis eq. 5.14).
  [[nodiscard]] WordChain possibilities() const;
};

/// One word, or silence, of a decoded sentence.
struct DecodedWord {
  int model = 0;
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  double log_score = 0;         ///< what it adds to the sentence's, weights and penalty included
};

struct DecodedSentence {
  /// Whether the words make up a whole sentence of the network; else they are what is best so far.
  bool complete = false;
  double log_score = -std::numeric_limits<double>::infinity();
  std::vector<DecodedWord> words;  ///< in the order of time, silences among them
};

/// For one thread at a time. Memory is bounded by the network and max_open_words, plus one record a
/// word that is decided and not taken yet.
class HRI_API ConnectedDecoder {
 public:
  /// `chains` are the models that the network names. Throws InvalidArgument for options out of
  /// range, chains whose shapes do not fit or whose values are NaN or above 0, and models of the
  /// network that there are not.
  ConnectedDecoder(const std::vector<WordChain>& chains, const WordNetwork& network,
                   const ConnectedDecoderOptions& options = {});
  ConnectedDecoder(ConnectedDecoder&&) noexcept;
  ConnectedDecoder& operator=(ConnectedDecoder&&) noexcept;
  ConnectedDecoder(const ConnectedDecoder&) = delete;
  ConnectedDecoder& operator=(const ConnectedDecoder&) = delete;
  ~ConnectedDecoder();

  /// One frame: the log scores of all states, model by model (num_states() values, -inf for
  /// impossible). Allocates nothing but, now and then, memory for decided words. Throws
  /// InvalidArgument for another number of values, NaN and +inf; then nothing has changed.
  void push(Span<const float> log_emissions);

  /// The best hypothesis so far, with the word that it is in the middle of; words that were taken
  /// are not in it.
  [[nodiscard]] DecodedSentence partial() const;
  /// The words on which all hypotheses agree, since the last call: they change no more.
  std::vector<DecodedWord> take_decided();
  /// The best sentence, without the words that were taken; then as after reset().
  DecodedSentence finish();
  /// Back to before the first frame.
  void reset();

  [[nodiscard]] int num_states() const;  ///< of all models
  [[nodiscard]] std::int64_t num_frames() const;
  [[nodiscard]] int num_active() const;  ///< states with a token
  /// Whether any hypothesis is left; without one partial() and finish() give no words.
  [[nodiscard]] bool alive() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hri
