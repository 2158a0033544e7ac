// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The decision that clips and streams share: which frames hold a word.
#pragma once

#include <array>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/signal/activity.hpp"
#include "hri/signal/activity_meter.hpp"

namespace hri::detail {

/// Throws InvalidArgument that names the field.
void check(const ActivityOptions& options, int sample_rate_hz);

/// The level of the noise in every band.
using NoiseFloor = std::array<float, kMaxActivityBands>;

/// How far a frame stands out of the noise, in dB over all bands and over those of the pitch.
struct Excess {
  float all_db = 0;
  float low_db = 0;
};
Excess excess(const ActivityFrame& frame, const NoiseFloor& noise, const ActivityMeter& meter);

/// Accumulates how long and how clearly a sound is voiced; noise leads it back to zero.
float add_voicing(float sum, const ActivityFrame& frame, float low_excess_db);

/// Frames [first, last) hold the word.
struct WordFrames {
  std::size_t first = 0;
  std::size_t last = 0;
  bool found = false;
  int num_utterances = 0;
};

/// Decides; keeps its work space, so that it allocates only where a clip is longer than any before.
class WordFinder {
 public:
  WordFinder(const ActivityMeter& meter, const ActivityOptions& options);

  void reserve(std::size_t num_frames);
  WordFrames find(Span<const ActivityFrame> frames);

 private:
  void measure_noise(Span<const ActivityFrame> frames);
  [[nodiscard]] int count_utterances(Span<const ActivityFrame> frames, const WordFrames& word,
                                     float lowest_db) const;

  const ActivityMeter* meter_;
  ActivityOptions options_;
  NoiseFloor noise_{};
  std::vector<float> sorted_;
  std::vector<Excess> excess_;  // of every frame
};

/// Samples around `word`, with padding, within a clip of `num_samples`.
SpeechBounds to_samples(const WordFrames& word, const ActivityMeter& meter,
                        const ActivityOptions& options, int sample_rate_hz,
                        std::size_t num_samples);

}  // namespace hri::detail
