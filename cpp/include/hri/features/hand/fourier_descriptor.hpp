// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Fourier descriptors of outlines (Zahn and Roskies, 1972; Granlund, 1972): x + iy along the
// outline as a periodic complex signal. Its mean is the place, the length of the rest the size,
// phases the start and how far the shape is turned.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/contour.hpp"
#include "hri/signal/fft.hpp"

namespace hri {

struct HRI_API FourierDescriptorOptions {
  int num_points = 128;
  int num_harmonics = 16;
  bool use_phase = false;

  static constexpr const char* kName = "FourierDescriptorOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_points", o.num_points, within(16, 4096).even(),
      "points along the outline; powers of two are fastest");
    v("num_harmonics", o.num_harmonics, within(1, 2047),
      "harmonics of each sign, below num_points / 2");
    v("use_phase", o.use_phase, any_value,
      "real and imaginary parts, with the start where the first harmonic is real: they show how "
      "far a shape is turned");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads.
class HRI_API FourierDescriptorComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit FourierDescriptorComputer(const FourierDescriptorOptions& options);

  [[nodiscard]] int num_features() const {
    return (options_.use_phase ? 4 : 2) * options_.num_harmonics;
  }
  [[nodiscard]] const FourierDescriptorOptions& options() const { return options_; }

  /// Harmonics 1, -1, 2, -2, ..., over the root of the sum of squares of all but the mean: unlike
  /// the first harmonic, that is never 0 for a shape. Magnitudes stay the same when the shape is
  /// moved, scaled or turned and when its outline starts elsewhere. Zeros for a single pixel.
  /// Throws InvalidArgument for an empty outline or mask.
  void compute(Span<const ContourPoint> contour, Span<float> out) const;
  void compute(ImageView mask, Span<float> out) const;

 private:
  FourierDescriptorOptions options_;
  RealFft fft_;
};

}  // namespace hri
