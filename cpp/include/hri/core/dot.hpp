// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The inner product behind filter banks and resampling, dispatched by processor at run time.
#pragma once

namespace hri {

/// Sum of a[i] b[i] over i < count, added up in eight lanes: equal on every processor.
float dot(const float* a, const float* b, int count);

}  // namespace hri
