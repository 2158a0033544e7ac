// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Decisions on words of people held out, by models that do not know them: what verifier,
// calibration and the report of a training are made from.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hri/recognition/calibration.hpp"
#include "hri/recognition/held_out_report.hpp"
#include "hri/recognition/word/multi_stream_scorer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "hri/recognition/word/word_verifier.hpp"

namespace hri::detail {

/// How a recogniser rejects, and how well it did on the words held out.
struct Judgement {
  WordVerifier verifier;
  Calibration calibration;
  HeldOutReport report;
};

class HeldOutWords {
 public:
  /// A word of class `label`, by models that do not know its speaker, `group`. `as_recorded`: no
  /// noise was added.
  void add_word(const StreamFrames& frames, int label, const std::string& group, bool as_recorded,
                const MultiStreamScorer& scorer);
  void add_non_word(const StreamFrames& frames, VerifierExample::Kind kind,
                    const MultiStreamScorer& scorer);
  /// All of `more` behind these.
  void append(HeldOutWords more);

  /// `labels`: names of the classes. `scorer`: any of those that the words were added with.
  [[nodiscard]] Judgement judge(const WordRecognizerOptions& options,
                                const std::vector<std::string>& labels,
                                const MultiStreamScorer& scorer);

 private:
  [[nodiscard]] double false_reject_rate(const WordRecognizerOptions& options,
                                         const std::vector<float>& others) const;
  [[nodiscard]] HeldOutReport report(const std::vector<std::string>& labels,
                                     const std::vector<float>& others,
                                     const Calibration& calibration) const;

  std::vector<HeldOut> decisions_;
  std::vector<VectorD> features_;    // of each decision
  std::vector<bool> as_recorded_;    // each decision
  std::vector<VectorD> as_unknown_;  // of each, as if its word were not in the vocabulary
  std::set<std::pair<int, std::string>> words_left_out_;  // label and speaker of these
  std::vector<VerifierExample> examples_;
};

}  // namespace hri::detail
