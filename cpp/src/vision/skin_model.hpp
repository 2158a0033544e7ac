// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Skin against a room by the ratio of histograms of Cr and Cb (Jones and Rehg 2002).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace hri::detail {

constexpr int kChromaBins = 128;  ///< of Cr, and of Cb

/// A smoothed histogram of Cr and Cb.
class ChromaHistogram {
 public:
  void clear();
  /// Counts a pixel of Y, Cr, Cb.
  void add(const std::uint8_t* ycrcb) { counts_.at<float>(ycrcb[1] / 2, ycrcb[2] / 2) += 1.0F; }
  [[nodiscard]] bool empty() const { return cv::countNonZero(counts_) == 0; }
  /// Makes the counts shares, and adds those of another, equally weighted.
  void blend(const ChromaHistogram& other);
  /// Shares of the counts, smoothed, shape (kChromaBins, kChromaBins).
  [[nodiscard]] cv::Mat shares() const;

 private:
  cv::Mat counts_ = cv::Mat::zeros(kChromaBins, kChromaBins, CV_32F);
};

/// log(skin / room) of every pair of bins, float.
cv::Mat log_ratios(const ChromaHistogram& skin, const ChromaHistogram& room);

}  // namespace hri::detail
