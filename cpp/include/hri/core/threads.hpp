// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How many threads training uses. What is trained is the same to the bit for any number.
#pragma once

#include "hri/core/export.hpp"

namespace hri {

/// At most this many threads train from now on, in this process; 0 (as at the start): one for each
/// processor. Throws InvalidArgument for a negative number. Built without exceptions, libhri trains
/// on the calling thread alone.
HRI_API void set_num_threads(int count);

/// As set, with the number of processors for 0.
HRI_API int num_threads();

}  // namespace hri
