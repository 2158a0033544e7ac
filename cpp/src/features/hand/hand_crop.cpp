// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_crop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

struct Extent {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;
};

HRI_SIMD_CLONES bool any_set(const std::uint8_t* row, int count) {
  std::uint8_t all = 0;
  for (int x = 0; x < count; ++x) all = static_cast<std::uint8_t>(all | row[x]);
  return all != 0;
}

Extent extent_of(ImageView mask) {
  Extent e{mask.width_px, -1, mask.height_px, -1};
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* row = mask.row(y);
    if (!any_set(row, mask.width_px)) continue;
    int left = 0;
    while (left < e.left && row[left] == 0) ++left;
    int right = mask.width_px - 1;
    while (right > e.right && row[right] == 0) --right;
    e = {left, right, std::min(e.top, y), y};
  }
  return e;
}

// What the samples inside one pixel of the crop take from the rows (or columns) of the image: a
// bilinear sample takes from two neighbours, borders repeated, and neighbouring samples share them.
struct Taps {
  int first = 0;
  int count = 0;
  std::size_t weights = 0;  // where they begin
};

constexpr int kMaxSamples = 8;  // a side, inside one pixel of the crop

// Working memory of one thread.
struct Workspace {
  std::vector<Taps> across, down;
  std::vector<float> across_weights, down_weights;
  std::vector<float> rows;  // those that are needed, already scaled across
};

void find_taps(float start, float step, int size, int image_size, std::vector<Taps>* taps,
               std::vector<float>* weights) {
  const int samples = std::clamp(static_cast<int>(std::ceil(step)), 1, kMaxSamples);
  const auto share = 1.0F / static_cast<float>(samples);
  const auto last = static_cast<float>(image_size - 1);
  const auto at = [&](int pixel, int sample) {
    const float inside = (static_cast<float>(sample) + 0.5F) / static_cast<float>(samples);
    const float place = start + (static_cast<float>(pixel) + inside) * step - 0.5F;
    return std::clamp(place, 0.0F, last);
  };
  taps->clear();
  weights->clear();
  for (int i = 0; i < size; ++i) {
    const auto first = static_cast<int>(at(i, 0));
    const int end = std::min(static_cast<int>(at(i, samples - 1)) + 1, image_size - 1);
    const std::size_t begin = weights->size();
    weights->resize(begin + static_cast<std::size_t>(end - first + 1), 0.0F);
    for (int s = 0; s < samples; ++s) {
      const float place = at(i, s);
      const auto lower = static_cast<int>(place);
      const float upper_share = place - static_cast<float>(lower);
      const auto k = begin + static_cast<std::size_t>(lower - first);
      (*weights)[k] += (1 - upper_share) * share;
      if (upper_share > 0) (*weights)[k + 1] += upper_share * share;
    }
    taps->push_back({first, end - first + 1, begin});
  }
}

// One row of the image, scaled across.
void scale_row(const std::uint8_t* row, const std::vector<Taps>& taps, const float* weights,
               float* out) {
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const std::uint8_t* pixel = row + taps[i].first;
    const float* weight = weights + taps[i].weights;
    float sum = 0;
    for (int k = 0; k < taps[i].count; ++k) sum += weight[k] * static_cast<float>(pixel[k]);
    out[i] = sum;
  }
}

// What weights that add up to 1 +- rounding make of values up to 1 stays there.
HRI_SIMD_CLONES void cap(float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] = values[i] < 1.0F ? values[i] : 1.0F;
}

HRI_SIMD_CLONES void add_scaled(float* out, const float* row, float weight, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += weight * row[i];
}

}  // namespace

HandBox hand_box(ImageView mask, float max_aspect, float padding) {
  require(mask.channels == 1, "mask must have one channel");
  require(max_aspect > 0 && padding >= 0, "max_aspect must be positive, padding not negative");
  if (mask.empty()) return {};
  const Extent e = extent_of(mask);
  if (e.bottom < 0) return {};
  const auto width = static_cast<float>(e.right - e.left + 1);
  const float height = std::min(static_cast<float>(e.bottom - e.top + 1), max_aspect * width);
  const float side = std::max(width, height) * (1 + 2 * padding);
  const float centre_x = static_cast<float>(e.left) + width / 2;
  const float centre_y = static_cast<float>(e.top) + height / 2;
  return {centre_x - side / 2, centre_y - side / 2, side};
}

void crop(ImageView image, const HandBox& box, MatrixRefF out) {
  require(image.channels == 1 && !image.empty(),
          "image must have one channel and at least one pixel");
  require(box.side_px > 0 && out.rows() == out.cols() && out.rows() > 0,
          "box and out must be squares");
  require(std::isfinite(box.left_px) && std::isfinite(box.top_px) && std::isfinite(box.side_px),
          "box must be finite");
  const auto size = static_cast<int>(out.rows());
  const auto width = static_cast<std::size_t>(size);
  const float step = box.side_px / static_cast<float>(size);
  thread_local Workspace w;
  find_taps(box.left_px, step, size, image.width_px, &w.across, &w.across_weights);
  find_taps(box.top_px, step, size, image.height_px, &w.down, &w.down_weights);
  const int top = w.down.front().first;
  const int bottom = w.down.back().first + w.down.back().count;
  w.rows.resize(static_cast<std::size_t>(bottom - top) * width);
  for (int y = top; y < bottom; ++y) {
    scale_row(image.row(y), w.across, w.across_weights.data(),
              w.rows.data() + static_cast<std::size_t>(y - top) * width);
  }
  for (int y = 0; y < size; ++y) {
    float* row = out.data() + y * out.outerStride();
    std::fill(row, row + size, 0.0F);
    const Taps& taps = w.down[static_cast<std::size_t>(y)];
    for (int k = 0; k < taps.count; ++k) {
      const std::size_t from = static_cast<std::size_t>(taps.first + k - top) * width;
      const float weight = w.down_weights[taps.weights + static_cast<std::size_t>(k)] / 255.0F;
      add_scaled(row, w.rows.data() + from, weight, width);
    }
    cap(row, width);
  }
}

}  // namespace hri
