// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Noise that is laid over copies of training words, so that models meet it before users do.
#pragma once

#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

/// `word` with random noise whose power is `snr_db` below its own: white noise through a one-pole
/// low-pass of random corner, from flat to a rumble.
std::vector<float> with_noise(Span<const float> word, double snr_db, Random* random);

}  // namespace hri::detail
