// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Counts the allocations of this program: operator new of all kinds, and the malloc family as far
// as it is called from objects that the linker put in (--wrap), which is how Eigen allocates.
#pragma once

#include <cstdint>

namespace hri::testing_data {

/// Allocations by the calling thread so far.
std::int64_t num_allocations();

/// Those that `action` makes.
template <class Action>
std::int64_t allocations_of(const Action& action) {
  const std::int64_t before = num_allocations();
  action();
  return num_allocations() - before;
}

}  // namespace hri::testing_data
