// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How far the vectors of words count beside their streams of cepstra, chosen on words of speakers
// held out.
#pragma once

#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// A word held out, as streams and vectors score it.
struct HeldOutScores {
  VectorF streams;
  VectorF vectors;
  int label = 0;
};

/// The factor on the scores of vectors with which their sum with those of streams predicts the
/// label best: of least cross-entropy, at the temperature that suits it best.
double choose_vector_weight(const std::vector<HeldOutScores>& words);

}  // namespace hri::detail
