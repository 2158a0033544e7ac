// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/simd.hpp"
#include "vision/pictures.hpp"

namespace hri::detail {
namespace {

using std::size_t;
using std::uint16_t;
using std::uint8_t;

constexpr int kChannels = 3;
constexpr int kLargestFactor = 16;  // sums of 16 x 16 bytes still fit 16 bits

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

// Adds one row of a mask of 0 and 255, which is -1, to counts.
HRI_SIMD_CLONES void count_row(const uint8_t* row, uint16_t* counts, size_t width) {
  for (size_t x = 0; x < width; ++x) counts[x] = static_cast<uint16_t>(counts[x] + (row[x] & 1));
}

HRI_SIMD_CLONES void add_counts(const uint16_t* counts, uint16_t* sums, size_t width) {
  for (size_t x = 0; x < width; ++x) sums[x] = static_cast<uint16_t>(sums[x] + counts[x]);
}

HRI_SIMD_CLONES void set_most(const uint16_t* sums, int most, uint8_t* out, size_t width) {
  const auto least = static_cast<uint16_t>(most);
  for (size_t x = 0; x < width; ++x) out[x] = sums[x] >= least ? 255 : 0;
}

constexpr size_t kChunk = 256;  // pixels whose channels are taken apart at a time

struct Channels {
  alignas(64) std::array<uint8_t, kChunk> blue, green, red;
};

HRI_SIMD_CLONES void take_apart(const uint8_t* bgr, size_t count, Channels* out) {
  for (size_t i = 0; i < count; ++i) {
    out->blue[i] = bgr[3 * i];
    out->green[i] = bgr[3 * i + 1];
    out->red[i] = bgr[3 * i + 2];
  }
}

// In 16 bits, in which twice the registers' numbers fit: 11682 and 9241 are parts of 2^14, and
// differences are doubled to be multiplied by parts of 2^15.
HRI_SIMD_CLONES void rednesses(const Channels& in, size_t count, uint8_t* out) {
  for (size_t i = 0; i < count; ++i) {
    const auto y = static_cast<std::int16_t>(
        (1868 * in.blue[i] + 9617 * in.green[i] + 4899 * in.red[i] + (1 << 13)) >> 14);
    const auto from_red = static_cast<std::int16_t>(2 * (in.red[i] - y));
    const auto from_blue = static_cast<std::int16_t>(2 * (in.blue[i] - y));
    auto cr = static_cast<std::int16_t>((from_red * 11682 + (1 << 14)) >> 15);
    auto cb = static_cast<std::int16_t>((from_blue * 9241 + (1 << 14)) >> 15);
    cr = cr < -128 ? std::int16_t{-128} : cr;
    cr = cr > 127 ? std::int16_t{127} : cr;
    cb = cb < -128 ? std::int16_t{-128} : cb;
    cb = cb > 127 ? std::int16_t{127} : cb;
    auto difference = static_cast<std::int16_t>(cr - cb + 128);
    difference = difference < 0 ? std::int16_t{0} : difference;
    difference = difference > 255 ? std::int16_t{255} : difference;
    out[i] = static_cast<uint8_t>(difference);
  }
}

HRI_SIMD_CLONES void set_above(const uint8_t* in, int threshold, uint8_t set, uint8_t* out,
                               size_t count) {
  const auto clear = static_cast<uint8_t>(255 - set);
  for (size_t i = 0; i < count; ++i) out[i] = in[i] > threshold ? set : clear;
}

// 1, 4, 6, 4, 1 along a row of three channels that has two pixels more on either side.
HRI_SIMD_CLONES void smooth_across(const uint8_t* padded, uint16_t* out, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    out[i] = static_cast<uint16_t>(padded[i] + padded[i + 12] +
                                   4 * (padded[i + 3] + padded[i + 9]) + 6 * padded[i + 6]);
  }
}

HRI_SIMD_CLONES void smooth_down(const std::array<const uint16_t*, 5>& rows, uint8_t* out,
                                 size_t count) {
  const uint16_t* a = rows[0];
  const uint16_t* b = rows[1];
  const uint16_t* c = rows[2];
  const uint16_t* d = rows[3];
  const uint16_t* e = rows[4];
  for (size_t i = 0; i < count; ++i) {
    const auto sum = static_cast<uint16_t>(a[i] + e[i] + 4 * (b[i] + d[i]) + 6 * c[i] + 128);
    out[i] = static_cast<uint8_t>(sum >> 8);
  }
}

// Where a row or column outside the picture is mirrored to, the border itself not repeated.
int mirrored(int i, int size) {
  if (size == 1) return 0;
  while (i < 0 || i >= size) i = i < 0 ? -i : 2 * (size - 1) - i;
  return i;
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
  sums_.resize(length + 1);  // a pixel is copied with what follows it, in one go
  folded_.resize(small_length + 1);
  for (int y = 0; y < out->height_px; ++y) {
    std::fill(sums_.begin(), sums_.end(), uint16_t{0});
    for (int k = 0; k < factor; ++k) add_bytes(sums_.data(), bgr.row(y * factor + k), length);
    // Each pass doubles how many neighbours are in a sum; an odd rest is added one by one.
    size_t span = kChannels;
    int rest = factor;
    for (; rest % 2 == 0; rest /= 2, span *= 2) fold(sums_.data(), span, length - span);
    if (rest == 1) {
      for (size_t x = 0; x < small_length; x += kChannels)
        std::memcpy(&folded_[x], &sums_[x * static_cast<size_t>(factor)], 4 * sizeof(uint16_t));
    }
    for (size_t x = 0; rest > 1 && x < small_length; x += kChannels) {
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

void majority(const GreyImage& mask, int radius_px, std::vector<uint16_t>* counts, GreyImage* out) {
  resize(out, mask.width_px, mask.height_px);
  const auto width = static_cast<size_t>(mask.width_px);
  const auto radius = static_cast<size_t>(radius_px);
  const int most = (2 * radius_px + 1) * (2 * radius_px + 1) / 2 + 1;
  counts->resize(2 * width + 2 * radius);
  uint16_t* padded = counts->data();  // of the columns, with the outermost ones repeated
  uint16_t* sums = padded + width + 2 * radius;
  const ImageView view = mask.view();
  for (int y = 0; y < mask.height_px; ++y) {
    std::fill_n(padded + radius, width, uint16_t{0});
    for (int dy = -radius_px; dy <= radius_px; ++dy)
      count_row(view.row(std::clamp(y + dy, 0, mask.height_px - 1)), padded + radius, width);
    std::fill_n(padded, radius, padded[radius]);
    std::fill_n(padded + radius + width, radius, padded[radius + width - 1]);
    std::copy_n(padded, width, sums);
    for (size_t dx = 1; dx <= 2 * radius; ++dx) add_counts(padded + dx, sums, width);
    set_most(sums, most, out->pixels.data() + static_cast<size_t>(y) * width, width);
  }
}

void Smoother::smooth(const ColourImage& bgr, int blur_px, ColourImage* out) {
  if (blur_px == 5) {
    smooth_five(bgr, out);
    return;
  }
  out->resize(bgr.width_px, bgr.height_px);
  cv::Mat smooth(out->height_px, out->width_px, CV_8UC3, out->pixels.data());
  cv::GaussianBlur(as_mat(bgr.view()), smooth, cv::Size(blur_px, blur_px), 0);
}

void Smoother::smooth_five(const ColourImage& bgr, ColourImage* out) {
  constexpr int kRows = 5;
  out->resize(bgr.width_px, bgr.height_px);
  const size_t length = static_cast<size_t>(kChannels) * static_cast<size_t>(bgr.width_px);
  padded_.resize(length + 4 * kChannels);
  rows_.resize(kRows * length);
  const ImageView view = bgr.view();
  const auto row_at = [&](int y) {
    return rows_.data() + static_cast<size_t>(mirrored(y, bgr.height_px) % kRows) * length;
  };
  int next = 0;  // the first row that is not smoothed across yet
  for (int y = 0; y < bgr.height_px; ++y) {
    for (; next < bgr.height_px && next <= y + 2; ++next) {
      std::copy_n(view.row(next), length, padded_.data() + 2 * kChannels);
      for (const int x : {-2, -1, bgr.width_px, bgr.width_px + 1}) {
        const auto from = static_cast<std::ptrdiff_t>(kChannels) * mirrored(x, bgr.width_px);
        std::copy_n(view.row(next) + from, kChannels,
                    padded_.data() + static_cast<std::ptrdiff_t>(kChannels) * (x + 2));
      }
      smooth_across(padded_.data(), row_at(next), length);
    }
    smooth_down({row_at(y - 2), row_at(y - 1), row_at(y), row_at(y + 1), row_at(y + 2)},
                out->pixels.data() + static_cast<size_t>(y) * length, length);
  }
}

void to_redness(const ColourImage& bgr, GreyImage* redness) {
  resize(redness, bgr.width_px, bgr.height_px);
  Channels channels;
  const size_t total = redness->pixels.size();
  for (size_t first = 0; first < total; first += kChunk) {
    const size_t count = std::min(kChunk, total - first);
    take_apart(bgr.pixels.data() + kChannels * first, count, &channels);
    rednesses(channels, count, redness->pixels.data() + first);
  }
}

std::array<std::int64_t, 256> histogram(const GreyImage& image) {
  // Neighbours are often equal: counting them apart does not wait for the last sum to be stored.
  std::array<std::array<std::uint32_t, 256>, 4> counts{};
  const size_t count = image.pixels.size();
  const uint8_t* pixels = image.pixels.data();
  for (size_t i = 0; i < count; ++i) ++counts[i % 4][pixels[i]];
  std::array<std::int64_t, 256> result{};
  for (const auto& part : counts) {
    for (size_t v = 0; v < result.size(); ++v) result[v] += part[v];
  }
  return result;
}

void set_where(const GreyImage& image, int threshold, bool above, GreyImage* mask) {
  resize(mask, image.width_px, image.height_px);
  set_above(image.pixels.data(), threshold, above ? 255 : 0, mask->pixels.data(),
            image.pixels.size());
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
