// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any options of hand features, with any picture and mask: refused, or features that are numbers.
#include <algorithm>
#include <vector>

#include "fuzzing.hpp"
#include "hri/features/hand/hand_features.hpp"
#include "hri/recognition/gesture/gesture_segmenter.hpp"

namespace {

using hri::fuzzing::Bytes;

// Boxes of white on black, or bytes as they come.
std::vector<std::uint8_t> draw_mask(Bytes& bytes, int width, int height) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  if ((bytes.byte() & 7) == 0) {
    for (std::uint8_t& v : mask) v = (bytes.byte() & 1) != 0 ? std::uint8_t{255} : std::uint8_t{0};
    return mask;
  }
  for (int i = bytes.byte() % 5; i >= 0; --i) {
    const int left = bytes.below(width);
    const int right = left + 1 + bytes.below(width - left);
    const int top = bytes.below(height);
    const int bottom = top + 1 + bytes.below(height - top);
    for (int y = top; y < bottom && y < height; ++y) {
      for (int x = left; x < right && x < width; ++x)
        mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x)] = 255;
    }
  }
  return mask;
}

void features(Bytes& bytes) {
  hri::HandFeatureOptions options;
  hri::fuzzing::draw_options(bytes, &options);
  // What is large by right takes long by right.
  options.crop_px = std::min(options.crop_px, 128);
  options.cepstrum.mask_px = std::min(options.cepstrum.mask_px, 256);
  const hri::HandFeatureComputer computer(options);
  const int width = 1 + bytes.below(160);
  const int height = 1 + bytes.below(120);
  const auto mask = draw_mask(bytes, width, height);
  const auto grey = draw_mask(bytes, width, height);
  const hri::ImageView mask_view{mask.data(), width, height, 1, width};
  const hri::ImageView grey_view{grey.data(), width, height, 1, width};
  if (!computer.compute(grey_view, mask_view).allFinite()) std::abort();
}

void segments(Bytes& bytes) {
  hri::GestureSegmenterOptions options;
  hri::fuzzing::draw_options(bytes, &options);
  hri::GestureSegmenter segmenter(options);
  double time_s = bytes.number(0, 10);
  while (!bytes.ended()) {
    const int width = 1 + bytes.below(40);
    const int height = 1 + bytes.below(30);
    const auto mask = draw_mask(bytes, width, height);
    const auto segment = segmenter.push({mask.data(), width, height, 1, width}, time_s);
    if (segment.kind == hri::GestureSegmentKind::end && !(segment.last_s >= segment.first_s))
      std::abort();
    time_s += (bytes.byte() & 15) != 0 ? 0.04 : bytes.number(0, 2);
    if ((bytes.byte() & 31) == 0) static_cast<void>(segmenter.interrupt());
  }
  static_cast<void>(segmenter.finish());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    Bytes bytes(data, size);
    if (bytes.byte() % 4 == 0) {
      segments(bytes);
    } else {
      features(bytes);
    }
  });
  return 0;
}
