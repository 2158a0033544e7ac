// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Endpointing of a clip. Speech is voiced sound, sustained for a few frames, above the noise floor
// of its band; a word extends from there as far as any sound stands out of the noise. Neither the
// level nor stationary noise matters, and noise alone is no speech however loud it is.
#pragma once

#include <cstddef>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

struct ActivityOptions {
  double frame_ms = 25;       ///< 1..1000
  double shift_ms = 10;       ///< 1..1000
  double silence_dbfs = -70;  ///< frames below this hold nothing, -120..0
  double margin_db = 4;       ///< a sound is this much above the noise, over all bands, 0..60
  double max_depth_db = 30;   ///< and never more than this below the loudest voiced frame, 1..120
  double min_voicing = 1.15;  ///< how long and how clearly voiced a word is at least, 0..10
  double max_gap_ms = 300;    ///< silence within a word, as before a plosive, 0..2000
  double padding_ms = 30;     ///< kept before and after, 0..1000
};

/// Samples [first, last) hold the speech; `found` is false where there is none.
struct SpeechBounds {
  std::size_t first = 0;
  std::size_t last = 0;
  bool found = false;
  /// Stretches of speech with more than max_gap_ms of silence between them: 1 for a word.
  int num_utterances = 0;
};

/// Throws InvalidArgument for options out of range, a sample that is not finite (names it), and
/// audio shorter than one frame ("too short").
HRI_API SpeechBounds find_speech(Span<const float> audio, int sample_rate_hz,
                                 const ActivityOptions& options);

}  // namespace hri
