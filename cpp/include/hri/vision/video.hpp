// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Video files as frames with their times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"

namespace hri {

/// A picture of three interleaved channels (BGR), rows without gaps.
struct VideoFrame {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;
  double time_s = 0;  ///< since the video began; the rate of a webcam changes with the light

  [[nodiscard]] ImageView view() const {
    return {pixels.data(), width_px, height_px, 3, std::ptrdiff_t{3} * width_px};
  }
};

/// Reads one frame after the other, so that the length of a video does not matter. Not to be shared
/// by threads.
class HRI_API VideoReader {
 public:
  /// Throws IoError for a file that cannot be opened; FormatError for one that is no video, ends
  /// before its container does, or whose frames have more than 100 million pixels.
  explicit VideoReader(const std::string& path);
  ~VideoReader();
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;

  /// The next frame, into memory that is used again; false at the end. Throws FormatError for a
  /// video without frames, or whose time runs backwards.
  bool read(VideoFrame* frame);

 private:
  struct Capture;
  std::unique_ptr<Capture> capture_;
};

/// All frames of a clip. Throws as VideoReader does, and FormatError where they take more than
/// `max_bytes` of memory.
HRI_API std::vector<VideoFrame> read_video(const std::string& path,
                                           std::size_t max_bytes = std::size_t{4} << 30);

/// Views of frames, as HandSource takes them.
HRI_API std::vector<ImageView> views_of(const std::vector<VideoFrame>& frames);

}  // namespace hri
