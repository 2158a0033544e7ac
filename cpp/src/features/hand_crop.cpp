// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand_crop.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

struct Extent {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;
};

Extent extent_of(ImageView mask) {
  Extent e{mask.width_px, -1, mask.height_px, -1};
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* row = mask.row(y);
    for (int x = 0; x < mask.width_px; ++x) {
      if (row[x] == 0) continue;
      e.left = std::min(e.left, x);
      e.right = std::max(e.right, x);
      e.top = std::min(e.top, y);
      e.bottom = y;
    }
  }
  return e;
}

// Bilinear value at a point given in pixel centres, borders repeated.
float sample(ImageView image, float y, float x) {
  const float fy = std::clamp(y, 0.0F, static_cast<float>(image.height_px - 1));
  const float fx = std::clamp(x, 0.0F, static_cast<float>(image.width_px - 1));
  const int y0 = static_cast<int>(fy);
  const int x0 = static_cast<int>(fx);
  const int y1 = std::min(y0 + 1, image.height_px - 1);
  const int x1 = std::min(x0 + 1, image.width_px - 1);
  const float wy = fy - static_cast<float>(y0);
  const float wx = fx - static_cast<float>(x0);
  const std::uint8_t* r0 = image.row(y0);
  const std::uint8_t* r1 = image.row(y1);
  const float upper = static_cast<float>(r0[x0]) * (1 - wx) + static_cast<float>(r0[x1]) * wx;
  const float lower = static_cast<float>(r1[x0]) * (1 - wx) + static_cast<float>(r1[x1]) * wx;
  return upper * (1 - wy) + lower * wy;
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
  const float step = box.side_px / static_cast<float>(size);
  const int samples = std::clamp(static_cast<int>(std::ceil(step)), 1, 8);
  const float scale = 1.0F / (255.0F * static_cast<float>(samples * samples));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      float sum = 0;
      for (int sy = 0; sy < samples; ++sy) {
        const float fy = box.top_px + (static_cast<float>(y) + (static_cast<float>(sy) + 0.5F) /
                                                                   static_cast<float>(samples)) *
                                          step;
        for (int sx = 0; sx < samples; ++sx) {
          const float fx = box.left_px + (static_cast<float>(x) + (static_cast<float>(sx) + 0.5F) /
                                                                      static_cast<float>(samples)) *
                                             step;
          sum += sample(image, fy - 0.5F, fx - 0.5F);
        }
      }
      out(y, x) = sum * scale;
    }
  }
}

}  // namespace hri
