// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the forward and the backward recursion of an HMM give (Rabiner eq. 19-25).
#pragma once

#include "hri/core/types.hpp"

namespace hri {

/// Natural logs, -inf for 0; both matrices have shape (num_frames, num_states). For every t the sum
/// over i of exp(log_forward(t, i) + log_backward(t, i)) is exp(log_likelihood), and its terms over
/// that sum are the state posteriors.
struct ForwardBackward {
  double log_likelihood = 0;  ///< log P(frames | model), -inf for an impossible sequence
  MatrixD log_forward;        ///< log P(frames 0..t, state of t = i)
  MatrixD log_backward;       ///< log P(frames after t | state of t = i); 0 in the last row
};

}  // namespace hri
