// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How far one kind of scores counts beside another, chosen on words of speakers held out.
#pragma once

#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// A word held out, scored in two ways.
struct HeldOutScores {
  VectorF first;
  VectorF second;
  int label = 0;
};

/// The factor on the second scores with which their sum with the first predicts the label best: of
/// least cross-entropy, at the temperature that suits it best.
double choose_weight(const std::vector<HeldOutScores>& words);

}  // namespace hri::detail
