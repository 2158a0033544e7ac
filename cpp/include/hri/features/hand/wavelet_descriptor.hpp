// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Moment-invariant wavelet descriptors (Shen and Ip, Pattern Recognition 32, 1999; thesis eq.
// 3.20-3.25): magnitudes of integrals of psi_mn(r) e^{jb theta} over the shape, in polar
// coordinates about its centroid, with a cubic B-spline wavelet along the radius.
#pragma once

#include <array>
#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/contour.hpp"

namespace hri {

enum class WaveletDescriptorSource : std::uint8_t {
  silhouette,  ///< every pixel of the mask
  contour,     ///< the outline of its largest region, as a line
};
constexpr auto enum_names(WaveletDescriptorSource) { return std::array{"silhouette", "contour"}; }

struct WaveletDescriptorOptions {
  WaveletDescriptorSource source = WaveletDescriptorSource::silhouette;
  int num_scales = 4;
  int num_frequencies = 4;

  static constexpr const char* kName = "WaveletDescriptorOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("source", o.source, any_value, "pixels that are described");
    v("num_scales", o.num_scales, within(1, 6), "radial scales m = 0 .. num_scales - 1");
    v("num_frequencies", o.num_frequencies, within(1, 32), "angular frequencies, from 0");
  }
};

/// The wavelet psi(r) of thesis eq. 3.22.
HRI_API double b_spline_wavelet(double r);

/// Immutable; const calls are safe from several threads.
class HRI_API WaveletDescriptorComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit WaveletDescriptorComputer(const WaveletDescriptorOptions& options);

  /// num_frequencies times the number of pairs (m, n), n = 0 .. 2^(m+1).
  [[nodiscard]] int num_features() const {
    return options_.num_frequencies * static_cast<int>(wavelets_.rows());
  }
  [[nodiscard]] const WaveletDescriptorOptions& options() const { return options_; }

  /// Feature (b, m, n) at b * num_features() / num_frequencies + (place of the pair): radii are
  /// in units of the largest. They stay the same when the shape is moved, scaled or turned.
  /// Throws InvalidArgument for an empty mask.
  void compute(ImageView mask, Span<float> out) const;

 private:
  void compute_silhouette(ImageView mask) const;
  void compute_contour(ImageView mask) const;

  WaveletDescriptorOptions options_;
  MatrixF wavelets_;  // by pairs and radii
};

}  // namespace hri
