// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Where somebody speaks in a clip: frame energy against the clip's own noise floor and peak, so
// that neither the level nor stationary noise matters.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri {

struct ActivityOptions {
  double frame_ms = 25;  ///< 1..1000
  double shift_ms = 10;  ///< 1..1000
  double silence_dbfs =
      -60;                   ///< a clip whose loudest frame stays below this holds nothing, -120..0
  double min_range_db = 6;   ///< loudest frame over the noise floor; steady noise has less, 0..60
  double margin_db = 6;      ///< speech is this much above the noise floor, 0..60
  double max_depth_db = 30;  ///< and never more than this below the loudest frame, 1..120
  double padding_ms = 30;    ///< kept before and after, 0..1000
};

/// Samples [first, last) hold the word; `found` is false where nobody speaks.
struct SpeechBounds {
  std::size_t first = 0;
  std::size_t last = 0;
  bool found = false;
};

/// Throws InvalidArgument for options out of range, a sample that is not finite (names it), and
/// audio shorter than one frame ("too short").
SpeechBounds find_speech(Span<const float> audio, int sample_rate_hz,
                         const ActivityOptions& options);

}  // namespace hri
