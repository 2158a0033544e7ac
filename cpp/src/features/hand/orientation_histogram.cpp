// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/orientation_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/numbers.hpp"
#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr auto kPiF = static_cast<float>(detail::kPi);
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

// Working memory of one thread.
struct CellWorkspace {
  std::vector<Share> columns;
  std::vector<float> x, y, magnitude;  // gradients of one row
  std::vector<float> position;         // their angles, then the shares of the upper of two bins
  std::vector<int> bin;                // the lower
  std::vector<float> cells;            // with a border that takes what falls beside them
  void resize(std::size_t count) {
    for (std::vector<float>* values : {&x, &y, &magnitude, &position}) values->resize(count);
    bin.resize(count);
  }
};

HRI_SIMD_CLONES void row_gradients(const float* above, const float* row, const float* below,
                                   std::size_t count, CellWorkspace* w) {
  float* gx = w->x.data();
  float* gy = w->y.data();
  float* magnitude = w->magnitude.data();
  for (std::size_t i = 0; i < count; ++i) {
    gx[i] = row[i + 2] - row[i];
    gy[i] = below[i + 1] - above[i + 1];
    magnitude[i] = std::sqrt(gx[i] * gx[i] + gy[i] * gy[i]);
  }
}

HRI_SIMD_CLONES void row_bins(std::size_t count, float num_bins, CellWorkspace* w) {
  float* position = w->position.data();
  int* bin = w->bin.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = position[i] < 0 ? position[i] + kPiF : position[i];
    const float place = angle / kPiF * num_bins - 0.5F;
    const auto nearer_zero = static_cast<int>(place);
    const int whole = nearer_zero - (static_cast<float>(nearer_zero) > place ? 1 : 0);
    position[i] = place - static_cast<float>(whole);
    bin[i] = whole;
  }
}

// Shares out the gradients of one row, each among 2 x 2 cells and 2 bins.
void add_row(const CellWorkspace& w, std::size_t count, Share row, int num_cells, int num_bins,
             float* cells) {
  const std::ptrdiff_t cell_row = static_cast<std::ptrdiff_t>(num_cells + 2) * num_bins;
  float* top = cells + (row.first + 1) * cell_row;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(w.magnitude[i] > 0)) continue;
    // Bins lie on a circle; only neighbours of its ends are met.
    int b0 = w.bin[i];
    if (b0 < 0) b0 += num_bins;
    if (b0 >= num_bins) b0 -= num_bins;
    const int b1 = b0 + 1 == num_bins ? 0 : b0 + 1;
    const float upper = w.position[i];
    const float lower = 1 - upper;
    const Share column = w.columns[i + 1];
    const float above = w.magnitude[i] * (1 - row.weight);
    const float below = w.magnitude[i] * row.weight;
    const float left = 1 - column.weight;
    const auto add = [&](float* cell, float weight) {
      cell[b0] += weight * lower;
      cell[b1] += weight * upper;
    };
    float* cell = top + static_cast<std::ptrdiff_t>(column.first + 1) * num_bins;
    add(cell, above * left);
    add(cell + num_bins, above * column.weight);
    add(cell + cell_row, below * left);
    add(cell + cell_row + num_bins, below * column.weight);
  }
}

void scale_to_unit(float* block, int size) {
  float squares = 0;
  for (int i = 0; i < size; ++i) squares += block[i] * block[i];
  const float scale = 1.0F / std::sqrt(squares + kFlat * kFlat);
  for (int i = 0; i < size; ++i) block[i] *= scale;
}

void normalise_block(float* block, int size) {
  scale_to_unit(block, size);
  float squares = 0;
  for (int i = 0; i < size; ++i) {
    block[i] = std::min(block[i], kClip);
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
  thread_local CellWorkspace workspace;
  CellWorkspace& w = workspace;
  const int bins = options.num_bins;
  const std::ptrdiff_t cell_row = static_cast<std::ptrdiff_t>(n + 2) * bins;
  w.cells.assign(static_cast<std::size_t>((n + 2) * cell_row), 0.0F);
  w.columns.resize(static_cast<std::size_t>(cols));
  for (int x = 0; x < cols; ++x) {
    w.columns[static_cast<std::size_t>(x)] = share_of(
        (static_cast<float>(x) + 0.5F) * static_cast<float>(n) / static_cast<float>(cols) - 0.5F);
  }
  const auto count = static_cast<std::size_t>(cols - 2);
  w.resize(count);
  for (int y = 1; y + 1 < rows; ++y) {
    const Share share = share_of(
        (static_cast<float>(y) + 0.5F) * static_cast<float>(n) / static_cast<float>(rows) - 0.5F);
    const float* row = image.data() + y * image.outerStride();
    row_gradients(row - image.outerStride(), row, row + image.outerStride(), count, &w);
    for (std::size_t i = 0; i < count; ++i)
      w.position[i] = w.magnitude[i] > 0 ? std::atan2(w.y[i], w.x[i]) : 0.0F;
    row_bins(count, static_cast<float>(bins), &w);
    add_row(w, count, share, n, bins, w.cells.data());
  }
  const float* cells = w.cells.data() + cell_row + bins;
  if (n == 1) {
    std::copy(cells, cells + bins, out.begin());
    // Not clipped: of few bins all would be the same.
    scale_to_unit(out.data(), bins);
    return;
  }
  float* block = out.data();
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x, block += 4 * bins) {
      for (int dy = 0; dy < 2; ++dy) {
        const float* from = cells + (y + dy) * cell_row + static_cast<std::ptrdiff_t>(x) * bins;
        std::copy(from, from + 2 * bins, block + 2 * bins * dy);
      }
      normalise_block(block, 4 * bins);
    }
  }
}

}  // namespace hri
