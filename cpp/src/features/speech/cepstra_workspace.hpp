// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hri/features/speech/cepstra.hpp"
#include "hri/signal/lanes.hpp"

namespace hri {

// What a thread needs while it computes; it grows to the largest it has met.
struct CepstraComputer::Workspace {
  std::vector<float> edges;  // frames that reach beyond the audio
  LaneBuffer samples;
  LaneBuffer frames;
  LaneBuffer power;
  LaneBuffer logs;  // log energies of filters, then that of the frame
  LaneBuffer cepstra;
  std::vector<double> frame;
  std::vector<double> numbers;
  RastaFilter rasta;
  RunningNormaliser normaliser;
};

}  // namespace hri
