// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Possibility and necessity of events (thesis eq. 4.1-4.4). Eq. 4.2 is read as Zadeh and
// Dubois/Prade define it: its minimum runs over the complement of the event. Possibilities of
// classes (eq. 5.14) are in gaussian_bayes.hpp.
#pragma once

#include <vector>

#include "hri/core/types.hpp"

namespace hri {

/// Pi(A) = max of the distribution over the event; 0 for an empty event. `event` holds indices of
/// outcomes. Throws InvalidArgument for an index outside the distribution, or possibilities outside
/// 0..1 (names the index).
double possibility_of(Span<const double> distribution, const std::vector<int>& event);

/// N(A) = 1 - Pi(not A); 1 for the sure event. Throws as possibility_of does.
double necessity_of(Span<const double> distribution, const std::vector<int>& event);

}  // namespace hri
