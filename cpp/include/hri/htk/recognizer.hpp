// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HVite: HTK's models, dictionary and word network before the decoder of connected words. A
// pronunciation becomes one chain, of the chains of its models.
#pragma once

#include <cstdint>
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

/// A word of a recognised sentence.
struct RecognisedWord {
  std::string word;    ///< as the network has it
  std::string output;  ///< what the dictionary prints for it; "": nothing
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  double log_score = 0;         ///< what it adds to the sentence's, weights and penalty included
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
  /// not, and words whose models could all be passed without a frame; for lattices with a fault,
  /// and options out of range.
  Recognizer(const ModelSet& models, const Dictionary& dictionary, const WordLattice& lattice,
             const ConnectedDecoderOptions& options = {});

  /// The best sentence of `observations` (num_frames, dim()). Throws InvalidArgument for another
  /// number of columns, and values not finite.
  [[nodiscard]] RecognisedSentence recognise(ConstMatrixRefF observations) const;

  /// All sentences near the best; model i is the pronunciation i, whose word is words()[i]. Throws
  /// InvalidArgument as recognise() and Lattice::decode() do.
  [[nodiscard]] Lattice lattice(ConstMatrixRefF observations,
                                const LatticeOptions& options = {1000, 200000}) const;
  /// At most `count` (1..1000) sentences of a lattice of this recogniser that differ in their
  /// words, whatever their pronunciations, the best first; none of an empty lattice.
  [[nodiscard]] std::vector<RecognisedSentence> n_best(const Lattice& lattice, int count) const;
  /// Of every pronunciation.
  [[nodiscard]] std::vector<std::string> words() const;

  [[nodiscard]] int dim() const { return emissions_.front().dim(); }

 private:
  [[nodiscard]] MatrixF scores(ConstMatrixRefF observations) const;
  [[nodiscard]] std::vector<RecognisedWord> words_of(const std::vector<DecodedWord>& words) const;

  ConnectedDecoderOptions options_;
  std::vector<GaussianEmissions> emissions_;  // one
  std::vector<Pronunciation> pronunciations_;
  std::vector<WordChain> chains_;  // by pronunciation
  std::vector<int> columns_;       // of the emissions, by states of the chains
  WordNetwork network_;
};

}  // namespace hri::htk
