// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/shape_moments.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// Sums of x^1 .. x^3 over the pixels of a row; int64 holds them for rows of 65535 pixels.
struct MomentSums {
  std::int64_t count = 0;
  std::int64_t x = 0;
  std::int64_t x2 = 0;
  std::int64_t x3 = 0;
};

MomentSums row_sums(const std::uint8_t* row, int width) {
  MomentSums s;
  for (std::int64_t x = 0; x < width; ++x) {
    if (row[x] == 0) continue;
    ++s.count;
    s.x += x;
    s.x2 += x * x;
    s.x3 += x * x * x;
  }
  return s;
}

void add_row(const MomentSums& s, double y, ShapeMoments* m) {
  const auto n = static_cast<double>(s.count);
  const auto x = static_cast<double>(s.x);
  const auto x2 = static_cast<double>(s.x2);
  m->m00 += n;
  m->m10 += x;
  m->m01 += n * y;
  m->m20 += x2;
  m->m11 += x * y;
  m->m02 += n * y * y;
  m->m30 += static_cast<double>(s.x3);
  m->m21 += x2 * y;
  m->m12 += x * y * y;
  m->m03 += n * y * y * y;
}

void centre(ShapeMoments* m) {
  const double cx = m->m10 / m->m00;
  const double cy = m->m01 / m->m00;
  m->mu20 = m->m20 - cx * m->m10;
  m->mu11 = m->m11 - cx * m->m01;
  m->mu02 = m->m02 - cy * m->m01;
  m->mu30 = m->m30 - cx * (3 * m->mu20 + cx * m->m10);
  m->mu21 = m->m21 - cx * (2 * m->mu11 + cx * m->m01) - cy * m->mu20;
  m->mu12 = m->m12 - cy * (2 * m->mu11 + cy * m->m10) - cx * m->mu02;
  m->mu03 = m->m03 - cy * (3 * m->mu02 + cy * m->m01);
  const double second = 1 / (m->m00 * m->m00);
  const double third = second / std::sqrt(m->m00);
  m->nu20 = m->mu20 * second;
  m->nu11 = m->mu11 * second;
  m->nu02 = m->mu02 * second;
  m->nu30 = m->mu30 * third;
  m->nu21 = m->mu21 * third;
  m->nu12 = m->mu12 * third;
  m->nu03 = m->mu03 * third;
}

}  // namespace

ShapeMoments shape_moments(ImageView mask) {
  require(mask.channels == 1, "mask must have one channel");
  ShapeMoments m;
  if (mask.empty()) return m;
  for (int y = 0; y < mask.height_px; ++y) {
    const MomentSums sums = row_sums(mask.row(y), mask.width_px);
    if (sums.count != 0) add_row(sums, y, &m);
  }
  if (m.m00 > 0) centre(&m);
  return m;
}

ShapeAxis shape_axis(const ShapeMoments& m) {
  const double sum = m.mu20 + m.mu02;
  if (!(sum > 0)) return {};
  const double difference = std::hypot(m.mu20 - m.mu02, 2 * m.mu11);
  return {0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02), std::min(difference / sum, 1.0)};
}

void hu_moments(const ShapeMoments& m, Span<double> out) {
  require(out.size() == kNumHuMoments, "out must have 7 values");
  const double a = m.nu30 + m.nu12;
  const double b = m.nu21 + m.nu03;
  const double c = m.nu30 - 3 * m.nu12;
  const double d = 3 * m.nu21 - m.nu03;
  const double e = m.nu20 - m.nu02;
  out[0] = m.nu20 + m.nu02;
  out[1] = e * e + 4 * m.nu11 * m.nu11;
  out[2] = c * c + d * d;
  out[3] = a * a + b * b;
  out[4] = c * a * (a * a - 3 * b * b) + d * b * (3 * a * a - b * b);
  out[5] = e * (a * a - b * b) + 4 * m.nu11 * a * b;
  out[6] = d * a * (a * a - 3 * b * b) - c * b * (3 * a * a - b * b);
}

void hu_features(ImageView mask, Span<float> out) {
  require(out.size() == kNumHuMoments, "out must have 7 values");
  const ShapeMoments moments = shape_moments(mask);
  require(moments.m00 > 0, "mask is empty");
  constexpr double kDegrees[kNumHuMoments] = {1, 2, 2, 2, 4, 3, 4};
  double hu[kNumHuMoments];
  hu_moments(moments, {hu, kNumHuMoments});
  for (std::size_t i = 0; i < kNumHuMoments; ++i) {
    const double root = std::pow(std::abs(hu[i]), 1 / kDegrees[i]);
    out[i] = static_cast<float>(std::copysign(root, hu[i]));
  }
}

}  // namespace hri
