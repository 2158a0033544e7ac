// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hybrid feature of a moving gesture (thesis section 5.1.3-5.1.4, eq. 5.2-5.13): moments of the
// hand's shape, orientation by a wavelet transform, chain codes of its way and its speed, each in
// 0..1 and joined. The maxima are those of the whole gesture: it is no feature of a stream.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/wavelet_descriptor.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

/// Columns of a direction. What lies on a circle has a jump as a number: 0 beside 315 degrees.
enum class HybridAngles : std::uint8_t {
  number,  ///< one column: the share of the circle (of half of it for an orientation)
  circle,  ///< two columns: cosine and sine, from -1..1 into 0..1
};
constexpr auto enum_names(HybridAngles) { return std::array{"number", "circle"}; }

/// The largest moment G_max of eq. 5.9.
enum class HybridMomentScale : std::uint8_t {
  gesture,  ///< of all moments and frames: what moments are to one another stays
  column,   ///< of each moment over the frames: only how it changes stays
};
constexpr auto enum_names(HybridMomentScale) { return std::array{"gesture", "column"}; }

struct HRI_API HybridFeatureOptions {
  bool use_moments = true;
  WaveletDescriptorOptions moments;
  HybridMomentScale moment_scale = HybridMomentScale::gesture;
  bool use_orientation = true;
  std::string wavelet = "haar";
  int crop_px = 64;
  bool use_chain_codes = true;
  HybridAngles angles = HybridAngles::number;
  bool use_speed = true;
  double speed_weight = 0.5;

  static constexpr const char* kName = "HybridFeatureOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("use_moments", o.use_moments, any_value, "moment-invariant wavelet descriptors of the mask");
    v("moments", o.moments, any_value, "options of the descriptors");
    v("moment_scale", o.moment_scale, any_value, "which largest moment they are divided by");
    v("use_orientation", o.use_orientation, any_value,
      "orientation of the silhouette's edges at the second level of a DWT");
    v("wavelet", o.wavelet, WaveletName{}, "wavelet of that transform");
    v("crop_px", o.crop_px, within(16, 256),
      "side of the square that the silhouette is scaled to before it");
    v("use_chain_codes", o.use_chain_codes, any_value,
      "directions, of eight, from the middle of the way and to the next place");
    v("angles", o.angles, any_value, "columns of orientation and of each chain code");
    v("use_speed", o.use_speed, any_value, "share of the gesture's largest speed");
    v("speed_weight", o.speed_weight, above(0, 1),
      "factor of the speed; the thesis has 0.1 to 0.9");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads.
class HRI_API HybridFeatureComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range, or when every part is turned
  /// off.
  explicit HybridFeatureComputer(const HybridFeatureOptions& options);

  /// Columns: moments, orientation, chain code from the middle, chain code of the step, speed; of
  /// the parts that are used.
  [[nodiscard]] int num_features() const { return num_features_; }
  [[nodiscard]] int num_moments() const;
  [[nodiscard]] const HybridFeatureOptions& options() const { return options_; }

  /// A row for every frame of the gesture that shows a hand, into the upper rows of `out`
  /// (masks.size() rows, num_features() columns); gives their number. All values lie in 0..1.
  ///
  /// Places are the centroids in pixels. The speed of a row leads to the next (eq. 5.2), a frame of
  /// the pictures between; the last row repeats the one before. A chain code is 0 to the right, 2
  /// up, 4 to the left, 6 down; where the hand stays in its place, the code of the step before is
  /// kept, before its first step that of the first. A hand that never moves has speed 0 and codes
  /// 0. Throws InvalidArgument for masks of different sizes or several channels, and an `out` that
  /// does not fit.
  Eigen::Index compute(Span<const ImageView> masks, MatrixRefF out) const;
  [[nodiscard]] MatrixF compute(Span<const ImageView> masks) const;

 private:
  HybridFeatureOptions options_;
  std::optional<WaveletDescriptorComputer> moments_;
  std::optional<Wavelet> wavelet_;
  int num_features_ = 0;
};

/// Freeman's direction, 0..7, of the way (dx, dy) in image axes (y down), for 0, 0 it is 0 (thesis
/// eq. 5.11): N - int(theta / (pi / 4) + 0.5 + (dy < 0) N), modulo N = 8. As printed, nothing
/// rounds: the bracket of an integer belongs round what is subtracted, else the + 0.5 turns every
/// direction by half a code. Throws InvalidArgument unless both are finite.
HRI_API int direction_code(double dx, double dy);

}  // namespace hri
