// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Between the library's images and OpenCV's.
#pragma once

#include <opencv2/imgproc.hpp>

#include "hri/core/image_view.hpp"

namespace hri::detail {

/// A header for the pixels of a picture of three channels; OpenCV has no read-only header, so they
/// must not be written to.
cv::Mat as_mat(ImageView bgr);

/// `picture`, or a copy scaled down so that its longer side has `max_side_px`.
cv::Mat scaled_down(const cv::Mat& picture, int max_side_px);

}  // namespace hri::detail
