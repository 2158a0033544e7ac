// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/pictures.hpp"

#include <algorithm>

namespace hri::detail {

cv::Mat as_mat(ImageView bgr) {
  return {bgr.height_px, bgr.width_px, CV_8UC3, const_cast<std::uint8_t*>(bgr.data),
          static_cast<std::size_t>(bgr.stride_bytes)};
}

cv::Mat scaled_down(const cv::Mat& picture, int max_side_px) {
  const double scale = max_side_px / static_cast<double>(std::max(picture.cols, picture.rows));
  if (scale >= 1) return picture;
  // A strip keeps at least one row or column.
  const cv::Size size(std::max(1, cvRound(picture.cols * scale)),
                      std::max(1, cvRound(picture.rows * scale)));
  cv::Mat small;
  cv::resize(picture, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace hri::detail
