// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Independent tasks on several threads.
#pragma once

#include <cstddef>
#include <functional>

#include "hri/core/stop_check.hpp"

namespace hri::detail {

/// Calls `task(i, stop)` for every i below `count`, in this order as threads become free; where the
/// order matters to the result, tasks write to places of their own. The calling thread takes part.
/// `stop` may be polled from any thread: it is `should_stop` on the calling one, and says on all
/// others what that one has found. Within a task, further calls run on the task's own thread.
///
/// Throws what a loop would have thrown, once every task that began has ended: the exception of the
/// first task in order; Interrupted where `should_stop` says so.
void parallel_for(std::size_t count, const StopCheck& should_stop,
                  const std::function<void(std::size_t, const StopCheck&)>& task);

}  // namespace hri::detail
