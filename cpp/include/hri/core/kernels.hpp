// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Small loops that several folders share, dispatched by processor at run time.
#pragma once

#include <cstddef>

#include "hri/core/export.hpp"

namespace hri {

/// Sum of a[i] b[i] over i < count, added up in sixteen lanes: equal on every processor.
HRI_API float dot(const float* a, const float* b, int count);

/// Index of the first value that is NaN or infinite; `count` where there is none.
HRI_API std::size_t first_not_finite(const float* values, std::size_t count);

}  // namespace hri
