// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How an iterative training went.
#pragma once

#include <vector>

namespace hri {

struct TrainingReport {
  std::vector<double> log_likelihoods;  ///< of all sequences, before each re-estimation
  bool converged = false;               ///< false: the iteration limit ended it
};

}  // namespace hri
