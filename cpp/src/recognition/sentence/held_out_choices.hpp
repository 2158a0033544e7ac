// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What ConnectedWordRecognizer chooses on strings of speakers held out: the insertion penalty by
// word errors, then the scale of confidences by how well these predict which words are right, and
// the weights of the unknown word by word errors where half of the vocabulary is taken away.
#pragma once

#include <array>
#include <vector>

#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "recognition/sentence/training_strings.hpp"

namespace hri::detail {

class HeldOutChoices {
 public:
  explicit HeldOutChoices(StopCheck should_stop) : should_stop_(std::move(should_stop)) {}

  /// Counts word errors of strings that `trained` was not trained on, by every penalty.
  void try_penalties(const ConnectedWordRecognizer& trained,
                     const std::vector<WordString>& strings);
  [[nodiscard]] double best_penalty() const;

  /// The same for the other choices, with the penalty that `trained` has.
  void try_scales(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings);
  [[nodiscard]] double best_scale() const;

  void try_unknown(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings);
  void set_best_unknown(ConnectedWordRecognizerOptions* options) const;

 private:
  static constexpr std::array kPenalties{-400.0, -300.0, -200.0, -150.0, -100.0, -70.0,
                                         -50.0,  -30.0,  -15.0,  0.0,    15.0,   30.0};
  static constexpr std::array kScales{1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005};
  static constexpr std::array kRanks{1, 2, 4, 8, 16};
  static constexpr std::array kUnknownPenalties{0.0, -30.0, -70.0, -150.0, -300.0, -500.0, -800.0};
  using UnknownErrors = std::array<std::array<int, kUnknownPenalties.size()>, kRanks.size()>;

  StopCheck should_stop_;
  std::array<int, kPenalties.size()> penalty_errors_{};
  std::array<double, kScales.size()> scale_losses_{};
  UnknownErrors unknown_errors_{};
};

}  // namespace hri::detail
