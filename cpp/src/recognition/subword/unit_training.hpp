// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Models of sub-word units from recordings of words whose units are known, and their adaptation.
#pragma once

#include <string>
#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"

namespace hri::detail {

/// Frames of a word between silences of `num_edge` frames each.
struct UnitUtterance {
  MatrixF frames;
  Eigen::Index num_edge = 0;
  std::vector<std::string> units;  ///< of the word, without silences
};

/// From uniform segmentation, then embedded Baum-Welch. Utterances with fewer frames than states
/// are left out. Throws InvalidArgument where a unit then has none; Interrupted.
UnitModels train_units(const std::vector<UnitUtterance>& utterances,
                       const SubwordRecognizerOptions& options, const StopCheck& should_stop);

/// Moves the means of `units`, all but those of silence, towards utterances of one word that is
/// made of these units, in this order. Throws InvalidArgument where none fits.
UnitModels adapt_units(const UnitModels& units, const std::vector<UnitUtterance>& utterances,
                       const SubwordRecognizerOptions& options, const StopCheck& should_stop);

}  // namespace hri::detail
