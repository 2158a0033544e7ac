// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Several signals side by side, as many as a register of this machine holds: value n of signal l
// lies at [n * num_lanes() + l]. What is done to one value of each is then one instruction, and the
// numbers that come out do not depend on how many lie together.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/cache_line.hpp"
#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Signals side by side on this machine: 4, 8 or 16.
HRI_API int num_lanes();

/// Values that begin at a cache line.
using LaneBuffer = std::vector<float, detail::CacheLineAllocator<float>>;

/// The first `count` values of num_lanes() signals, side by side into `out` (count * num_lanes()).
HRI_API void interleave(Span<const float* const> signals, std::size_t count, Span<float> out);

}  // namespace hri
