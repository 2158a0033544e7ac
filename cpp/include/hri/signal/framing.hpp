// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cutting a signal into overlapping frames, and the window that is laid over each.
#pragma once

#include <cstddef>
#include <vector>

namespace hri {

/// How many whole frames of `frame_length` fit, one every `frame_shift` samples; both at least 1.
int num_frames(std::size_t num_samples, int frame_length, int frame_shift);

/// Symmetric Hamming window 0.54 - 0.46 cos(2 pi n / (size - 1)), as HTK and the thesis use; size
/// >= 1.
std::vector<float> hamming_window(int size);

}  // namespace hri
