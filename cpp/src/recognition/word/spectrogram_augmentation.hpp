// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What training does to the windows of WordSpectrogram: other speed, place and vocal tract, noise
// (added as powers of bands), and bands and frames left out (Park et al., "SpecAugment", 2019).
#pragma once

#include <cstdint>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"
#include "hri/recognition/word/word_spectrogram.hpp"

namespace hri::detail {

/// Immutable; const calls are safe from several threads.
class SpectrogramAugmentation {
 public:
  SpectrogramAugmentation(const WordSpectrogram& spectrogram, std::uint64_t seed);

  /// What the network reads of a window in one step of training.
  void make_example(const MatrixF& window, Random* random, MatrixF* input) const;
  /// What it reads where noise of any colour lies `snr_db` below the word.
  [[nodiscard]] MatrixF noisy_input(const MatrixF& window, double snr_db, Random* random) const;

 private:
  void add_noise(double snr_db, Random* random, MatrixF* decibels) const;

  VectorF band_hz_;
  double low_mel_, mel_step_;
  MatrixF noise_;  // powers of white noise, frame by frame
};

}  // namespace hri::detail
