// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Possibility and necessity of events (thesis eq. 4.1-4.4), and of classes from their densities
// (eq. 5.14). Eq. 4.2 is read as Zadeh and Dubois/Prade define it: its minimum runs over the
// complement of the event.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Pi(A) = max of the distribution over the event; 0 for an empty event. `event` holds indices of
/// outcomes. Throws InvalidArgument for an index outside the distribution, or possibilities outside
/// 0..1 (names the index).
HRI_API double possibility_of(Span<const double> distribution, const std::vector<int>& event);

/// N(A) = 1 - Pi(not A); 1 for the sure event. Throws as possibility_of does.
HRI_API double necessity_of(Span<const double> distribution, const std::vector<int>& event);

/// Of each class: `possibility` is its density over the largest, `necessity` is 1 - the best other
/// class's possibility: the honest confidence, 0 for all but the best class.
struct Possibilities {
  VectorF possibility;
  VectorF necessity;
};

/// From natural logs, shape (num_classes,). Where every density is 0 nothing is known: every class
/// is fully possible and none necessary. Throws InvalidArgument for no classes, NaN or +inf (names
/// the class).
HRI_API Possibilities possibilities(const VectorF& log_densities);

}  // namespace hri
