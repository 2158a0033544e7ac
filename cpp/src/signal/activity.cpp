// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/activity.hpp"

#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/activity_meter.hpp"
#include "signal/word_bounds.hpp"

namespace hri {

SpeechBounds find_speech(Span<const float> audio, int sample_rate_hz,
                         const ActivityOptions& options) {
  ActivityMeter meter(sample_rate_hz, options);
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size()) {
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  }
  std::vector<ActivityFrame> frames;
  frames.reserve(audio.size() / meter.frame_shift() + 1);
  for (std::size_t at = 0; at < audio.size();) {
    ActivityFrame frame;
    bool complete = false;
    at += meter.take(audio.subspan(at, audio.size() - at), &frame, &complete);
    if (complete) frames.push_back(frame);
  }
  if (frames.empty()) {
    fail(ErrorKind::invalid_argument, "audio is too short: " + std::to_string(audio.size()) +
                                          " samples, one frame takes " +
                                          std::to_string(meter.frame_length()));
  }
  const detail::WordFrames word = detail::WordFinder(meter, options).find(frames);
  return detail::to_samples(word, meter, options, sample_rate_hz, audio.size());
}

}  // namespace hri
