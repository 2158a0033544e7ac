// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A word cut from a recording, so that it sounds alike wherever it comes from: with pauses before
// and after it, also from a clip that has none, and with a floor of noise, so that the pauses of a
// quiet room and digital silence are the same.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/signal/activity.hpp"

namespace hri::detail {

/// The word in `audio` and activity.padding_ms before and after it, silence where the recording has
/// none, with white noise `floor_db` below the loudest sample of the word; empty where nobody
/// speaks. The noise is the same every time.
std::vector<float> cut_word(Span<const float> audio, int sample_rate_hz,
                            const ActivityOptions& activity, double floor_db);

}  // namespace hri::detail
