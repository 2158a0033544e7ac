// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What is done to features along time: normalisation of a whole utterance or as it runs, RASTA
// filtering (Hermansky and Morgan, IEEE Trans. Speech and Audio Processing 2(4), 1994), deltas.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

enum class Normalisation : std::uint8_t {
  none,
  level,          ///< subtract the utterance mean of c0 only: loudness goes, the channel stays
  mean,           ///< subtract the utterance mean of every coefficient
  mean_variance,  ///< the same, then divide by the standard deviation
  running_mean,   ///< subtract the mean so far, of every coefficient: fit for streams
  running_mean_variance,  ///< the same, then divide by the standard deviation so far
};
constexpr auto enum_names(Normalisation) {
  return std::array{"none",          "level",        "mean",
                    "mean_variance", "running_mean", "running_mean_variance"};
}

/// Whether frames can be normalised before the utterance has ended.
constexpr bool is_running(Normalisation kind) {
  return kind == Normalisation::running_mean || kind == Normalisation::running_mean_variance;
}

/// Regression deltas of columns [first, first + width) of `frames` into the `width` columns behind
/// them: HTK's formula over `window` frames on each side, edge frames repeated.
HRI_API void append_deltas(MatrixRefF frames, int first_column, int width, int window);

/// Normalises columns [0, width) over all rows by a kind that is not running; constant columns
/// become zero. `c0_column` is where `level` works (-1: no c0).
HRI_API void normalise(MatrixRefF frames, int width, Normalisation kind, int c0_column);

/// Running normalisation, frame by frame. The mean is that of all frames so far while they are
/// fewer than `num_frames`, and forgets exponentially from then on, by 1 / num_frames a frame.
class HRI_API RunningNormaliser {
 public:
  /// Begins anew, for frames of `width` values; num_frames >= 1.
  void start(int width, Normalisation kind, double num_frames);
  void apply(Span<float> frame);

 private:
  bool divide_ = false;
  double num_frames_ = 1;
  double seen_ = 0;
  std::vector<double> means_;
  std::vector<double> variances_;
};

/// Band-pass filter 0.1 (2 + z^-1 - z^-3 - 2 z^-4) / (1 - pole z^-1) along time: takes away what
/// stays (the channel) and what changes faster than speech does. Two frames late; before the first
/// frame that frame is thought to have stood for ever, so that the output begins with zeros. (On
/// log energies of filters it would do the same, as cepstra are their weighted sums.)
class HRI_API RastaFilter {
 public:
  /// Begins anew, for frames of `width` values. `pole` in 0..1, 1 excluded; 0.98 in the paper, 0.94
  /// in its authors' programs.
  void start(int width, double pole);
  void apply(Span<float> frame);

 private:
  double pole_ = 0;
  bool started_ = false;
  std::vector<double> past_;    // by columns: the last four frames, oldest first
  std::vector<double> output_;  // the last one
};

namespace detail {
/// One row of deltas: rows[0 .. 2 * window] are the frames around it.
void write_delta(const float* const* rows, int window, int width, float* delta);
}  // namespace detail

}  // namespace hri
