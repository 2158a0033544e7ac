// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The recursions every HMM shares, in logs: rows of `log_b` are frames, columns states (Rabiner eq.
// 19-37).
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/markov_chain.hpp"

namespace hri::detail {

/// log(v) with -inf for 0.
VectorD safe_log(const VectorD& values);
MatrixD safe_log(const MatrixD& values);

/// log P(frames); Scalar of log_b is float (scoring) or double (training).
template <class Scalar>
double forward(const MarkovChain& chain, const Matrix<Scalar>& log_b);

/// log P(frames, best path), and the path if wanted. An impossible sequence gives -inf and an empty
/// path.
template <class Scalar>
double viterbi(const MarkovChain& chain, const Matrix<Scalar>& log_b, std::vector<int>* path);

/// Expected counts of one pass over the training data.
struct ChainCounts {
  VectorD start;
  MatrixD band;   ///< steps within the band, or all where the topology has no jumps
  VectorD leave;  ///< jumps, by the state they left
  VectorD land;   ///< jumps, by the state they landed in
  explicit ChainCounts(int num_states)
      : start(VectorD::Zero(num_states)),
        band(MatrixD::Zero(num_states, num_states)),
        leave(VectorD::Zero(num_states)),
        land(VectorD::Zero(num_states)) {}
};

/// Forward and backward: log P(frames), state posteriors `gamma` (num_frames, num_states), and the
/// expected counts are added to `counts`. An impossible sequence gives -inf, gamma zero, and adds
/// nothing.
double forward_backward(const MarkovChain& chain, const MatrixD& log_b, MatrixD* gamma,
                        ChainCounts* counts);

/// The chain re-estimated from counts; states never visited keep the values of `previous`.
/// Structural zeros stay zero.
MarkovChain estimate_chain(const ChainCounts& counts, const MarkovChain& previous);

/// Uniform segmentation: the state of each of `num_frames` frames of a left-right model.
std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states);

}  // namespace hri::detail
