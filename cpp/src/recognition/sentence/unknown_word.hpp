// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The unknown word: a model without parameters of its own, whose states score in every frame the
// mean of the best states of all words and of filler words (Bourlard, D'hoore and Boite,
// "Optimizing recognition and rejection performance in wordspotting systems", ICASSP 1994). A word
// that fits well has its states among the best in all frames; a sound that is no word is passed by
// the best of many. Filler words have sounds that the vocabulary lacks.
//
// How well words fit depends on the speaker, the microphone and the room, more than on which word
// it is. The mean is therefore moved to a margin below what the best state of the vocabulary scores
// on average over the utterance, estimated with a prior (maximum a posteriori): an unknown word
// fits worse than the others that the same person says.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri::detail {

/// A chain that passes a quarter of `longest` frames to `longest`, and weighs nothing. As words
/// cost the insertion penalty, one that could last would be cheaper than two known words that fit.
WordChain unknown_chain(int longest);

/// How many frames the words of `models` last on average; the last of these is silence.
int mean_word_length(const std::vector<GaussianMixtureHmm>& models, const VectorD& final_stays);

/// Of an utterance.
struct UnknownBackground {
  VectorF means;                ///< (num_frames), of the best states
  double lead_sum = 0;          ///< how far the best state of the words lies above, over speech
  Eigen::Index num_speech = 0;  ///< frames in which a state of a word is better than all of silence

  /// What the unknown word scores in every frame. `expected_lead` is the prior: a frame's lead.
  [[nodiscard]] VectorF scores(double expected_lead, double margin) const;
};

/// `models` has the log scores of all states, the last `num_silence` those of silence; `is_of_word`
/// says which are those of words, `fillers` has those of filler words, or no column. The
/// `rank` best states count, but no more than one in four.
UnknownBackground unknown_background(const MatrixF& models, const std::vector<bool>& is_of_word,
                                     int num_silence, const MatrixF& fillers, int rank);

}  // namespace hri::detail
