// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/skin_model.hpp"

#include <opencv2/imgproc.hpp>

namespace hri::detail {
namespace {

constexpr double kSpread = 1.0;  // of the smoothing, in bins
constexpr double kFloor = 1e-5;  // share of a bin that holds nothing

}  // namespace

void ChromaHistogram::clear() { counts_.setTo(0); }

void ChromaHistogram::blend(const ChromaHistogram& other) {
  counts_ = counts_ / cv::sum(counts_)[0] + other.counts_ / cv::sum(other.counts_)[0];
}

cv::Mat ChromaHistogram::shares() const {
  cv::Mat smooth;
  cv::GaussianBlur(counts_, smooth, cv::Size(), kSpread);
  return smooth / cv::sum(smooth)[0];
}

cv::Mat log_ratios(const ChromaHistogram& skin, const ChromaHistogram& room) {
  cv::Mat of_skin;
  cv::Mat of_room;
  cv::log(skin.shares() + kFloor, of_skin);
  cv::log(room.shares() + kFloor, of_room);
  return of_skin - of_room;
}

}  // namespace hri::detail
