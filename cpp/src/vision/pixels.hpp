// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that every pixel of a picture goes through. Buffers are kept by the caller and only grow,
// so that a stream of pictures of one size allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hri/core/image_view.hpp"

namespace hri::detail {

/// Three interleaved channels, rows without gaps.
struct ColourImage {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;

  void resize(int width, int height);
  [[nodiscard]] std::size_t num_pixels() const { return pixels.size() / 3; }
  [[nodiscard]] ImageView view() const {
    return {pixels.data(), width_px, height_px, 3, std::ptrdiff_t{3} * width_px};
  }
};

/// Gives `image` the size; what it holds then is not said.
void resize(GreyImage* image, int width, int height);

/// Scales pictures down by averaging what a pixel covers.
class Shrinker {
 public:
  /// `out` becomes `bgr`, scaled down so that its longer side has `max_side_px`; a smaller picture
  /// is copied.
  void shrink(ImageView bgr, int max_side_px, ColourImage* out);

 private:
  void shrink_by(ImageView bgr, int factor, ColourImage* out);

  std::vector<std::uint16_t> sums_, folded_;
};

/// Brightness as OpenCV weighs the channels.
void to_grey(const ColourImage& bgr, GreyImage* grey);

/// What most of the pixels around every pixel of a mask of 0 and 255 are, within `radius_px` along
/// rows and columns, up to 15; borders repeat. `counts` is working memory; `out` must not be
/// `mask`.
void majority(const GreyImage& mask, int radius_px, std::vector<std::uint16_t>* counts,
              GreyImage* out);

/// Smooths pictures as OpenCV's Gaussian blur of 1, 3, 5, ... pixels does.
class Smoother {
 public:
  void smooth(const ColourImage& bgr, int blur_px, ColourImage* out);

 private:
  void smooth_five(const ColourImage& bgr, ColourImage* out);

  std::vector<std::uint8_t> padded_;
  std::vector<std::uint16_t> rows_;
};

/// Cr - Cb + 128, as OpenCV rounds them: what is red is bright.
void to_redness(const ColourImage& bgr, GreyImage* redness);

/// How many pixels have every value.
std::array<std::int64_t, 256> histogram(const GreyImage& image);

/// Sets in `mask` what is above the threshold, or what is not, to 255.
void set_where(const GreyImage& image, int threshold, bool above, GreyImage* mask);

/// Sets in `band` the pixels that have both kinds of pixels of the mask within `radius_px`, counted
/// along rows and columns. `bytes` is working memory.
void find_band(const GreyImage& mask, int radius_px, std::vector<std::uint8_t>* bytes,
               GreyImage* band);

}  // namespace hri::detail
