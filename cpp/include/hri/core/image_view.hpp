// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Images without OpenCV: a non-owning view of 8-bit pixels, and an owned binary mask.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hri {

/// Non-owning view of an 8-bit image with interleaved channels (1 = grey or mask, 3 = BGR as OpenCV
/// orders them).
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::ptrdiff_t stride_bytes = 0;  ///< from one row to the next; >= width_px * channels

  [[nodiscard]] const std::uint8_t* row(int y) const { return data + y * stride_bytes; }
  [[nodiscard]] std::uint8_t at(int x, int y, int c = 0) const { return row(y)[x * channels + c]; }
  [[nodiscard]] bool empty() const { return data == nullptr || width_px <= 0 || height_px <= 0; }
};

/// An owned 8-bit one-channel image; as a mask, 0 is background and 255 foreground.
struct GreyImage {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;

  GreyImage() = default;
  GreyImage(int width, int height)
      : pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        width_px(width),
        height_px(height) {}
  [[nodiscard]] ImageView view() const { return {pixels.data(), width_px, height_px, 1, width_px}; }
};

}  // namespace hri
