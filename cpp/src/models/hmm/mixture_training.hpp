// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of the training of mixture banks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/models/hmm/mixture_bank.hpp"
#include "hri/models/hmm/padded_matrix.hpp"

namespace hri::detail {

/// How likely states and components are for the frames of a sequence, as of
/// MixtureAccumulator::add; frames are a stride apart. With one component a state, only `gamma` is
/// read.
struct Alignment {
  const double* gamma = nullptr;
  std::ptrdiff_t gamma_stride = 0;  ///< 0: one row for all frames
  const double* shares = nullptr;   ///< of components in the density of their state
  std::ptrdiff_t share_stride = 0;
};

/// Throws InvalidArgument for frames that are not `dim` wide.
void require_width(ConstMatrixRefF frames, Eigen::Index dim);

/// The centre that is nearest to a row: what minCoeff() finds among squaredNorm()s of Eigen,
/// searched faster. Not for several threads at once.
class NearestCentre {
 public:
  /// Keeps a reference to the centres.
  explicit NearestCentre(const MatrixD& centres);
  [[nodiscard]] int find(const double* row);

 private:
  const MatrixD& centres_;
  AlignedVector columns_;
  AlignedVector distances_;
};

/// As hri::initial_bank, where the statistics of the sequences are known.
MixtureBank initial_bank(const std::vector<MatrixF>& sequences,
                         const std::vector<std::vector<int>>& states, int num_states,
                         int num_mixtures, const VectorD& variance_floor, std::uint64_t seed,
                         const GlobalStatistics& global);

}  // namespace hri::detail
