// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra of speech (MFCC and HFCC): pre-emphasis, Hamming frames, power spectrum, filter bank,
// log, DCT, lifter, normalisation, deltas (thesis sections 3.1.3 and 6.2.3; the log of eq. 3.32 is
// the one its text speaks of).
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/features/filter_bank.hpp"
#include "hri/signal/fft.hpp"

namespace hri {

enum class Normalisation : std::uint8_t {
  none,
  level,          ///< subtract the utterance mean of c0 only: loudness goes, the channel stays
  mean,           ///< subtract the utterance mean of every coefficient
  mean_variance,  ///< the same, then divide by the standard deviation
};

struct CepstraOptions {
  int sample_rate_hz = 16000;
  double frame_length_ms = 25;  ///< 1..1000
  double frame_shift_ms = 10;   ///< 1..1000
  double pre_emphasis = 0.97;   ///< 0 (off) .. 1
  FilterBankKind filter_bank = FilterBankKind::mel;
  int num_filters = 26;   ///< 1..512
  double low_hz = 100;    ///< lower edge of the first filter
  double high_hz = 0;     ///< upper edge of the last filter; 0 means the Nyquist rate
  double erb_factor = 1;  ///< bandwidth factor E of HFCC-E
  double warp = 1;        ///< vocal-tract-length factor on the filter frequencies, 0.5..2
  int num_cepstra = 12;   ///< c1 .. c_num, 1..num_filters - 1
  bool use_c0 = true;     ///< put c0 (log energy of all filters) in front
  double lifter = 22;     ///< HTK's sine lifter, not negative; 0 turns it off
  Normalisation normalisation = Normalisation::mean;
  int delta_orders = 2;  ///< 0 static only, 1 deltas, 2 and accelerations
  int delta_window = 2;  ///< frames on each side of the regression, 1..10
};

/// Immutable; const calls are safe from several threads.
class CepstraComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit CepstraComputer(const CepstraOptions& options);

  [[nodiscard]] const CepstraOptions& options() const { return options_; }
  [[nodiscard]] int num_static() const { return options_.num_cepstra + (options_.use_c0 ? 1 : 0); }
  [[nodiscard]] int num_features() const { return num_static() * (1 + options_.delta_orders); }
  [[nodiscard]] int frame_length() const { return frame_length_; }
  [[nodiscard]] int frame_shift() const { return frame_shift_; }
  [[nodiscard]] int num_frames(std::size_t num_samples) const;

  /// Features of mono audio at options().sample_rate_hz, rows = frames, shape (num_frames,
  /// num_features). Throws InvalidArgument "too short" for less than one frame, and for a sample
  /// that is not finite (names it).
  [[nodiscard]] MatrixF compute(Span<const float> audio) const;
  /// The same into `out`; allocates nothing once a thread has met this frame length.
  void compute(Span<const float> audio, MatrixRefF out) const;

 private:
  void compute_static(Span<const float> audio, MatrixRefF out) const;

  CepstraOptions options_;
  int frame_length_;
  int frame_shift_;
  RealFft fft_;
  FilterBank bank_;
  std::vector<float> window_;
  MatrixF dct_;  // (num_static, num_filters), lifter included
};

/// Regression deltas of columns [0, width) of `frames` into columns [width, 2 width): HTK's formula
/// over `window` frames on each side, edge frames repeated.
void append_deltas(MatrixRefF frames, int first_column, int width, int window);

/// Normalises columns [0, width) over all rows; constant columns become zero. `c0_column` is where
/// `level` works (-1: no c0).
void normalise(MatrixRefF frames, int width, Normalisation kind, int c0_column);

}  // namespace hri
