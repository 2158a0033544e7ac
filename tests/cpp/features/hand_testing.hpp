// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "hri/core/image_view.hpp"

namespace hri::hand_testing {

/// The mask of a palm with `num_fingers` fingers, moved, scaled and turned (clockwise).
inline GreyImage hand(int num_fingers, double x_px = 100, double y_px = 120, double scale = 1.0,
                      double turn_rad = 0.0) {
  GreyImage mask(200, 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double dx = (x - x_px) / scale;
      const double dy = (y - y_px) / scale;
      const double u = dx * std::cos(turn_rad) + dy * std::sin(turn_rad);
      const double v = dy * std::cos(turn_rad) - dx * std::sin(turn_rad);
      bool inside = u * u + v * v < 30 * 30;
      for (int f = 0; f < num_fingers; ++f) {
        const double angle = -0.9 + 0.45 * f;
        const double along = u * std::sin(angle) - v * std::cos(angle);
        const double across = u * std::cos(angle) + v * std::sin(angle);
        inside = inside || (along > 0 && along < 75 && std::abs(across) < 6);
      }
      if (inside) mask.pixels[static_cast<std::size_t>(y * 200 + x)] = 255;
    }
  }
  return mask;
}

/// A grey picture of the same: a bright hand on a dark wall.
inline GreyImage grey(const GreyImage& mask) {
  GreyImage image = mask;
  for (auto& p : image.pixels) p = p != 0 ? 180 : 60;
  return image;
}

}  // namespace hri::hand_testing
