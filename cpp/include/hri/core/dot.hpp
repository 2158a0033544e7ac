// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The inner product behind filter banks, resampling and linear classifiers, dispatched by processor
// at run time.
#pragma once

namespace hri {

/// Sum of a[i] b[i] over i < count, added up in sixteen lanes: equal on every processor.
float dot(const float* a, const float* b, int count);

}  // namespace hri
