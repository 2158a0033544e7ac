// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HInit: one model from recordings of its unit alone. They are cut into equal parts, one a state,
// then along the best path through the model, again and again (HTK Book, section 8.2).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/model_set.hpp"

namespace hri::htk {

struct ViterbiTrainerOptions {
  int max_iterations = 20;
  double tolerance = 1e-4;
  double weight_floor = 0;
  double min_variance = 0.01;
  bool uniform_start = true;
  bool update_transitions = true;
  bool update_means = true;
  bool update_variances = true;
  bool update_weights = true;

  static constexpr const char* kName = "ViterbiTrainerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("max_iterations", o.max_iterations, within(0, 100000),
      "passes after that over equal parts, at most");
    v("tolerance", o.tolerance, within(0, 1e6),
      "training stops when the log probability of a recording grows by less (natural log)");
    v("weight_floor", o.weight_floor, within(0, 100000),
      "smallest mixture weight, in units of 1e-5");
    v("min_variance", o.min_variance, within(0, 1e12),
      "smallest variance; ~v \"varFloor1\" of the models holds beside it");
    v("uniform_start", o.uniform_start, any_value,
      "False: the model is good enough to begin with the best paths");
    v("update_transitions", o.update_transitions, any_value, "False: transitions stay");
    v("update_means", o.update_means, any_value, "False: means stay");
    v("update_variances", o.update_variances, any_value, "False: variances stay");
    v("update_weights", o.update_weights, any_value, "False: mixture weights stay");
  }
};

struct ViterbiTraining {
  ModelSet models;  ///< all of the set, what the model uses estimated
  /// Of the best paths, before each pass; natural log, all recordings together.
  std::vector<double> log_probabilities;
  bool converged = false;
};

/// Trains the model `hmm` on `recordings`, each (num_frames, vector_size). Its topology, number of
/// Gaussians and macros stay; steps of probability 0 stay impossible. Gaussians of a state begin at
/// the clusters of its frames; of discrete models, codewords of the equal parts are counted. Throws
/// InvalidArgument for no recording, one that is shorter than the model (names its number), values
/// not finite or no codeword, a model that there is not or that no path leads through, and options
/// out of range.
HRI_API ViterbiTraining train_by_viterbi(const ModelSet& models, const std::string& hmm,
                                         const std::vector<MatrixF>& recordings,
                                         const ViterbiTrainerOptions& options = {});

/// Frames on the shortest way through a model. Throws InvalidArgument for one that there is not,
/// and where there is no way.
HRI_API int min_frames_of(const ModelSet& models, const std::string& hmm);

}  // namespace hri::htk
