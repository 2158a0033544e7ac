// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstrum of a silhouette (thesis chapter 3): 2-D DWT of the mask, contour of its approximation,
// distance from the centroid along the contour as a signal, Hamming frames, power spectrum, mel
// filter bank, log, DCT.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"

namespace hri {

struct SilhouetteCepstrumOptions {
  std::string wavelet = "db2";
  int num_levels = 3;    ///< of the DWT, 0 (none) .. 4
  int mask_px = 256;     ///< side of the square the mask is scaled to before the DWT, 64..1024
  int num_points = 256;  ///< samples along the contour, 64..4096
  int num_filters = 20;  ///< 2..64
  int num_cepstra = 13;  ///< 1..num_filters - 1
};

/// Immutable; const calls are safe from several threads.
class HRI_API SilhouetteCepstrumComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit SilhouetteCepstrumComputer(const SilhouetteCepstrumOptions& options);

  [[nodiscard]] int num_features() const { return options_.num_cepstra + 1; }

  /// Distance from the centroid along the contour, scaled by its mean, num_points values (all 1 for
  /// a mask too small to have an outline). Starts at the topmost point, so that it does not turn
  /// with the order of tracing.
  [[nodiscard]] std::vector<float> contour_signal(ImageView mask) const;

  /// c0 .. c_num_cepstra, averaged over the frames of the contour signal. `mask` must not be empty.
  void compute(ImageView mask, Span<float> out) const;

 private:
  SilhouetteCepstrumOptions options_;
  CepstraComputer cepstra_;
};

}  // namespace hri
