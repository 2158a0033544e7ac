// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What ConnectedWordRecognizer chooses on strings of speakers held out: the insertion penalty by
// word errors, then the scale of confidences by how well these predict which words are right, and
// how far the best state of the words leads, which unknown words are found by.
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

  /// The same by every weight of the embedding that `trained` has, with its penalty.
  void try_weights(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings);
  [[nodiscard]] double best_weight() const;

  /// The same for the other choices, with the penalty that `trained` has.
  void try_scales(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings);
  [[nodiscard]] double best_scale() const;

  /// `is_held_out`: `trained` does not know the speakers. Where few speakers are trained on, one
  /// who is held out leaves too few, and known words fit far worse than they will: leads of both
  /// kinds are weighed as in Efron's .632 estimator ("Estimating the error rate of a prediction
  /// rule", JASA 1983).
  void add_leads(const ConnectedWordRecognizer& trained, const std::vector<WordString>& strings,
                 bool is_held_out);
  /// 0: there was no speech.
  [[nodiscard]] double expected_lead() const;

 private:
  // The first of those with as few errors. Where strings of known people are right whatever the
  // penalty, stronger ones still delete words of others, whom the models fit worse.
  static constexpr std::array kPenalties{-400.0, -300.0, -200.0, -150.0, -100.0, -70.0,
                                         -50.0,  -30.0,  -15.0,  0.0,    15.0,   30.0};
  static constexpr std::array kScales{1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005};

  // On log odds of a word; log scores of cepstra count every frame as if it stood alone.
  static constexpr std::array kWeights{40.0, 20.0, 80.0, 10.0, 160.0, 5.0, 320.0};

  StopCheck should_stop_;
  std::array<int, kPenalties.size()> penalty_errors_{};
  std::array<int, kWeights.size()> weight_errors_{};
  std::array<double, kScales.size()> scale_losses_{};
  double lead_sum_ = 0;  // weighed, over frames of speech
  double num_speech_ = 0;
};

}  // namespace hri::detail
