// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A bank of Gaussian mixtures with diagonal covariance, one mixture a state: emissions of an HMM,
// or with one state a plain mixture. Trained in double, scored in float.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/padded_matrix.hpp"

namespace hri {

class MixtureBank;

namespace detail {
struct Alignment;

/// Log densities in double of frames that are known to be finite: of every state to rows of
/// `stride` values, and, where states have several components and `shares` is not null, the share
/// of every component in the density of its state to rows of `share_stride`.
void log_densities_of_finite(const MixtureBank& bank, ConstMatrixRefF frames, double* out,
                             std::ptrdiff_t stride, double* shares, std::ptrdiff_t share_stride);
}  // namespace detail

/// Immutable; const calls are safe from several threads. Invariant: weights of a state sum to 1,
/// variances > 0.
class HRI_API MixtureBank {
 public:
  MixtureBank() = default;
  /// `weights` (num_states, num_mixtures); `means`, `variances` (num_states * num_mixtures, dim),
  /// state by state. Throws InvalidArgument for shapes that do not fit, values not finite,
  /// variances <= 0, weights that do not sum to 1.
  MixtureBank(MatrixD weights, MatrixD means, MatrixD variances);

  [[nodiscard]] int num_states() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int num_mixtures() const { return static_cast<int>(weights_.cols()); }
  [[nodiscard]] int dim() const { return static_cast<int>(means_.cols()); }
  [[nodiscard]] const MatrixD& weights() const { return weights_; }
  [[nodiscard]] const MatrixD& means() const { return means_; }
  [[nodiscard]] const MatrixD& variances() const { return variances_; }

  /// log b_j(x_t) for all frames (rows) and states (columns), natural log, in float; `out` is
  /// (num_frames, num_states). This and those below throw InvalidArgument for frames that are not
  /// finite or not dim() wide.
  void log_densities(ConstMatrixRefF frames, MatrixRefF out) const;

  /// The same in double, with the share of every component in the density of its state,
  /// (num_frames, num_states * num_mixtures), if wanted.
  void log_densities(ConstMatrixRefF frames, MatrixD* out, MatrixD* shares) const;

  /// The same for `out` of (num_frames, num_states) values, row by row; allocates nothing once the
  /// thread has used a bank as large.
  void log_densities(ConstMatrixRefF frames, double* out) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static MixtureBank read(const ModelFile& file, const std::string& prefix);

 private:
  friend void detail::log_densities_of_finite(const MixtureBank& bank, ConstMatrixRefF frames,
                                              double* out, std::ptrdiff_t stride, double* shares,
                                              std::ptrdiff_t share_stride);

  MatrixD weights_;
  MatrixD means_;
  MatrixD variances_;
  // The log density of a component is constant - 0.5 * sum((x - mean)^2 * precision); means and
  // precisions stand by columns, in double and in float.
  detail::AlignedVector constants_;
  detail::AlignedVector columns_;
  std::vector<float, detail::CacheLineAllocator<float>> constants_f_;
  std::vector<float, detail::CacheLineAllocator<float>> columns_f_;
};

/// How a bank is estimated from sums.
struct BankEstimation {
  VectorD variance_floor;   ///< (dim)
  double weight_floor = 0;  ///< smaller weights are raised to it; as all are rescaled to sum to 1
                            ///< then, the smallest may lie below
  double weight_prior = 0;  ///< imagined frames of every component
  bool tied_variance = false;  ///< one vector of variances for all components of all states
};

/// Weighted sums of one pass over the data, from which a bank is re-estimated (M step).
class HRI_API MixtureAccumulator {
 public:
  MixtureAccumulator(int num_states, int num_mixtures, int dim);

  /// Adds one sequence: `gamma` (num_frames, num_states) are state posteriors; `shares` as
  /// MixtureBank::log_densities gave them. Throws InvalidArgument for shapes that do not fit.
  void add(ConstMatrixRefF frames, const MatrixD& gamma, const MatrixD& shares);

  /// Adds imagined frames, as `prior` would have given them: `frames_per_state` of every state,
  /// shared by its components as their weights say.
  void add_prior(const MixtureBank& prior, double frames_per_state);

  /// The re-estimated bank; states and components without data keep `previous`.
  [[nodiscard]] MixtureBank estimate(const MixtureBank& previous,
                                     const BankEstimation& options) const;

  /// Of every component: weight of its frames (num_states * num_mixtures), their weighted sum and
  /// sum of squares, (num_states * num_mixtures, dim).
  [[nodiscard]] VectorD counts() const;
  [[nodiscard]] MatrixD sums() const { return columns(0, dim_); }
  [[nodiscard]] MatrixD squares() const { return columns(dim_, dim_); }

  /// As add() above; private to the library.
  void add(ConstMatrixRefF frames, const detail::Alignment& alignment);

 private:
  [[nodiscard]] MatrixD columns(Eigen::Index first, Eigen::Index count) const;

  Eigen::Index num_mixtures_;
  Eigen::Index dim_;
  detail::PaddedMatrix totals_;  // of a component: sums, squares, count
};

/// Mean and variance of all rows of all sequences, each (dim).
struct GlobalStatistics {
  VectorD mean;
  VectorD variance;
};
HRI_API GlobalStatistics global_statistics(const std::vector<MatrixF>& sequences);

/// The state of every frame by k-means over all of them (standardised), seeded by rows far apart.
HRI_API std::vector<std::vector<int>> cluster_frames(const std::vector<MatrixF>& sequences,
                                                     int num_states, std::uint64_t seed,
                                                     const StopCheck& should_stop);

/// A first bank from frames already assigned to states: k-means within each state, seeded. States
/// without frames get the global statistics.
HRI_API MixtureBank initial_bank(const std::vector<MatrixF>& sequences,
                                 const std::vector<std::vector<int>>& states, int num_states,
                                 int num_mixtures, const VectorD& variance_floor,
                                 std::uint64_t seed);

}  // namespace hri
