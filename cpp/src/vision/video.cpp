// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/video.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/videoio.hpp>

#include "hri/core/error.hpp"
#include "hri/io/video_container.hpp"

namespace hri {
namespace {

constexpr double kMaxPixels = 1e8;  // more takes seconds a frame, and is no hand before a camera
constexpr double kReadsPastTheEnd[] = {4, 250};  // at least and at most

}  // namespace

struct VideoReader::Capture {
  std::string path;
  cv::VideoCapture video;
  cv::Mat picture;
  double last_s = -std::numeric_limits<double>::infinity();
  double interval_s = 0;  // between the last two frames
  std::size_t count = 0;
};

VideoReader::VideoReader(const std::string& path) : capture_(std::make_unique<Capture>()) {
  require_whole_video(path);
  capture_->path = path;
  if (!capture_->video.open(path))
    fail(ErrorKind::format, path + ": not a video that OpenCV reads");
  const double num_pixels = capture_->video.get(cv::CAP_PROP_FRAME_WIDTH) *
                            capture_->video.get(cv::CAP_PROP_FRAME_HEIGHT);
  if (num_pixels > kMaxPixels) {
    fail(ErrorKind::format, path + ": its frames have " + std::to_string(num_pixels) +
                                " pixels, more than " + std::to_string(kMaxPixels));
  }
}

VideoReader::~VideoReader() = default;
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;

bool VideoReader::read(VideoFrame* frame) {
  Capture& c = *capture_;
  if (!c.video.read(c.picture) || c.picture.empty()) {
    // A frame that cannot be decoded looks like the end, but others follow, unless it spoils them.
    const double missing = c.video.get(cv::CAP_PROP_FRAME_COUNT) - static_cast<double>(c.count);
    const double num_reads =
        std::clamp(std::isfinite(missing) ? missing : 0, kReadsPastTheEnd[0], kReadsPastTheEnd[1]);
    // NOLINTNEXTLINE(bugprone-float-loop-counter): whole numbers, 250 at most
    for (double i = 0; i < num_reads; ++i) {
      if (c.video.grab())
        fail(ErrorKind::format, c.path + ": frame " + std::to_string(c.count) + " is damaged");
    }
    if (c.count == 0) fail(ErrorKind::format, c.path + ": video without frames");
    return false;
  }
  if (c.picture.type() != CV_8UC3)
    fail(ErrorKind::format, c.path + ": frames have not three channels of 8 bits");
  double time_s = c.video.get(cv::CAP_PROP_POS_MSEC) / 1000.0;
  // OpenCV 4.6 gives 0 for the frames that the decoder still held at the end of the file,
  // as any codec that reorders frames does.
  if (time_s == 0 && c.last_s > 0) time_s = c.last_s + c.interval_s;
  if (!(time_s >= c.last_s)) {
    fail(ErrorKind::format, c.path + ": time runs backwards: frame " + std::to_string(c.count) +
                                " is at " + std::to_string(time_s) + " s, the one before at " +
                                std::to_string(c.last_s) + " s");
  }
  if (c.count > 0) c.interval_s = time_s - c.last_s;
  c.last_s = frame->time_s = time_s;
  ++c.count;
  frame->width_px = c.picture.cols;
  frame->height_px = c.picture.rows;
  const std::size_t length = 3 * static_cast<std::size_t>(frame->width_px);
  frame->pixels.resize(length * static_cast<std::size_t>(frame->height_px));
  for (int y = 0; y < frame->height_px; ++y) {
    std::copy_n(c.picture.ptr<std::uint8_t>(y), length,
                frame->pixels.data() + static_cast<std::size_t>(y) * length);
  }
  return true;
}

std::vector<VideoFrame> read_video(const std::string& path, std::size_t max_bytes) {
  VideoReader reader(path);
  std::vector<VideoFrame> frames;
  std::size_t bytes = 0;
  for (VideoFrame frame; reader.read(&frame);) {
    bytes += frame.pixels.size();
    if (bytes > max_bytes) {
      fail(ErrorKind::format, path + ": frames take more than " + std::to_string(max_bytes) +
                                  " bytes; read them one by one");
    }
    frames.push_back(frame);
  }
  return frames;
}

std::vector<ImageView> views_of(const std::vector<VideoFrame>& frames) {
  std::vector<ImageView> views;
  views.reserve(frames.size());
  for (const VideoFrame& frame : frames) views.push_back(frame.view());
  return views;
}

}  // namespace hri
