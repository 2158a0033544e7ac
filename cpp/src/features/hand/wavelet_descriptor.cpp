// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/wavelet_descriptor.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using detail::kPi;
constexpr int kNumRadii = 129;  // 0, 1/128, ..., 1: at scale 3 a period is 20 of them
constexpr int kNumContourPoints = 512;

// Sums of e^{jb theta} by radius: two rows, real and imaginary, a frequency. Between two radii they
// are shared linearly, which is linear interpolation of the wavelet.
class AngularSums {
 public:
  void start(int num_frequencies) {
    num_frequencies_ = num_frequencies;
    sums_.setZero(2 * num_frequencies, kNumRadii);
  }

  /// A mass at (x, y) from the centroid; `scale` takes it into the unit disc.
  void add(float x, float y, float scale, float mass) {
    const float r = std::sqrt(x * x + y * y);
    const float place = std::min(r * scale, 1.0F) * static_cast<float>(kNumRadii - 1);
    const int below = std::min(static_cast<int>(place), kNumRadii - 2);
    const float share = place - static_cast<float>(below);
    const float cosine = r > 0 ? x / r : 0.0F;  // the centroid itself has no angle
    const float sine = r > 0 ? y / r : 0.0F;
    float real = mass;
    float imaginary = 0;
    for (int b = 0; b < num_frequencies_; ++b) {
      float* row = sums_.data() + static_cast<std::ptrdiff_t>(2 * b) * kNumRadii + below;
      row[0] += (1 - share) * real;
      row[1] += share * real;
      row[kNumRadii] += (1 - share) * imaginary;
      row[kNumRadii + 1] += share * imaginary;
      const float next = real * cosine - imaginary * sine;
      imaginary = real * sine + imaginary * cosine;
      real = next;
    }
  }

  [[nodiscard]] auto row(int i) const { return sums_.row(i); }

 private:
  int num_frequencies_ = 0;
  MatrixF sums_;
};

AngularSums& workspace() {
  thread_local AngularSums sums;
  return sums;
}

MatrixF wavelet_table(int num_scales) {
  int pairs = 0;
  for (int m = 0; m < num_scales; ++m) pairs += (1 << (m + 1)) + 1;
  MatrixF table(pairs, kNumRadii);
  int pair = 0;
  for (int m = 0; m < num_scales; ++m) {
    for (int n = 0; n <= 1 << (m + 1); ++n, ++pair) {
      for (int i = 0; i < kNumRadii; ++i) {
        const double r = static_cast<double>(i) / (kNumRadii - 1);
        table(pair, i) = static_cast<float>(std::pow(2.0, m / 2.0) *
                                            b_spline_wavelet(std::pow(2.0, m) * r - n / 2.0));
      }
    }
  }
  return table;
}

}  // namespace

double b_spline_wavelet(double r) {
  constexpr int kDegree = 3;
  constexpr double kA = 0.697066;
  constexpr double kF0 = 0.409177;
  constexpr double kVariance = 0.561145;
  const double u = 2 * r - 1;
  return 4 * std::pow(kA, kDegree + 1) / std::sqrt(2 * kPi * (kDegree + 1)) * std::sqrt(kVariance) *
         std::cos(2 * kPi * kF0 * u) * std::exp(-u * u / (2 * kVariance * (kDegree + 1)));
}

WaveletDescriptorComputer::WaveletDescriptorComputer(const WaveletDescriptorOptions& options)
    : options_(validated(options)) {
  wavelets_ = wavelet_table(options.num_scales);
}

void WaveletDescriptorComputer::compute_silhouette(ImageView mask) const {
  double count = 0;
  double sum_x = 0;
  double sum_y = 0;
  thread_local std::vector<ContourPoint> pixels;
  pixels.clear();
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* row = mask.row(y);
    for (int x = 0; x < mask.width_px; ++x) {
      if (row[x] == 0) continue;
      pixels.push_back({x, y});
      sum_x += x;
    }
    sum_y += y * (static_cast<double>(pixels.size()) - count);
    count = static_cast<double>(pixels.size());
  }
  require(count > 0, "mask is empty");
  const auto centre_x = static_cast<float>(sum_x / count);
  const auto centre_y = static_cast<float>(sum_y / count);
  float largest = 0;
  for (const ContourPoint& p : pixels) {
    const float x = static_cast<float>(p.x_px) - centre_x;
    const float y = static_cast<float>(p.y_px) - centre_y;
    largest = std::max(largest, x * x + y * y);
  }
  // The area of a pixel reaches half a pixel beyond its centre.
  const float scale = 1.0F / (std::sqrt(largest) + 0.5F);
  AngularSums& sums = workspace();
  for (const ContourPoint& p : pixels) {
    sums.add(static_cast<float>(p.x_px) - centre_x, static_cast<float>(p.y_px) - centre_y, scale,
             scale * scale);
  }
}

void WaveletDescriptorComputer::compute_contour(ImageView mask) const {
  thread_local std::vector<ContourPoint> contour;
  thread_local std::vector<float> x;
  thread_local std::vector<float> y;
  trace_contour(mask, &contour);
  require(!contour.empty(), "mask is empty");
  x.resize(kNumContourPoints);
  y.resize(kNumContourPoints);
  resample_contour(contour, x, y);
  float centre_x = 0;
  float centre_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    centre_x += (x[i] - x[0]) / kNumContourPoints;
    centre_y += (y[i] - y[0]) / kNumContourPoints;
  }
  centre_x += x[0];
  centre_y += y[0];
  float largest = 0;
  float length = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t next = i + 1 == x.size() ? 0 : i + 1;
    largest = std::max(largest, std::hypot(x[i] - centre_x, y[i] - centre_y));
    length += std::hypot(x[next] - x[i], y[next] - y[i]);
  }
  const float scale = 1.0F / (largest + 0.5F);
  AngularSums& sums = workspace();
  for (std::size_t i = 0; i < x.size(); ++i)
    sums.add(x[i] - centre_x, y[i] - centre_y, scale, scale * length / kNumContourPoints);
}

void WaveletDescriptorComputer::compute(ImageView mask, Span<float> out) const {
  require(mask.channels == 1 && !mask.empty(), "mask must have one channel and at least one pixel");
  require(out.size() == static_cast<std::size_t>(num_features()),
          "out must have num_features() values");
  AngularSums& sums = workspace();
  sums.start(options_.num_frequencies);
  if (options_.source == WaveletDescriptorSource::silhouette) {
    compute_silhouette(mask);
  } else {
    compute_contour(mask);
  }
  float* to = out.data();
  for (int b = 0; b < options_.num_frequencies; ++b) {
    for (Eigen::Index pair = 0; pair < wavelets_.rows(); ++pair) {
      const float real = wavelets_.row(pair).dot(sums.row(2 * b));
      const float imaginary = wavelets_.row(pair).dot(sums.row(2 * b + 1));
      *to++ = std::sqrt(real * real + imaginary * imaginary);
    }
  }
}

}  // namespace hri
