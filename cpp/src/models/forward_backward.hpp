// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The recursions every HMM shares, in logs: rows of `log_b` are frames, columns states (Rabiner eq.
// 19-37).
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/topology.hpp"

namespace hri::detail {

/// Parameters of the chain; logs are -inf where the topology has no transition.
struct Chain {
  const Topology& topology;
  const VectorD& log_start;
  const MatrixD& transition;
  const MatrixD& log_transition;
};

/// log(v) with -inf for 0.
VectorD safe_log(const VectorD& values);
MatrixD safe_log(const MatrixD& values);

/// log P(frames); Scalar of log_b is float (scoring) or double (training).
template <class Scalar>
double forward(const Chain& chain, const Matrix<Scalar>& log_b);

/// log P(frames, best path), and the path if wanted. An impossible sequence gives -inf and an empty
/// path.
template <class Scalar>
double viterbi(const Chain& chain, const Matrix<Scalar>& log_b, std::vector<int>* path);

/// Expected counts of one pass over the training data.
struct ChainCounts {
  VectorD start;
  MatrixD transition;
  explicit ChainCounts(int num_states)
      : start(VectorD::Zero(num_states)), transition(MatrixD::Zero(num_states, num_states)) {}
};

/// Forward and backward: log P(frames), state posteriors `gamma` (num_frames, num_states), and the
/// expected counts are added to `counts`. An impossible sequence gives -inf, gamma zero, and adds
/// nothing.
double forward_backward(const Chain& chain, const MatrixD& log_b, MatrixD* gamma,
                        ChainCounts* counts);

/// Start and transition probabilities from counts; rows never visited keep `previous`. Structural
/// zeros stay zero.
void estimate_chain(const ChainCounts& counts, VectorD* start, MatrixD* transition);

/// What is wrong with a chain: nullptr when start and the rows of transition are distributions of
/// the topology's shape and structure.
const char* chain_fault(const Topology& topology, const VectorD& start, const MatrixD& transition);

/// Uniform segmentation: the state of each of `num_frames` frames of a left-right model.
std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states);

}  // namespace hri::detail
