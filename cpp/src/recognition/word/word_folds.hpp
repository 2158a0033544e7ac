// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Which words are held out together while a word recogniser is trained.
#pragma once

#include <string>
#include <vector>

namespace hri::detail {

/// What decides where a word is held out.
struct WordOrigin {
  int label = 0;
  std::string group;      ///< the speaker
  std::string recording;  ///< of several words made of one recording the same name; "" for its own
};

/// As `held_out_folds` of the recordings; what was made of one stands in its fold. Where no fold
/// can be held out without a label going missing, the recordings of each label are dealt out in
/// turn.
std::vector<int> word_folds(const std::vector<WordOrigin>& words, int max_folds);

}  // namespace hri::detail
