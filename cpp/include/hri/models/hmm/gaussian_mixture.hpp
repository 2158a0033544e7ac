// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A Gaussian mixture with diagonal covariance over single frames, trained by EM: the garbage model
// of rejection.
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/mixture_bank.hpp"
#include "hri/models/hmm/training_report.hpp"

namespace hri {

struct GaussianMixtureOptions {
  int num_mixtures = 16;
  int max_iterations = 15;
  double tolerance = 1e-3;
  double variance_floor = 0.01;
  double wide_weight = 0;
  std::uint64_t seed = 0;
  StopCheck should_stop;

  static constexpr const char* kName = "GaussianMixtureOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_mixtures", o.num_mixtures, within(1, 4096), "Gaussians");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations of EM at most");
    v("tolerance", o.tolerance, within(0, 1e6),
      "training stops when the log-likelihood a frame gains less");
    v("variance_floor", o.variance_floor, above(0, 1e6), "share of the global variance");
    v("wide_weight", o.wide_weight, within(0, 0.5),
      "weight of one more component, as wide as five deviations of all rows: a background model "
      "then explains also what lies far from its training data");
    v("seed", o.seed, any_seed, "of the start by k-means");
  }
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
