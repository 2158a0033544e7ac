// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The recursions every HMM shares (Rabiner eq. 19-37): Viterbi and Baum-Welch. The forward
// recursion that scores is in forward_pass.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/hmm/forward_backward.hpp"
#include "hri/models/hmm/markov_chain.hpp"

namespace hri::detail {

/// log(v) with -inf for 0.
VectorD safe_log(const VectorD& values);
MatrixD safe_log(const MatrixD& values);

/// Emissions frame by frame, a value a state: rows of a matrix, or the rows of a table that symbols
/// choose.
template <class Scalar>
struct Rows {
  const Scalar* data = nullptr;
  std::ptrdiff_t stride = 0;
  std::ptrdiff_t num_frames = 0;
  const std::int32_t* symbols = nullptr;

  const Scalar* operator[](std::ptrdiff_t t) const {
    return data + (symbols == nullptr ? t : symbols[t]) * stride;
  }
};

template <class Scalar>
Rows<Scalar> rows_of(const Matrix<Scalar>& matrix) {
  return {matrix.data(), matrix.cols(), matrix.rows(), nullptr};
}

/// log P(frames, best path), and the path if wanted. An impossible sequence gives -inf and an empty
/// path. Allocates nothing once the thread has seen a sequence as long, and the path is reserved.
template <class Scalar>
double viterbi(const MarkovChain& chain, const Rows<Scalar>& log_b, std::vector<int>* path);

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

/// Forward and backward in logs, row by row.
ForwardBackward both_ways(const MarkovChain& chain, const Rows<double>& log_b);

/// The same for training: log P(frames), state posteriors in `gamma` (num_frames rows of
/// `stride` values, 0 beyond num_states), and the expected counts are added to `counts`, unless it
/// is null. An impossible sequence gives -inf, gamma zero, and adds nothing.
double forward_backward(const MarkovChain& chain, const Rows<double>& log_b, double* gamma,
                        std::ptrdiff_t stride, ChainCounts* counts);

/// The same with scaled probabilities, several times as fast. False, with `counts` untouched, where
/// a probability comes so close to 0 that accuracy would suffer; forward_backward() has to do it
/// then.
bool scaled_forward_backward(const MarkovChain& chain, const Rows<double>& b, PaddedMatrix* gamma,
                             ChainCounts* counts, double* log_likelihood);

/// The chain re-estimated from counts; states never visited keep the values of `previous`.
/// Structural zeros stay zero.
MarkovChain estimate_chain(const ChainCounts& counts, const MarkovChain& previous);

/// Adds `pseudo_count` to every transition that the topology has, and to every start that is
/// possible in `chain`.
void add_pseudo_counts(const MarkovChain& chain, double pseudo_count, ChainCounts* counts);

/// Uniform segmentation: the state of each of `num_frames` frames of a left-right model.
std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states);

}  // namespace hri::detail
