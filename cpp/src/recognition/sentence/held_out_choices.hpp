// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What ConnectedWordRecognizer chooses on strings of speakers held out: the insertion penalty by
// word errors, then the scale of confidences by how well these predict which words are right, and
// the margin of the unknown word by word errors where a third of the vocabulary is taken away.
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

  /// `is_held_out`: `trained` does not know the speakers. Where few speakers are trained on, one
  /// who is held out leaves too few, and known words fit far worse than they will; errors of both
  /// kinds are weighed as Efron's .632 estimator does ("Estimating the error rate of a prediction
  /// rule", JASA 1983).
  void try_unknown(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings,
                   bool is_held_out);
  void set_best_unknown(ConnectedWordRecognizerOptions* options) const;

 private:
  static constexpr std::array kPenalties{-400.0, -300.0, -200.0, -150.0, -100.0, -70.0,
                                         -50.0,  -30.0,  -15.0,  0.0,    15.0,   30.0};
  static constexpr std::array kScales{1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005};
  // Of unknown words, as shares of the lead that is expected.
  static constexpr std::array kMargins{0.6, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.2};
  using MarginErrors = std::array<double, kMargins.size()>;

  static MarginErrors margin_errors(const ConnectedWordRecognizer& trained,
                                    const WordString& string, double lead, const StopCheck& stop);

  StopCheck should_stop_;
  std::array<int, kPenalties.size()> penalty_errors_{};
  std::array<double, kScales.size()> scale_losses_{};
  MarginErrors margin_errors_{};
  double lead_sum_ = 0;  // weighed, over frames of speech
  double num_speech_ = 0;
};

}  // namespace hri::detail
