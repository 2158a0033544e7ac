// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Maximum a posteriori adaptation of Gaussian mixtures (Gauvain and Lee, IEEE Trans. Speech and
// Audio Processing 2(2), 1994): a trained model is the prior, the data of a new person or room
// move it as far as there are data.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct MapAdaptationOptions {
  double prior_frames = 10;
  int num_iterations = 3;
  StopCheck should_stop;  ///< polled before every sequence of every iteration

  static constexpr const char* kName = "MapAdaptationOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("prior_frames", o.prior_frames, above(0, 1e12),
      "frames of new data that weigh as much as the prior, a state; its Gaussians share them by "
      "their weights");
    v("num_iterations", o.num_iterations, within(1, 1000),
      "iterations of expectation and maximisation");
  }
};

/// Means, variances and weights of `model` adapted to `sequences`; its chain stays. Variances do
/// not fall below a tenth of the model's own. Without sequences the model itself. Throws
/// InvalidArgument for frames that do not fit or are not finite (names sequence, row, column).
HRI_API GaussianMixtureHmm adapt_map(const GaussianMixtureHmm& model,
                                     const std::vector<MatrixF>& sequences,
                                     const MapAdaptationOptions& options);

/// The same for a mixture over single frames, which counts as one state.
HRI_API GaussianMixture adapt_map(const GaussianMixture& model,
                                  const std::vector<MatrixF>& sequences,
                                  const MapAdaptationOptions& options);

}  // namespace hri
