// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the training of every recogniser shares: progress, interruption, sorted labels and held-out
// folds by person.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/stop_check.hpp"

namespace hri {

/// Called with (done, total) steps of a training, from (0, total) to (total, total), by the thread
/// that trains.
using TrainingProgress = std::function<void(int done, int total)>;

/// The distinct labels in sorted order. Throws InvalidArgument for fewer than two, or an empty
/// name, or one that a Decision uses itself ("unknown", "no_input").
HRI_API std::vector<std::string> sorted_labels(const std::vector<std::string>& labels);

/// Index of `label` in the sorted `labels`.
HRI_API int label_index(const std::vector<std::string>& labels, const std::string& label);

/// A fold number (0..num_folds-1) for every sample, so that no group stands in two folds; at most
/// `max_folds`. With fewer than two groups the samples of each label are dealt out in turn.
HRI_API std::vector<int> held_out_folds(const std::vector<int>& classes,
                                        const std::vector<std::string>& groups, int max_folds);

}  // namespace hri
