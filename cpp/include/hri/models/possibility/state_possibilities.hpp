// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a possibility-theory HMM says of its states, frame by frame: the forward recursion (thesis
// eq. 4.10-4.11), the backward one (eq. 4.15-4.16) and both joined (eq. 4.23).
//
// Eq. 4.16 has phi_t(i) where gamma_{t+1}(j) has to stand, and joins with max as eq. 4.11 does.
// Read as the forward recursion is, "and" being the conjunction of the rule:
//   gamma_T(i) = 1,  gamma_t(i) = max over j of (s_ij and pi_j(o_{t+1}) and gamma_{t+1}(j)).
// Then the largest (phi_t(i) and gamma_t(i)) of every frame is the possibility of the whole
// sequence, and eq. 4.17 is the case of the first frame. Under the literal max gamma is 1 in all
// states at all frames, and so is what is joined with it: it separates no states.
#pragma once

#include "hri/core/types.hpp"

namespace hri {

/// Of one class and one sequence. All matrices have shape (num_frames, num_states); logs are
/// natural, -inf for impossible.
struct StatePossibilities {
  double log_possibility = 0;  ///< of the whole sequence (eq. 4.12): the score of viterbi()
  /// phi_t(i), of the best path through frames 0..t that ends in i. Under a conditioned minimum the
  /// best of every row is 0, and log_possibility alone has what conditioning took.
  MatrixD log_forward;
  /// gamma_t(i), of the best way on from i through the frames after t; 0 in the last row. Under a
  /// conditioned minimum on the scale of log_forward.
  MatrixD log_backward;
  /// xi_t(i), of state i at frame t given all frames: phi_t(i) and gamma_t(i), over the largest of
  /// the frame, so that the best state has 1. All 1 where the sequence is impossible.
  MatrixD possibility;
  /// Of state i at frame t given all frames: 1 - the possibility of the best other state; above 0
  /// in one state at most. 0 where the sequence is impossible.
  MatrixD necessity;
};

}  // namespace hri
