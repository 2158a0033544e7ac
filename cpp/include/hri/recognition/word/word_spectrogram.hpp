// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// About a second of log mel energies around a word, of the same length whatever the word's: what
// a network reads.
#pragma once

#include <cstddef>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/log_mel.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads.
class HRI_API WordSpectrogram {
 public:
  static constexpr int kNumFrames = 98;  ///< that the network reads, 10 ms apart
  static constexpr int kMargin = 15;     ///< more of them on either side, for training
  static constexpr int kNumBands = 40;

  /// Throws InvalidArgument for a rate that has no frames of 25 ms.
  explicit WordSpectrogram(int sample_rate_hz);

  /// In decibels, shape (kNumFrames + 2 kMargin, kNumBands), around sample `middle`. Frames that
  /// the audio does not have are as its quietest ones.
  [[nodiscard]] MatrixF window(Span<const float> audio, std::size_t middle) const;

  /// What the network reads of decibels of kNumFrames frames: none further than 70 below the
  /// loudest, less their mean, in units of 17 dB.
  static MatrixF normalised(ConstMatrixRefF decibels);
  /// The same of the middle of a window.
  static MatrixF input(const MatrixF& window);

  /// Middle frequencies of the bands.
  [[nodiscard]] const VectorF& band_hz() const { return band_hz_; }
  [[nodiscard]] const LogMel& log_mel() const { return log_mel_; }

 private:
  LogMel log_mel_;
  VectorF band_hz_;
};

}  // namespace hri
