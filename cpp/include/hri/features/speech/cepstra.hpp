// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra of speech: pre-emphasis, windowed frames, power spectrum, filter bank, log, DCT, lifter,
// normalisation, deltas (MFCC and HFCC; thesis sections 3.1.3 and 6.2.3; the log of eq. 3.32 is the
// one its text speaks of), or frames, linear prediction, cepstrum (LPCC).
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra_options.hpp"
#include "hri/features/speech/filter_bank.hpp"
#include "hri/signal/fft.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads.
class HRI_API CepstraComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit CepstraComputer(const CepstraOptions& options);

  [[nodiscard]] const CepstraOptions& options() const { return options_; }
  [[nodiscard]] int num_static() const { return options_.num_cepstra + (options_.use_c0 ? 1 : 0); }
  [[nodiscard]] int num_features() const { return num_static() * (1 + options_.delta_orders); }
  [[nodiscard]] int frame_length() const { return frame_length_; }
  [[nodiscard]] int frame_shift() const { return frame_shift_; }
  [[nodiscard]] int num_frames(std::size_t num_samples) const;
  /// Frames that the running normalisations remember.
  [[nodiscard]] double running_frames() const;

  /// Features of mono audio at options().sample_rate_hz, rows = frames, shape (num_frames,
  /// num_features). Throws InvalidArgument "too short" for less than one frame, and for a sample
  /// that is not finite (names it).
  [[nodiscard]] MatrixF compute(Span<const float> audio) const;
  /// The same into `out`; allocates nothing once a thread has met this frame length.
  void compute(Span<const float> audio, MatrixRefF out) const;

  /// Static cepstra as they are before anything is done along time, shape (frames.size(),
  /// num_static). Every frame is frame_length() + 1 samples, the first being what came before it.
  void compute_frames(Span<const float* const> frames, MatrixRefF out) const;

 private:
  struct Workspace;
  static Workspace& workspace();
  void set_dct();
  [[nodiscard]] Eigen::Index column_of(int n) const;  // of cepstrum n
  [[nodiscard]] const float* frame_at(Span<const float> audio, std::ptrdiff_t t,
                                      Span<float> edge) const;
  void compute_static(Span<const float> audio, MatrixRefF out) const;
  void condition(Span<const float* const> frames, float* log_energy, Workspace* work) const;
  void log_energies(Span<const float* const> frames, float* logs, Workspace* work) const;
  void project(const float* logs, float lowest, MatrixRefF out, Workspace* work) const;
  void predict(Span<const float* const> frames, MatrixRefF out, Workspace* work) const;

  CepstraOptions options_;
  int frame_length_;
  int frame_shift_;
  int c0_column_;  // -1: none
  RealFft fft_;
  FilterBank bank_;
  std::vector<float> window_;  // times the scale of the samples
  MatrixF dct_;                // rows as the columns of the features; lifter and unit included
  std::vector<double> lifts_;  // by cepstra, from c0, whose lift is the unit of the log
};

}  // namespace hri
