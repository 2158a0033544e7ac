// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/orientation_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr float kPi = 3.14159265358979F;
constexpr float kClip = 0.2F;
constexpr float kFlat = 0.1F;  // length below which a block counts as flat, in units of the image
constexpr float kLargest = 1e6F;  // sums of squares of gradients of larger values may overflow

HRI_SIMD_CLONES bool all_within(const float* values, std::size_t count) {
  int outside = 0;
  for (std::size_t i = 0; i < count; ++i) outside += std::abs(values[i]) <= kLargest ? 0 : 1;
  return outside == 0;
}

// A gradient that is not finite has no bin.
void check_values(ConstMatrixRefF image) {
  for (Eigen::Index y = 0; y < image.rows(); ++y) {
    if (all_within(image.data() + y * image.outerStride(), static_cast<std::size_t>(image.cols())))
      continue;
    for (Eigen::Index x = 0; x < image.cols(); ++x) {
      if (std::abs(image(y, x)) <= kLargest) continue;
      fail(ErrorKind::invalid_argument, "image must lie within -1e6..1e6 and be finite, got " +
                                            std::to_string(image(y, x)) + " at row " +
                                            std::to_string(y) + ", column " + std::to_string(x));
    }
  }
}

// Two neighbours along one axis and the share of the second.
struct Share {
  int first = 0;
  float weight = 0;
};

Share share_of(float position) {
  const float below = std::floor(position);
  return {static_cast<int>(below), position - below};
}

// Shares out one gradient among 2 x 2 cells and 2 bins.
class CellHistogram {
 public:
  CellHistogram(int num_cells, int num_bins, std::vector<float>* values)
      : num_cells_(num_cells), num_bins_(num_bins), values_(values) {
    values_->assign(static_cast<std::size_t>(num_cells) * num_cells * num_bins, 0.0F);
  }
  void add(Share y, Share x, float angle, float magnitude) {
    const Share bin = share_of(angle / kPi * static_cast<float>(num_bins_) - 0.5F);
    const int b0 = wrapped(bin.first);
    const int b1 = wrapped(b0 + 1);
    const float lower = 1 - bin.weight;
    for (int dy = 0; dy < 2; ++dy) {
      const int cy = y.first + dy;
      if (cy < 0 || cy >= num_cells_) continue;
      for (int dx = 0; dx < 2; ++dx) {
        const int cx = x.first + dx;
        if (cx < 0 || cx >= num_cells_) continue;
        const float w =
            magnitude * (dy == 1 ? y.weight : 1 - y.weight) * (dx == 1 ? x.weight : 1 - x.weight);
        float* cell =
            values_->data() + (static_cast<std::ptrdiff_t>(cy) * num_cells_ + cx) * num_bins_;
        cell[b0] += w * lower;
        cell[b1] += w * bin.weight;
      }
    }
  }

 private:
  // Bins lie on a circle; only neighbours of its ends are asked for.
  [[nodiscard]] int wrapped(int bin) const {
    if (bin < 0) return bin + num_bins_;
    return bin >= num_bins_ ? bin - num_bins_ : bin;
  }

  int num_cells_;
  int num_bins_;
  std::vector<float>* values_;
};

void normalise_block(float* block, int size) {
  float squares = 0;
  for (int i = 0; i < size; ++i) squares += block[i] * block[i];
  const float scale = 1.0F / std::sqrt(squares + kFlat * kFlat);
  squares = 0;
  for (int i = 0; i < size; ++i) {
    block[i] = std::min(block[i] * scale, kClip);
    squares += block[i] * block[i];
  }
  if (!(squares > 0)) return;
  const float again = 1.0F / std::sqrt(squares + 1e-3F);
  for (int i = 0; i < size; ++i) block[i] *= again;
}

}  // namespace

int orientation_histogram_size(const OrientationHistogramOptions& options) {
  validate(options);
  if (options.num_cells == 1) return options.num_bins;
  return (options.num_cells - 1) * (options.num_cells - 1) * 4 * options.num_bins;
}

void orientation_histogram(ConstMatrixRefF image, const OrientationHistogramOptions& options,
                           Span<float> out) {
  require(out.size() == static_cast<std::size_t>(orientation_histogram_size(options)),
          "out must have orientation_histogram_size() values");
  const int n = options.num_cells;
  const auto rows = static_cast<int>(image.rows());
  const auto cols = static_cast<int>(image.cols());
  require(rows >= std::max(3, n) && cols >= std::max(3, n),
          "image must have at least 3 and num_cells rows and columns");
  check_values(image);
  thread_local std::vector<float> cells;
  CellHistogram histogram(n, options.num_bins, &cells);
  thread_local std::vector<Share> columns;
  columns.resize(static_cast<std::size_t>(cols));
  for (int x = 0; x < cols; ++x) {
    columns[static_cast<std::size_t>(x)] = share_of(
        (static_cast<float>(x) + 0.5F) * static_cast<float>(n) / static_cast<float>(cols) - 0.5F);
  }
  for (int y = 1; y + 1 < rows; ++y) {
    const Share sy = share_of(
        (static_cast<float>(y) + 0.5F) * static_cast<float>(n) / static_cast<float>(rows) - 0.5F);
    for (int x = 1; x + 1 < cols; ++x) {
      const float gx = image(y, x + 1) - image(y, x - 1);
      const float gy = image(y + 1, x) - image(y - 1, x);
      if (gx == 0 && gy == 0) continue;
      float angle = std::atan2(gy, gx);
      if (angle < 0) angle += kPi;
      histogram.add(sy, columns[static_cast<std::size_t>(x)], angle, std::sqrt(gx * gx + gy * gy));
    }
  }
  const int bins = options.num_bins;
  if (n == 1) {
    std::copy(cells.begin(), cells.end(), out.begin());
    normalise_block(out.data(), bins);
    return;
  }
  float* block = out.data();
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x, block += 4 * bins) {
      for (int dy = 0; dy < 2; ++dy) {
        const float* from = cells.data() + (static_cast<std::ptrdiff_t>(y + dy) * n + x) * bins;
        std::copy(from, from + 2 * bins, block + 2 * bins * dy);
      }
      normalise_block(block, 4 * bins);
    }
  }
}

}  // namespace hri
