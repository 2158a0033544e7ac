// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Trimming of a recording to its word, over a noise floor of its own: what lies before, after and
// below the word no longer matters, be it a room, a pause or digital silence.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/signal/activity.hpp"

namespace hri::detail {

/// The word in `audio`, which lies within `speech` (end points without padding), and
/// activity.padding_ms before and after it, zero-padded where the recording ends, with white noise
/// `noise_floor_db` below the peak of the word. The noise is the same every time.
std::vector<float> trim_to_word(Span<const float> audio, const SpeechBounds& speech,
                                int sample_rate_hz, const ActivityOptions& activity,
                                double noise_floor_db);

/// Adds white noise of this standard deviation, the same every time.
void add_noise_floor(double deviation, std::vector<float>* audio);

}  // namespace hri::detail
