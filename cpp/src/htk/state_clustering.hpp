// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Groups of states that are alike: by the questions of a decision tree, and from the bottom up.
#pragma once

#include <string>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/htk/decision_trees.hpp"

namespace hri::htk::detail {

/// One Gaussian, and the frames that it was met in.
struct StateStatistics {
  std::string model;
  double occupation = 0;
  VectorD mean;
  VectorD variance;
};

/// The mean and variance of all frames of several states; of states without frames, each counts as
/// one. In `members`, at least one, are places in `states`.
StateStatistics pooled(const std::vector<StateStatistics>& states,
                       const std::vector<std::size_t>& members);

struct TiedByTree {
  DecisionTree tree;                             ///< leaves are "1", "2", ...
  std::vector<std::vector<std::size_t>> groups;  ///< of leaf "n" at n - 1
};

/// Splits the states by the question that makes them most likely, while their log likelihood grows
/// by at least `threshold` and both parts have at least `least_occupation` frames; then leaves are
/// merged that lose less than `threshold` by it.
TiedByTree tie_by_tree(const std::vector<StateStatistics>& states,
                       const std::vector<ContextQuestion>& questions, double threshold,
                       double least_occupation);

/// Merges the groups that are nearest by their furthest states, up to the distance `threshold`;
/// then groups with fewer than `least_occupation` frames with what is nearest. The distance of two
/// states is the root of the mean over columns of (difference of means)^2 / (product of
/// deviations).
std::vector<std::vector<std::size_t>> cluster(const std::vector<StateStatistics>& states,
                                              double threshold, double least_occupation);

}  // namespace hri::htk::detail
