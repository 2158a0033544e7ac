// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Endpointing of a clip. Speech is voiced sound, sustained for a few frames, above the noise floor
// of its band; a word extends from there as far as any sound stands out of the noise. Neither the
// level nor stationary noise matters, and noise alone is no speech however loud it is.
#pragma once

#include <cstddef>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

struct ActivityOptions {
  double frame_ms = 25;
  double shift_ms = 10;
  double silence_dbfs = -70;
  double margin_db = 4;
  double max_depth_db = 30;
  double min_voicing = 1.15;
  double max_gap_ms = 300;
  double padding_ms = 30;

  static constexpr const char* kName = "ActivityOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("frame_ms", o.frame_ms, within(1, 1000), "length of a frame");
    v("shift_ms", o.shift_ms, within(1, 1000), "time from frame to frame");
    v("silence_dbfs", o.silence_dbfs, within(-120, 0), "level below which a frame is silent");
    v("margin_db", o.margin_db, within(0, 60), "how far sound is above the noise, over all bands");
    v("max_depth_db", o.max_depth_db, within(1, 120),
      "lowest level of a sound, below the loudest voiced frame");
    v("min_voicing", o.min_voicing, within(0, 10),
      "least voicing of a word, its clarity times its duration");
    v("max_gap_ms", o.max_gap_ms, within(0, 2000),
      "longest silence within a word, as before a plosive");
    v("padding_ms", o.padding_ms, within(0, 1000), "kept before and after the word");
  }
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
