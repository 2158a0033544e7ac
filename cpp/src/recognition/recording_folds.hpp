// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Folds of recordings where persons cannot be held out.
#pragma once

#include <string>
#include <vector>

namespace hri::detail {

/// Whether some fold can be held out: without it every class that there is has a sample left.
bool any_fold_is_usable(const std::vector<int>& classes, const std::vector<int>& folds);

/// The samples of each class dealt out to `max_folds` folds in turn.
std::vector<int> dealt_folds(const std::vector<int>& classes, int max_folds);

/// `held_out_folds`; but `dealt_folds` where none of these can be held out, as where each of two
/// persons alone recorded some word.
std::vector<int> usable_folds(const std::vector<int>& classes,
                              const std::vector<std::string>& groups, int max_folds);

}  // namespace hri::detail
