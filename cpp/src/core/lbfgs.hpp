// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The least value of a smooth function of many variables: limited-memory BFGS with backtracking
// (Nocedal and Wright, "Numerical optimization", algorithms 7.4 and 3.1).
#pragma once

#include <functional>

#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

/// The value at `x`; sets the gradient, of the size of `x`.
using SmoothFunction = std::function<double(const VectorD& x, VectorD* gradient)>;

/// From `x` downhill until an iteration gains less than `tolerance` times the value, or for so many
/// iterations. Throws Interrupted when `should_stop` says so.
VectorD minimise(const SmoothFunction& function, VectorD x, int max_iterations, double tolerance,
                 const StopCheck& should_stop);

}  // namespace hri::detail
