// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Densities of shared Gaussians, and the sums that they are estimated from.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "htk/shared_parameters.hpp"

namespace hri::htk::detail {

/// Log densities of the states of a model set. Not for several threads.
class SharedDensities {
 public:
  explicit SharedDensities(const SharedParameters& parameters);

  /// The log density of a state; those of its components with their weights are in components().
  double state(int number, const VectorD& frame);
  [[nodiscard]] const std::vector<double>& components() const { return logs_; }
  /// The slot of the first of them; of a discrete state, which has one, that of its codeword.
  [[nodiscard]] std::size_t first_slot() const { return first_slot_; }

 private:
  struct Gaussian {
    VectorD mean;
    VectorD precision;
    double constant = 0;
  };
  std::vector<Gaussian> gaussians_;
  std::vector<std::vector<int>> states_;
  std::vector<std::vector<double>> log_weights_;
  std::vector<double> logs_;
  std::size_t first_slot_ = 0;
};

/// Expected counts, and moments about the means before estimation.
class SharedSums {
 public:
  explicit SharedSums(const SharedParameters& parameters);

  /// Adds a frame to component `slot`, or codeword `slot` from 0, of a state.
  void add(int state, std::size_t slot, const VectorD& frame, double probability);

  [[nodiscard]] double occupation(int state) const;

  /// Estimates of the states that are `marked`, and of what they share.
  void estimate_weights(const std::vector<bool>& marked, double floor,
                        SharedParameters* parameters) const;
  void estimate_means(const std::vector<bool>& marked, SharedParameters* parameters) const;
  /// About the means in `parameters`.
  void estimate_variances(const std::vector<bool>& marked, const VectorD& floor,
                          SharedParameters* parameters) const;

  void write(ModelFile* file) const;
  /// Adds those of a file. Throws FormatError naming file and field for other sizes, and counts
  /// below 0.
  void add(const ModelFile& file);

  std::vector<MatrixD> transitions;  ///< counts, by the place of the matrix

 private:
  [[nodiscard]] std::vector<bool> components_of(const std::vector<bool>& marked) const;

  SharedParameters before_;
  std::vector<std::vector<double>> slots_;  // of every state
  VectorD counts_;                          // of every component, and its moments
  MatrixD firsts_;
  MatrixD seconds_;
};

}  // namespace hri::htk::detail
