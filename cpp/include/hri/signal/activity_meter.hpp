// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The frame features of endpointing: levels in octave-like bands, and how periodic the
// sound is at the pitch of voices (peak of the normalised autocorrelation; Boersma, IFA Proceedings
// 17, 1993, discusses its pitfalls).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

constexpr int kMaxActivityBands = 5;

struct ActivityFrame {
  float level_db = 0;  ///< mean power above 60 Hz relative to full scale; digital silence is -120
  float voicing = 0;   ///< largest normalised autocorrelation over the lags of voice pitch, 0..1
  std::array<float, kMaxActivityBands> band_db{};  ///< the same by band; only num_bands() are used
};

/// Turns samples into frames. Block sizes do not matter; nothing is allocated after construction.
class HRI_API ActivityMeter {
 public:
  /// Throws InvalidArgument for options out of range and a rate outside 1000..384000 Hz.
  ActivityMeter(int sample_rate_hz, const ActivityOptions& options);

  /// Takes samples up to the end of the next frame, and says how many; `complete` says whether it
  /// got that far, and then `frame` is filled. Samples must be finite.
  std::size_t take(Span<const float> samples, ActivityFrame* frame, bool* complete);

  /// Resets to the start of a stream.
  void reset();

  [[nodiscard]] int num_bands() const { return static_cast<int>(bands_.size()); }
  /// The pitch of voices lies in the first few bands: those below 1000 Hz.
  [[nodiscard]] int num_low_bands() const { return num_low_bands_; }
  [[nodiscard]] std::size_t frame_length() const { return frame_length_; }
  [[nodiscard]] std::size_t frame_shift() const { return frame_shift_; }

 private:
  // Second-order section, transposed direct form II.
  struct Section {
    double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
    double s1 = 0, s2 = 0;
    double filter(double x) {
      const double y = b0 * x + s1;
      s1 = b1 * x - a1 * y + s2;
      s2 = b2 * x - a2 * y;
      return y;
    }
  };
  static Section low_pass(double cutoff_hz, int rate_hz);
  static Section high_pass(double cutoff_hz, int rate_hz);
  static Section band_pass(double low_hz, double high_hz, int rate_hz);

  void hear(float sample);
  void finish_frame(ActivityFrame* frame);
  float voicing();

  std::size_t frame_length_;
  std::size_t frame_shift_;
  int num_low_bands_ = 0;
  std::size_t decimation_;
  std::size_t min_lag_;
  std::size_t max_lag_;
  std::size_t window_;
  Section rumble_;  // high-pass, below the pitch of all voices
  Section smooth_;  // low-pass, before decimation
  std::vector<Section> bands_;
  std::vector<std::vector<float>> power_;  // squares of the frame's samples: all, then by band
  std::vector<float> pitch_;               // the decimated signal that voicing is computed from
  std::vector<double> energy_;             // its running sum of squares
  std::size_t num_pitch_ = 0;
  std::size_t filled_ = 0;  // samples of the frame so far
  std::size_t skip_ = 0;    // samples between frames, where the shift is longer than the frame
  std::size_t phase_ = 0;   // samples until the next one kept for voicing
  double offset_ = 0;
  double last_smooth_ = 0;
  bool started_ = false;
};

}  // namespace hri
