// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A sequence model of a new class from very few recordings. What they cannot show, how far states
// spread, comes from the models of the classes that are known: a prior for the variances (Gauvain
// and Lee, IEEE Trans. Speech and Audio Processing 2(2), 1994), and smoothing by symbols that occur
// together (Lee, "Automatic speech recognition", 1989).
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct FewSampleOptions {
  int num_recordings = 1;
  int max_iterations = 12;
  StopCheck should_stop;  ///< polled before every sequence of every iteration

  static constexpr const char* kName = "FewSampleOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_recordings", o.num_recordings, within(1, 1000000),
      "recordings that the sequences stand for: copies of a recording count once");
    v("max_iterations", o.max_iterations, within(1, 100000), "iterations of Baum-Welch at most");
  }
};

/// One Gaussian a state, in the topology of `known`, left-right in all. Its mean is that of the
/// recordings. Its variance is that of the recordings and the mean variance inside the known
/// states, which weighs as much as two recordings. (A mean drawn to those of other states, and a
/// variance wider by what it is uncertain by, would be the predictive density: that of a new word
/// is then so wide, beside the others, that it takes their words.) Throws InvalidArgument for no
/// model, no data, frames that do not fit or are not finite (names sequence, row, column).
HRI_API GaussianMixtureHmm train_few(const std::vector<GaussianMixtureHmm>& known,
                                     const std::vector<MatrixF>& sequences,
                                     const FewSampleOptions& options);

/// The same over symbols: a state that emits a symbol also emits those that the known states emit
/// along with it, the more the fewer recordings there are. Smaller emissions are raised to
/// `emission_floor`, 0..1 / num_symbols, before those of a state are scaled to sum to 1: then they
/// may lie a little below.
HRI_API DiscreteHmm train_few(const std::vector<DiscreteHmm>& known,
                              const std::vector<SymbolSequence>& sequences, double emission_floor,
                              const FewSampleOptions& options);

}  // namespace hri
