// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The unknown word: a model without parameters, whose states score in every frame the mean of the
// best states of all words (Bourlard, D'hoore and Boite, "Optimizing recognition and rejection
// performance in wordspotting systems", ICASSP 1994). Where a word fits well, its states are among
// the best in all frames and together score more; a sound that is no word is passed by the best of
// many.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/language/connected_decoder.hpp"

namespace hri::detail {

/// A chain of so many states, each left with probability 1/2.
WordChain unknown_chain(int num_states, double penalty);

/// Fills the columns behind those that `is_of_word` has with the mean of the `rank` best of the
/// columns for which `is_of_word` is true, in every row.
void score_unknown(const std::vector<bool>& is_of_word, int rank, MatrixF* log_emissions);

}  // namespace hri::detail
