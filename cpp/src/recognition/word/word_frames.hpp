// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The frames that training makes of a recording: its own and those of its copies, with the
// frequency axis warped and in noise.
#pragma once

#include <string>
#include <vector>

#include "hri/recognition/word/word_recognizer.hpp"

namespace hri {

class WordFrames {
 public:
  /// For recognisers like `recognizer`, whose models are not used. Throws InvalidArgument naming
  /// the option of warps or noise that is out of range.
  explicit WordFrames(const WordRecognizer& recognizer);

  /// The word in a recording; empty where nobody speaks. Throws InvalidArgument for audio that is
  /// not finite or too short, naming `what`.
  [[nodiscard]] std::vector<float> locate(const WordSample& sample, const std::string& what) const;

  /// The frames of every stream, of the word as it is, at every warp and of every noisy copy. The
  /// noise depends on the seed of the models and on `index` alone.
  [[nodiscard]] std::vector<std::vector<MatrixF>> of(Span<const float> word,
                                                     std::size_t index) const;

 private:
  std::vector<WordRecognizer> fronts_;  // the front ends at every warp; their models stay empty
};

}  // namespace hri
