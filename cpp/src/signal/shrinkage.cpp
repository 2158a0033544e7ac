// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/shrinkage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kUsualLevels = 5;
constexpr std::size_t kSegments = 20;  // of the signal, in each of its bands
constexpr std::size_t kQuietSegments = 2;
constexpr double kMedianOfNormal = 0.6745;  // of |x| for the standard normal distribution

double universal(double noise, std::size_t count) {
  return noise * std::sqrt(2 * std::log(static_cast<double>(count)));
}

// Donoho and Johnstone 1995: where details are sparse the estimate of the risk is too noisy to be
// minimised, and the universal threshold serves better.
template <class T>
double sure(Span<const T> details, double noise) {
  const auto count = static_cast<double>(details.size());
  if (noise == 0) return 0;
  std::vector<double> squares;
  squares.reserve(details.size());
  double energy = 0;
  for (const T d : details) {
    const double ratio = static_cast<double>(d) / noise;
    squares.push_back(ratio * ratio);
    energy += squares.back();
  }
  const double most = universal(1, details.size());
  const double sparse = std::pow(std::log2(count), 1.5) / std::sqrt(count);
  if (energy / count - 1 <= sparse) return noise * most;
  // The risk at a threshold t is count - 2 #{d <= t} + sum of min(d, t)^2; its minimum lies at one
  // of the |d|, or at 0.
  std::sort(squares.begin(), squares.end());
  double best = count;  // at t = 0
  double best_square = 0;
  double below = 0;
  for (std::size_t i = 0; i < squares.size() && squares[i] <= most * most; ++i) {
    below += squares[i];
    const auto num_below = static_cast<double>(i + 1);
    const double risk = count - 2 * num_below + below + (count - num_below) * squares[i];
    if (risk < best) {
      best = risk;
      best_square = squares[i];
    }
  }
  return noise * std::sqrt(best_square);
}

template <class T>
double bayes(Span<const T> details, double noise) {
  double energy = 0;
  for (const T d : details) energy += static_cast<double>(d) * static_cast<double>(d);
  const double clean = energy / static_cast<double>(details.size()) - noise * noise;
  if (noise == 0) return 0;
  if (clean <= 0) return std::numeric_limits<double>::infinity();
  return noise * noise / std::sqrt(clean);
}

template <class T>
double segment_energy(const std::vector<T>& band, std::size_t segment) {
  double energy = 0;
  for (std::size_t i = band.size() * segment / kSegments;
       i < band.size() * (segment + 1) / kSegments; ++i)
    energy += static_cast<double>(band[i]) * static_cast<double>(band[i]);
  return energy;
}

// Of every band, the first one's too, in the segments that are quietest over all bands.
template <class T>
std::vector<double> quiet_levels(const std::vector<std::vector<T>>& bands) {
  std::vector<std::pair<double, std::size_t>> segments;
  for (std::size_t s = 0; s < kSegments; ++s) {
    segments.emplace_back(0, s);
    for (const std::vector<T>& band : bands) segments.back().first += segment_energy(band, s);
  }
  std::sort(segments.begin(), segments.end());
  std::vector<double> levels;
  for (const std::vector<T>& band : bands) {
    double energy = 0;
    std::size_t count = 0;
    for (std::size_t q = 0; q < kQuietSegments; ++q) {
      const std::size_t s = segments[q].second;
      energy += segment_energy(band, s);
      count += band.size() * (s + 1) / kSegments - band.size() * s / kSegments;
    }
    // A band with less than one value a segment says nothing of its own.
    levels.push_back(count > 0 ? std::sqrt(energy / static_cast<double>(count))
                               : noise_level(Span<const T>(band)));
  }
  return levels;
}

template <class T>
std::vector<double> noise_levels(const std::vector<std::vector<T>>& bands, NoiseEstimate from) {
  if (from == NoiseEstimate::quietest) return quiet_levels(bands);
  std::vector<double> levels(bands.size(), noise_level(Span<const T>(bands.back())));
  for (std::size_t i = 0; from == NoiseEstimate::per_level && i < bands.size(); ++i)
    levels[i] = noise_level(Span<const T>(bands[i]));
  return levels;
}

}  // namespace

template <class T>
double noise_level(Span<const T> details) {
  require(!details.empty(), "details must not be empty");
  std::vector<T> sizes(details.begin(), details.end());
  for (T& d : sizes) d = std::abs(d);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  auto median = static_cast<double>(*middle);
  if (sizes.size() % 2 == 0)
    median = (median + static_cast<double>(*std::max_element(sizes.begin(), middle))) / 2;
  return median / kMedianOfNormal;
}

template <class T>
double shrinkage_threshold(Span<const T> details, double noise, std::size_t num_samples,
                           ThresholdRule rule) {
  require(!details.empty(), "details must not be empty");
  require(noise >= 0, "noise must be at least 0");
  require(num_samples >= 1, "num_samples must be at least 1");
  switch (rule) {
    case ThresholdRule::universal:
      return universal(noise, num_samples);
    case ThresholdRule::sure:
      return sure(details, noise);
    case ThresholdRule::bayes:
      return bayes(details, noise);
  }
  return 0;
}

template <class T>
void shrink(Span<T> details, double threshold, ThresholdShape shape) {
  require(threshold >= 0, "threshold must be at least 0");
  for (T& d : details) {
    const auto value = static_cast<double>(d);
    const double size = std::abs(value);
    double kept = 0;
    if (shape == ThresholdShape::hard) {
      kept = size < threshold ? 0 : value;
    } else if (size > threshold) {
      kept = shape == ThresholdShape::soft ? std::copysign(size - threshold, value)
                                           : value - threshold * threshold / value;
    }
    d = static_cast<T>(kept);
  }
}

template <class T>
std::vector<T> denoise(Span<const T> x, const ShrinkageOptions& options) {
  validate(options);
  require(std::all_of(x.begin(), x.end(), [](T v) { return std::isfinite(v); }),
          "signal must be finite");
  const Wavelet& w = wavelet(options.wavelet);
  const int room = max_dwt_level(x.size(), w.dec_lo.size());
  const int num_levels =
      options.num_levels > 0 ? options.num_levels : std::clamp(room, 1, kUsualLevels);
  WaveletDecomposition<T> bands = wavedec<T>(x, w, options.border, num_levels);
  const std::vector<double> noise = noise_levels(bands.coefficients, options.noise);
  for (std::size_t i = 1; i < bands.coefficients.size(); ++i) {
    std::vector<T>& details = bands.coefficients[i];
    const double threshold =
        shrinkage_threshold(Span<const T>(details), noise[i], x.size(), options.rule);
    // No strength times an infinite threshold is no threshold.
    shrink(Span<T>(details), options.strength == 0 ? 0 : options.strength * threshold,
           options.shape);
  }
  return waverec(bands, w, options.border);
}

template <class T>
std::vector<T> approximate(Span<const T> x, const Wavelet& wavelet, Border border, int num_levels) {
  WaveletDecomposition<T> bands = wavedec<T>(x, wavelet, border, num_levels);
  const T scale = static_cast<T>(std::pow(2.0, -0.5 * num_levels));
  for (T& v : bands.coefficients[0]) v *= scale;
  return std::move(bands.coefficients[0]);
}

#define HRI_INSTANTIATE_SHRINKAGE(T)                                                         \
  template std::vector<T> denoise<T>(Span<const T>, const ShrinkageOptions&);                \
  template std::vector<T> approximate<T>(Span<const T>, const Wavelet&, Border, int);        \
  template double noise_level<T>(Span<const T>);                                             \
  template double shrinkage_threshold<T>(Span<const T>, double, std::size_t, ThresholdRule); \
  template void shrink<T>(Span<T>, double, ThresholdShape);
HRI_INSTANTIATE_SHRINKAGE(float)
HRI_INSTANTIATE_SHRINKAGE(double)
#undef HRI_INSTANTIATE_SHRINKAGE

}  // namespace hri
