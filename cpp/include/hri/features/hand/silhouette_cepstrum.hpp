// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra of a silhouette (thesis section 3.1.3): 2-D DWT of the mask, its approximation as a
// signal, Hamming frames that overlap by half, power spectrum, mel filter bank, log, DCT.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

enum class SilhouetteSignal : std::uint8_t {
  contour,  ///< distance from the centroid along the contour
  picture,  ///< all pixels, column by column, as in the thesis
};
constexpr auto enum_names(SilhouetteSignal) { return std::array{"contour", "picture"}; }

struct HRI_API SilhouetteCepstrumOptions {
  std::string wavelet = "db2";
  int num_levels = 3;
  int mask_px = 256;
  SilhouetteSignal signal = SilhouetteSignal::contour;
  int num_points = 256;
  int num_frames = 3;
  bool average_frames = true;
  int num_filters = 20;
  int num_cepstra = 13;

  static constexpr const char* kName = "SilhouetteCepstrumOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("wavelet", o.wavelet, WaveletName{}, "wavelet of the transform");
    v("num_levels", o.num_levels, within(0, 4), "levels of the DWT; 0: none");
    v("mask_px", o.mask_px, within(32, 1024),
      "side of the square that the mask is scaled to before the DWT");
    v("signal", o.signal, any_value, "what signal is made of the approximation");
    v("num_points", o.num_points, within(64, 4096), "samples along the contour");
    v("num_frames", o.num_frames, within(1, 32),
      "frames that the signal is blocked into; the thesis has 11");
    v("average_frames", o.average_frames, any_value,
      "the cepstra of the frames are averaged; else they stand side by side");
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

  /// num_cepstra + 1, times num_frames where frames are not averaged.
  [[nodiscard]] int num_features() const;

  /// Distance from the centroid along the contour, scaled by its mean, num_points values (all 1 for
  /// a mask too small to have an outline). Starts at the topmost point, so that it does not turn
  /// with the order of tracing.
  [[nodiscard]] std::vector<float> contour_signal(ImageView mask) const;

  /// The approximation's pixels, column by column, divided by the transform's gain of 2 a level: of
  /// the "haar" wavelet 0..1, of longer ones a little beyond. `mask` must not be empty.
  [[nodiscard]] std::vector<float> picture_signal(ImageView mask) const;

  /// c0 .. c_num_cepstra, averaged over the signal's frames or frame by frame. Frames overlap by
  /// half; samples behind the last one are left out. `mask` must not be empty.
  void compute(ImageView mask, Span<float> out) const;

 private:
  // Of the mask, cropped to a square; divided by what the transform makes of a constant 1.
  [[nodiscard]] MatrixF approximation(ImageView mask) const;

  SilhouetteCepstrumOptions options_;
  CepstraComputer cepstra_;
};

}  // namespace hri
