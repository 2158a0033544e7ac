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
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

struct HRI_API SilhouetteCepstrumOptions {
  std::string wavelet = "db2";
  int num_levels = 3;
  int mask_px = 256;
  int num_points = 256;
  int num_filters = 20;
  int num_cepstra = 13;

  static constexpr const char* kName = "SilhouetteCepstrumOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("wavelet", o.wavelet, WaveletName{}, "wavelet of the transform");
    v("num_levels", o.num_levels, within(0, 4), "levels of the DWT; 0: none");
    v("mask_px", o.mask_px, within(64, 1024),
      "side of the square that the mask is scaled to before the DWT");
    v("num_points", o.num_points, within(64, 4096), "samples along the contour");
    v("num_filters", o.num_filters, within(2, 64), "filters over their spectrum");
    v("num_cepstra", o.num_cepstra, within(1, 63), "coefficients kept, below num_filters");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
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
