// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How a caller interrupts a training.
#pragma once

#include <functional>

#include "hri/core/error.hpp"

namespace hri {

/// Polled at least once an iteration by every training; true ends it with hri::Interrupted, and
/// nothing is kept.
using StopCheck = std::function<bool()>;

/// Throws Interrupted when `should_stop` is set and says so.
inline void poll(const StopCheck& should_stop) {
  if (should_stop && should_stop()) fail(ErrorKind::interrupted, "training interrupted");
}

}  // namespace hri
