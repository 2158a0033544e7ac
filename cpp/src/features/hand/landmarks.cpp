// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sums are taken in NumPy's order (pairwise, eight at a time), so that models trained on rows that
// NumPy made see the same rows.
#include "hri/features/hand/landmarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kNumFingers = 5;
constexpr int kJointsAFinger = 4;
constexpr double kLeast = 1e-6;      // of sizes and lengths that are divided by
constexpr double kBoneWeight = 0.5;  // the bones of one finger have the weight of a joint

using Values = std::array<double, kNumLandmarks>;

double pairwise_sum(const Values& v) {
  std::array<double, 8> sums{};
  std::copy_n(v.begin(), 8, sums.begin());
  for (std::size_t i = 0; i < 8; ++i) sums[i] += v[8 + i];
  double sum =
      ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
  for (std::size_t i = 16; i < v.size(); ++i) sum += v[i];
  return sum;
}

double mean(const Values& v) {
  double sum = 0;
  for (const double value : v) sum += value;
  return sum / kNumLandmarks;
}

double extent(const Values& v) {
  const auto [least, most] = std::minmax_element(v.begin(), v.end());
  return *most - *least;
}

}  // namespace

void landmark_features(ConstMatrixRefF points_px, int width_px, int height_px, Span<float> out) {
  require(points_px.rows() == kNumLandmarks && points_px.cols() == 2,
          "landmarks must have 21 rows of x and y");
  require(points_px.allFinite(), "landmarks must be finite");
  require(width_px > 0 && height_px > 0, "frame must have at least one pixel");
  require(out.size() == kNumLandmarkFeatures, "out must have kNumLandmarkFeatures values");
  Values x{};
  Values y{};
  for (std::size_t i = 0; i < kNumLandmarks; ++i) {
    x[i] = static_cast<double>(points_px(static_cast<Eigen::Index>(i), 0));
    y[i] = static_cast<double>(points_px(static_cast<Eigen::Index>(i), 1));
  }
  const double centre_x = mean(x);
  const double centre_y = mean(y);
  Values squares{};
  for (std::size_t i = 0; i < kNumLandmarks; ++i) {
    const double dx = x[i] - centre_x;
    const double dy = y[i] - centre_y;
    squares[i] = dx * dx + dy * dy;
  }
  const double size = std::max(std::sqrt(pairwise_sum(squares) / kNumLandmarks), kLeast);
  float* to = out.data();
  for (std::size_t i = 0; i < kNumLandmarks; ++i) {
    *to++ = static_cast<float>((x[i] - centre_x) / size);
    *to++ = static_cast<float>((y[i] - centre_y) / size);
  }
  for (std::size_t finger = 0; finger < kNumFingers; ++finger) {
    std::size_t from = 0;  // the wrist
    for (std::size_t joint = 0; joint < kJointsAFinger; ++joint) {
      const std::size_t end = 1 + finger * kJointsAFinger + joint;
      const double dx = x[end] - x[from];
      const double dy = y[end] - y[from];
      const double length = std::max(std::sqrt(dx * dx + dy * dy), kLeast);
      *to++ = static_cast<float>(kBoneWeight * (dx / length));
      *to++ = static_cast<float>(kBoneWeight * (dy / length));
      from = end;
    }
  }
  *to++ = static_cast<float>(centre_x / width_px);
  *to++ = static_cast<float>(centre_y / height_px);
  const double area = (extent(x) / width_px) * (extent(y) / height_px);
  *to = static_cast<float>(std::log(std::max(area, kLeast)));
}

std::vector<std::string> landmark_column_names() {
  std::vector<std::string> names;
  for (int joint = 0; joint < kNumLandmarks; ++joint) {
    for (const char* axis : {"_x", "_y"}) names.push_back("joint" + std::to_string(joint) + axis);
  }
  for (int joint = 1; joint < kNumLandmarks; ++joint) {
    for (const char* axis : {"_x", "_y"}) names.push_back("bone" + std::to_string(joint) + axis);
  }
  for (const char* name : {"x", "y", "log_area"}) names.emplace_back(name);
  return names;
}

}  // namespace hri
