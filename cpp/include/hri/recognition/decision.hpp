// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a recogniser says of one utterance or gesture.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"

namespace hri {

enum class DecisionStatus : std::uint8_t {
  recognised,  ///< the best class passed the rejection threshold
  unknown,     ///< something was said or shown, but no class of the vocabulary explains it
  no_input,    ///< silence, or no hand in view
};
constexpr auto enum_names(DecisionStatus) {
  return std::array{"recognised", "unknown", "no_input"};
}

/// One class of the n-best list.
struct NBest {
  std::string label;
  float probability = 0;  ///< calibrated posterior, 0..1; sums to 1 over the list
  float log_score =
      0;  ///< the model's own score (log-likelihood, log-possibility or margin), uncalibrated
};

struct Decision {
  DecisionStatus status = DecisionStatus::no_input;
  std::string label = "no_input";  ///< class name, or "unknown" or "no_input"
  float confidence = 0;            ///< probability of the best class, 0..1; 0 without input
  float score = 0;  ///< what the rejection threshold is compared with (see the recogniser)
  float class_threshold = 0;  ///< confidence from which the best class is sure, by its false alarms
                              ///< and misses on held-out people; 0 where training found none
  std::vector<NBest> nbest;   ///< every class in falling order; empty without input, and
                              ///< where the model's numbers overflow: that is unknown
  std::vector<std::string> notes;  ///< what was converted or assumed on the way
};

}  // namespace hri
