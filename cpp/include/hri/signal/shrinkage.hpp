// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Noise reduction by wavelets (thesis section 6.2.2), in both readings: details below a threshold
// are noise and go (shrinkage), or all details go and the approximation stays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {

/// How a level's threshold follows from its noise level s.
enum class ThresholdRule : std::uint8_t {
  universal,  ///< s sqrt(2 ln num_samples): VisuShrink
  sure,       ///< least estimate of the risk, universal where details are sparse: SureShrink
  bayes       ///< s^2 / deviation of the clean details: BayesShrink
};
constexpr auto enum_names(ThresholdRule) { return std::array{"universal", "sure", "bayes"}; }
/// What becomes of a detail d at a threshold t.
enum class ThresholdShape : std::uint8_t {
  soft,    ///< 0 up to t, beyond it nearer to 0 by t
  hard,    ///< 0 below t
  garrote  ///< 0 up to t, beyond it d - t^2 / d
};
constexpr auto enum_names(ThresholdShape) { return std::array{"soft", "hard", "garrote"}; }
/// Where a level's noise is measured.
enum class NoiseEstimate : std::uint8_t {
  quietest,   ///< the root mean square of each level in the quietest tenth of the signal: noise of
              ///< any colour, if the signal pauses
  per_level,  ///< noise_level() of each level: takes what fills a level for noise
  finest      ///< noise_level() of the finest level, for all: white noise
};
constexpr auto enum_names(NoiseEstimate) { return std::array{"quietest", "per_level", "finest"}; }

struct ShrinkageOptions {
  std::string wavelet = "sym8";
  Border border = Border::symmetric;
  int num_levels = 0;
  ThresholdRule rule = ThresholdRule::bayes;
  ThresholdShape shape = ThresholdShape::soft;
  NoiseEstimate noise = NoiseEstimate::quietest;
  double strength = 1;

  static constexpr const char* kName = "ShrinkageOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("wavelet", o.wavelet, WaveletName{}, "wavelet of the transform");
    v("border", o.border, any_value, "how the signal goes on beyond its ends");
    v("num_levels", o.num_levels, within(0, 62),
      "levels of the transform; 0: five, or as many as the signal has room for");
    v("rule", o.rule, any_value, "how the threshold follows from the noise");
    v("shape", o.shape, any_value, "how coefficients shrink");
    v("noise", o.noise, any_value, "how the noise is estimated");
    v("strength", o.strength, within(0, 1e6), "factor of all thresholds");
  }
};

/// The signal without its noise, of the same length. Throws InvalidArgument for an empty signal,
/// a NaN or an infinity, and options out of range.
template <class T>
HRI_API std::vector<T> denoise(Span<const T> x, const ShrinkageOptions& options);

/// The approximation of level num_levels, divided by sqrt(2) a level so that it is as loud as the
/// signal: about the signal at 1 / 2^num_levels of its rate, longer by what the border adds.
template <class T>
HRI_API std::vector<T> approximate(Span<const T> x, const Wavelet& wavelet, Border border,
                                   int num_levels);

/// Standard deviation of normal noise: the median of |details| over 0.6745, which the few large
/// details of a signal do not move. Throws InvalidArgument for no details.
template <class T>
HRI_API double noise_level(Span<const T> details);

/// The threshold for the details of one level; num_samples is the signal's length. An infinite one
/// means that nothing but noise is there.
template <class T>
HRI_API double shrinkage_threshold(Span<const T> details, double noise, std::size_t num_samples,
                                   ThresholdRule rule);

/// Applies a threshold in place. Throws InvalidArgument for a negative one.
template <class T>
HRI_API void shrink(Span<T> details, double threshold, ThresholdShape shape);

}  // namespace hri
