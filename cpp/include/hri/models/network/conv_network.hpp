// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A convolutional network over frames, trained elsewhere: a chain of convolutions, each with its
// activation and pooling. Frames are never padded, so that a window of a recording gives what it
// gives alone, and a whole recording costs no more than its frames.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

namespace detail {
struct PackedLayer;
}

/// Convolution over frames and bands, then max(leaky_relu(x), floor), then the largest of every
/// pool_frames x pool_bands values. Bands are padded by zeros, pad_bands on each side.
struct ConvLayer {
  int kernel_frames = 1;
  int kernel_bands = 1;
  int pad_bands = 0;
  int in_channels = 1;
  int out_channels = 1;
  std::vector<float>
      weights;  ///< shape (kernel_frames, kernel_bands, in_channels, out_channels), finite
  std::vector<float> bias;  ///< shape (out_channels,), finite
  float slope = 1;          ///< of the activation below zero; 1: there is none
  float floor = -std::numeric_limits<float>::infinity();
  int pool_frames = 1;
  int pool_bands = 1;
};

/// Immutable; const calls are safe from several threads, and give the same bits on every processor.
class HRI_API ConvNetwork {
 public:
  /// Sizes are at most this.
  static constexpr int kMaxSize = 4096;

  /// For frames of `num_bands` values. Throws InvalidArgument naming the layer where sizes are out
  /// of range or do not follow from one another, and for weights that are not finite.
  ConvNetwork(int num_bands, const std::vector<ConvLayer>& layers);
  ~ConvNetwork();
  ConvNetwork(const ConvNetwork&) = default;
  ConvNetwork& operator=(const ConvNetwork&) = default;

  [[nodiscard]] int num_bands() const { return num_bands_; }
  /// Values of a row of the output: the bands that are left, times the channels of the last layer.
  [[nodiscard]] int num_outputs() const { return num_outputs_; }
  /// Frames that one row of the output is computed from.
  [[nodiscard]] int window_frames() const { return window_frames_; }
  /// Frames from one row to the next.
  [[nodiscard]] int step_frames() const { return step_frames_; }
  /// Rows of the output for so many frames; 0 below window_frames().
  [[nodiscard]] int num_rows(int num_frames) const;

  /// Of frames in rows, shape (num_frames, num_bands), to shape (num_rows, num_outputs), channels
  /// beside one another. With `rows_per_step` windows begin so many times as often, a divisor of
  /// step_frames() frames apart; layers that these share are computed once. Throws InvalidArgument
  /// for rows of another length and for a rows_per_step that does not divide the step.
  [[nodiscard]] MatrixF compute(ConstMatrixRefF frames, int rows_per_step = 1) const;

 private:
  void compute_rows(ConstMatrixRefF frames, int rows_per_step, MatrixRefF out) const;

  int num_bands_;
  int num_outputs_ = 0;
  int window_frames_ = 1;
  int step_frames_ = 1;
  std::vector<std::shared_ptr<const detail::PackedLayer>> layers_;
};

}  // namespace hri
