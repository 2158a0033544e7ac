// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HVite: HTK's models, dictionary and word network before the decoder of connected words. A
// pronunciation becomes one chain, of the chains of its models.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/dictionary.hpp"
#include "hri/htk/model_set.hpp"
#include "hri/htk/word_lattice.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/lattice.hpp"
#include "hri/language/word_emissions.hpp"

namespace hri::htk {

namespace detail {

/// Where the models of a pronunciation lie in its chain.
struct UnitPlaces {
  struct State {
    int unit = 0;
    int state = 0;        ///< of the model, from 0
    double log_exit = 0;  ///< out of the model
  };
  std::vector<State> states;
  std::vector<double> log_skips;  ///< past every model
  int first_column = 0;           ///< of its states among those of all chains
};

}  // namespace detail

/// A word of a recognised sentence.
struct RecognisedWord {
  std::string word;    ///< as the network has it
  std::string output;  ///< what the dictionary prints for it; "": nothing
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  double log_score = 0;         ///< what it adds to the sentence's, weights and penalty included
  int pronunciation = 0;        ///< its entry in the dictionary
};

/// A state on the best path through a model.
struct AlignedState {
  int state = 2;  ///< as HTK counts: the entry is 1
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  double log_score = 0;         ///< of its frames, and of the steps into it and on from it
};

/// A model of a recognised word.
struct AlignedModel {
  std::string model;
  std::int64_t first_frame = 0;
  std::int64_t last_frame =
      0;  ///< one past the last; the first where it was passed without a frame
  double log_score = 0;
  std::vector<AlignedState> states;
};

struct RecognisedSentence {
  bool complete = false;  ///< else the recording ends before any sentence of the network does
  double log_score = 0;
  std::vector<RecognisedWord> words;
};

/// Immutable; const calls are safe from several threads.
class HRI_API Recognizer {
 public:
  /// Throws InvalidArgument naming the word that the dictionary has not, the model that the set has
  /// not, words whose models could all be passed without a frame, and discrete models beside
  /// Gaussian ones; for lattices with a fault, and options out of range.
  Recognizer(const ModelSet& models, const Dictionary& dictionary, const WordLattice& lattice,
             const ConnectedDecoderOptions& options = {});

  /// The best sentence of `observations` (num_frames, dim()). Throws InvalidArgument for another
  /// number of columns, and values not finite or, of discrete models, no codeword.
  [[nodiscard]] RecognisedSentence recognise(ConstMatrixRefF observations) const;

  /// The models of every word of a sentence of `observations`, and their states, on the best path
  /// within the frames of the word. Their log scores sum to that of the word but for the weights of
  /// the network, the penalty and the probability of the pronunciation. Throws InvalidArgument as
  /// recognise() does, and for words that are not of this recogniser or fit no path.
  [[nodiscard]] std::vector<std::vector<AlignedModel>> align(
      ConstMatrixRefF observations, const RecognisedSentence& sentence) const;

  /// All sentences near the best; model i is the pronunciation i, whose word is words()[i]. Throws
  /// InvalidArgument as recognise() and Lattice::decode() do.
  [[nodiscard]] Lattice lattice(ConstMatrixRefF observations,
                                const LatticeOptions& options = {1000, 200000}) const;
  /// At most `count` (1..1000) sentences of a lattice of this recogniser that differ in their
  /// words, whatever their pronunciations, the best first; none of an empty lattice.
  [[nodiscard]] std::vector<RecognisedSentence> n_best(const Lattice& lattice, int count) const;
  /// Of every pronunciation.
  [[nodiscard]] std::vector<std::string> words() const;

  [[nodiscard]] const ConnectedDecoderOptions& options() const { return options_; }
  [[nodiscard]] int dim() const { return emissions_.empty() ? 1 : emissions_.front().dim(); }

 private:
  [[nodiscard]] MatrixF discrete_scores(ConstMatrixRefF observations) const;
  [[nodiscard]] MatrixF scores(ConstMatrixRefF observations) const;
  [[nodiscard]] std::vector<RecognisedWord> words_of(const std::vector<DecodedWord>& words) const;

  ConnectedDecoderOptions options_;
  std::vector<GaussianEmissions> emissions_;  // one; none of discrete models
  MatrixF discrete_;  // log probabilities by codeword and state, -inf for 0; of Gaussians empty
  std::vector<Pronunciation> pronunciations_;
  std::vector<int> entries_;               // of the dictionary, by pronunciation
  std::map<int, int> of_entry_;            // the same back
  std::vector<WordChain> chains_;          // by pronunciation
  std::vector<detail::UnitPlaces> units_;  // of their states
  std::vector<int> columns_;               // of the emissions, by states of the chains
  WordNetwork network_;
};

}  // namespace hri::htk
