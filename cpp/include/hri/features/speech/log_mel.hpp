// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Log mel energies, what networks of speech read: librosa's melspectrogram and power_to_db, frame
// by frame in rows.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra_options.hpp"
#include "hri/features/speech/filter_bank.hpp"
#include "hri/signal/fft.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads.
class HRI_API LogMel {
 public:
  /// Of frames, window, spectrum and filters as `options` has them, decibels and top_db included;
  /// its cepstra are not used. Throws InvalidArgument naming the field that is out of range, and
  /// for padding, pre-emphasis, remove_dc or linear prediction, which there are none of here.
  explicit LogMel(const CepstraOptions& options);

  /// What google/speech_embedding reads: 32 bands of 60..3800 Hz, 25 ms every 10 ms at 16 kHz, in
  /// decibels of 16-bit samples, at most 80 below the loudest.
  static CepstraOptions speech_embedding();

  [[nodiscard]] const CepstraOptions& options() const { return options_; }
  [[nodiscard]] int num_frames(std::size_t num_samples) const;

  /// Shape (num_frames, num_filters). Audio shorter than a frame has none. Throws InvalidArgument
  /// for a sample that is not finite.
  [[nodiscard]] MatrixF compute(Span<const float> audio) const;

 private:
  CepstraOptions options_;
  int frame_length_;
  int frame_shift_;
  RealFft fft_;
  FilterBank bank_;
  std::vector<float> window_;  // times the scale of the samples
};

}  // namespace hri
