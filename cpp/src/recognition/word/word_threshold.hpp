// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The threshold of rejection where both kinds of error have a rate that is asked for.
#pragma once

#include <vector>

namespace hri::detail {

/// The least of the scores of `right` words at which the share of them that lies below, divided by
/// `false_reject` (0..1), is no less than the share of `others` that does not, divided by
/// `false_accept` (0..1): both rates are kept to, or both are exceeded, by about the same factor.
/// The largest score of `right` where none is. `right` must not be empty.
float balanced_threshold(std::vector<float> right, std::vector<float> others, double false_reject,
                         double false_accept);

}  // namespace hri::detail
