// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A Gaussian mixture with diagonal covariance over single frames, trained by EM: the garbage model
// of rejection.
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/mixture_bank.hpp"
#include "hri/models/hmm/training_report.hpp"

namespace hri {

struct GaussianMixtureOptions {
  int num_mixtures = 16;         ///< 1..4096
  int max_iterations = 15;       ///< EM iterations, 1..100000
  double tolerance = 1e-3;       ///< stop when the log-likelihood a frame gains less, >= 0
  double variance_floor = 0.01;  ///< share of the global variance, > 0
  /// Weight of one more component, as wide as five deviations of all rows, 0..0.5: as a background
  /// model the mixture then explains also what lies far from its training data.
  double wide_weight = 0;
  std::uint64_t seed = 0;  ///< of the k-means start
  StopCheck should_stop;
};

/// Immutable; const calls are safe from several threads.
class HRI_API GaussianMixture {
 public:
  /// Throws InvalidArgument for a bank that has not one state.
  explicit GaussianMixture(MixtureBank bank);

  /// Throws InvalidArgument for no rows or values not finite.
  static GaussianMixture train(ConstMatrixRefF rows, const GaussianMixtureOptions& options,
                               TrainingReport* report = nullptr);

  /// Sum over the frames of log p(frame), natural log.
  [[nodiscard]] double log_likelihood(ConstMatrixRefF frames) const;

  [[nodiscard]] int dim() const { return bank_.dim(); }
  [[nodiscard]] const MixtureBank& bank() const { return bank_; }

  void write(ModelFile& file, const std::string& prefix) const { bank_.write(file, prefix); }
  static GaussianMixture read(const ModelFile& file, const std::string& prefix);

 private:
  MixtureBank bank_;
};

}  // namespace hri
