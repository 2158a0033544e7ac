// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hri/core/simd.hpp"
#include "pictures.hpp"

namespace hri::detail {
namespace {

using std::size_t;
using std::uint16_t;
using std::uint8_t;

constexpr int kChannels = 3;
constexpr int kLargestFactor = 16;  // sums of 16 x 16 bytes still fit 16 bits
constexpr uint8_t kMost = 5;        // of nine

HRI_SIMD_CLONES void add_bytes(uint16_t* sums, const uint8_t* row, size_t count) {
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<uint16_t>(sums[i] + row[i]);
}

// sums[i] += sums[i + shift], in rising order.
HRI_SIMD_CLONES void fold(uint16_t* sums, size_t shift, size_t count) {
  const uint16_t* ahead = sums + shift;
  for (size_t i = 0; i < count; ++i) sums[i] = static_cast<uint16_t>(sums[i] + ahead[i]);
}

// Means of `area` bytes from their sums, rounded as OpenCV does: half up for four, else to even.
HRI_SIMD_CLONES void means(const uint16_t* sums, int area, uint8_t* out, size_t count) {
  if (area == 4) {
    for (size_t i = 0; i < count; ++i) out[i] = static_cast<uint8_t>((sums[i] + 2) >> 2);
    return;
  }
  constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23: adding it leaves no digits after the point
  const float share = 1.0F / static_cast<float>(area);
  for (size_t i = 0; i < count; ++i) {
    const float mean = static_cast<float>(sums[i]) * share;
    out[i] = static_cast<uint8_t>(static_cast<int>((mean + kRounder) - kRounder));
  }
}

HRI_SIMD_CLONES void greys(const uint8_t* bgr, uint8_t* grey, size_t count) {
  for (size_t i = 0; i < count; ++i, bgr += kChannels)
    grey[i] = static_cast<uint8_t>((3735 * bgr[0] + 19235 * bgr[1] + 9798 * bgr[2] + 16384) >> 15);
}

// How many of three rows are set; bytes are 0 or 255, which is -1.
HRI_SIMD_CLONES void count_down(const uint8_t* above, const uint8_t* row, const uint8_t* below,
                                uint8_t* counts, size_t width) {
  for (size_t x = 0; x < width; ++x)
    counts[x] = static_cast<uint8_t>(-(above[x] + row[x] + below[x]));
}

HRI_SIMD_CLONES void count_across(const uint8_t* counts, uint8_t* out, size_t width) {
  for (size_t x = 1; x + 1 < width; ++x) {
    const auto count = static_cast<uint8_t>(counts[x - 1] + counts[x] + counts[x + 1]);
    out[x] = count >= kMost ? 255 : 0;
  }
}

// Least and largest of the rows from `first` to `last`.
HRI_SIMD_CLONES void extremes_down(ImageView mask, int first, int last, uint8_t* least,
                                   uint8_t* largest, size_t width) {
  std::copy_n(mask.row(first), width, least);
  std::copy_n(mask.row(first), width, largest);
  for (int y = first + 1; y <= last; ++y) {
    const uint8_t* row = mask.row(y);
    for (size_t x = 0; x < width; ++x) {
      least[x] = std::min(least[x], row[x]);
      largest[x] = std::max(largest[x], row[x]);
    }
  }
}

// By how much a side shrinks; 0 where that is no whole number, or too much.
int whole_factor(ImageView bgr, int max_side_px) {
  const int longer = std::max(bgr.width_px, bgr.height_px);
  if (longer % max_side_px != 0) return 0;
  const int factor = longer / max_side_px;
  const bool whole = bgr.width_px % factor == 0 && bgr.height_px % factor == 0;
  return whole && factor <= kLargestFactor ? factor : 0;
}

}  // namespace

void ColourImage::resize(int width, int height) {
  width_px = width;
  height_px = height;
  pixels.resize(static_cast<size_t>(kChannels) * static_cast<size_t>(width) *
                static_cast<size_t>(height));
}

void resize(GreyImage* image, int width, int height) {
  image->width_px = width;
  image->height_px = height;
  image->pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
}

void Shrinker::shrink(ImageView bgr, int max_side_px, ColourImage* out) {
  if (std::max(bgr.width_px, bgr.height_px) <= max_side_px) {
    out->resize(bgr.width_px, bgr.height_px);
    const size_t length = static_cast<size_t>(kChannels) * static_cast<size_t>(bgr.width_px);
    for (int y = 0; y < bgr.height_px; ++y)
      std::copy_n(bgr.row(y), length, out->pixels.data() + static_cast<size_t>(y) * length);
    return;
  }
  if (const int factor = whole_factor(bgr, max_side_px); factor > 1) {
    shrink_by(bgr, factor, out);
    return;
  }
  const cv::Mat small = scaled_down(as_mat(bgr), max_side_px);
  out->resize(small.cols, small.rows);
  small.copyTo(cv::Mat(small.rows, small.cols, CV_8UC3, out->pixels.data()));
}

void Shrinker::shrink_by(ImageView bgr, int factor, ColourImage* out) {
  out->resize(bgr.width_px / factor, bgr.height_px / factor);
  const size_t length = static_cast<size_t>(kChannels) * static_cast<size_t>(bgr.width_px);
  const size_t small_length = length / static_cast<size_t>(factor);
  sums_.resize(length);
  folded_.resize(small_length);
  for (int y = 0; y < out->height_px; ++y) {
    std::fill(sums_.begin(), sums_.end(), uint16_t{0});
    for (int k = 0; k < factor; ++k) add_bytes(sums_.data(), bgr.row(y * factor + k), length);
    // Each pass doubles how many neighbours are in a sum; an odd rest is added one by one.
    size_t span = kChannels;
    int rest = factor;
    for (; rest % 2 == 0; rest /= 2, span *= 2) fold(sums_.data(), span, length - span);
    for (size_t x = 0; x < small_length; x += kChannels) {
      const uint16_t* from = sums_.data() + x * static_cast<size_t>(factor);
      for (size_t c = 0; c < kChannels; ++c) {
        uint16_t sum = from[c];
        for (int k = 1; k < rest; ++k)
          sum = static_cast<uint16_t>(sum + from[c + static_cast<size_t>(k) * span]);
        folded_[x + c] = sum;
      }
    }
    means(folded_.data(), factor * factor,
          out->pixels.data() + static_cast<size_t>(y) * small_length, small_length);
  }
}

void to_grey(const ColourImage& bgr, GreyImage* grey) {
  resize(grey, bgr.width_px, bgr.height_px);
  greys(bgr.pixels.data(), grey->pixels.data(), grey->pixels.size());
}

void majority(const GreyImage& mask, std::vector<uint8_t>* counts, GreyImage* out) {
  resize(out, mask.width_px, mask.height_px);
  const auto width = static_cast<size_t>(mask.width_px);
  counts->resize(width);
  const ImageView view = mask.view();
  for (int y = 0; y < mask.height_px; ++y) {
    uint8_t* row = out->pixels.data() + static_cast<size_t>(y) * width;
    uint8_t* sums = counts->data();
    count_down(view.row(std::max(y - 1, 0)), view.row(y),
               view.row(std::min(y + 1, mask.height_px - 1)), sums, width);
    const size_t last = width - 1;
    row[0] = 2 * sums[0] + sums[std::min<size_t>(1, last)] >= kMost ? 255 : 0;
    row[last] = 2 * sums[last] + sums[last > 0 ? last - 1 : 0] >= kMost ? 255 : 0;
    count_across(sums, row, width);
  }
}

void find_band(const GreyImage& mask, int radius_px, std::vector<uint8_t>* bytes, GreyImage* band) {
  resize(band, mask.width_px, mask.height_px);
  const auto width = static_cast<size_t>(mask.width_px);
  bytes->resize(2 * width);
  uint8_t* least = bytes->data();
  uint8_t* largest = least + width;
  for (int y = 0; y < mask.height_px; ++y) {
    extremes_down(mask.view(), std::max(y - radius_px, 0),
                  std::min(y + radius_px, mask.height_px - 1), least, largest, width);
    uint8_t* row = band->pixels.data() + static_cast<size_t>(y) * width;
    for (int x = 0; x < mask.width_px; ++x) {
      const int first = std::max(x - radius_px, 0);
      const int last = std::min(x + radius_px, mask.width_px - 1);
      const bool clear = *std::min_element(least + first, least + last + 1) == 0;
      const bool set = *std::max_element(largest + first, largest + last + 1) != 0;
      row[x] = clear && set ? 255 : 0;
    }
  }
}

}  // namespace hri::detail
