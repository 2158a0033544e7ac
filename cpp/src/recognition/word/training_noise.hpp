// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Noise that is laid over copies of training words, so that models meet it before users do.
#pragma once

#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

/// Of no sample: 0.
double mean_power(Span<const float> audio);

/// `audio` with random noise of mean power `power`: white noise through a one-pole low-pass of
/// random corner, from flat to a rumble.
std::vector<float> with_noise(Span<const float> audio, double power, Random* random);

}  // namespace hri::detail
