// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "hri/core/error.hpp"
#include "pictures.hpp"

namespace hri {
namespace {

// A threshold's result: the mask, and how far apart the classes lie.
struct Split {
  cv::Mat mask;
  double contrast = 0;  // difference of the classes' means
  double quality = 0;   // between-class share of the variance, 0..1
};

Split split_by_otsu(const cv::Mat& channel, bool bright_is_hand) {
  Split s;
  cv::threshold(channel, s.mask, 0, 255,
                cv::THRESH_OTSU | (bright_is_hand ? cv::THRESH_BINARY : cv::THRESH_BINARY_INV));
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(channel, mean, deviation);
  const double share = cv::countNonZero(s.mask) / static_cast<double>(s.mask.total());
  if (share <= 0 || share >= 1) return s;
  const double inside = cv::mean(channel, s.mask)[0];
  const double outside = (mean[0] - share * inside) / (1 - share);
  s.contrast = std::abs(inside - outside);
  const double variance = deviation[0] * deviation[0];
  if (variance > 0) s.quality = share * (1 - share) * s.contrast * s.contrast / variance;
  return s;
}

// A hand does not reach three corners of the picture: then the wall was taken for skin, because
// something else, such as a blue shirt, lies further from both.
bool holds_background(const cv::Mat& mask) {
  const int right = mask.cols - 1;
  const int bottom = mask.rows - 1;
  const int corners = (mask.at<uchar>(0, 0) != 0) + (mask.at<uchar>(0, right) != 0) +
                      (mask.at<uchar>(bottom, 0) != 0) + (mask.at<uchar>(bottom, right) != 0);
  return corners >= 3 ||
         (corners == 2 && mask.at<uchar>(0, 0) != 0 && mask.at<uchar>(0, right) != 0);
}

// Splits again what lies inside `coarse`, as an image of its own.
Split split_inside(const cv::Mat& channel, const Split& coarse) {
  std::vector<uchar> values;
  values.reserve(channel.total());
  for (int y = 0; y < channel.rows; ++y) {
    const auto* value = channel.ptr<uchar>(y);
    const auto* inside = coarse.mask.ptr<uchar>(y);
    for (int x = 0; x < channel.cols; ++x) {
      if (inside[x] != 0) values.push_back(value[x]);
    }
  }
  cv::Mat row(1, static_cast<int>(values.size()), CV_8U, values.data());
  Split fine = split_by_otsu(row, true);
  const double threshold = cv::threshold(row, row, 0, 255, cv::THRESH_OTSU | cv::THRESH_BINARY);
  cv::threshold(channel, fine.mask, threshold, 255, cv::THRESH_BINARY);
  return fine;
}

// Cr - Cb, shifted to 0..255.
cv::Mat redness(const cv::Mat& bgr) {
  cv::Mat ycrcb;
  cv::cvtColor(bgr, ycrcb, cv::COLOR_BGR2YCrCb);
  std::vector<cv::Mat> planes;
  cv::split(ycrcb, planes);
  cv::Mat difference;
  cv::addWeighted(planes[1], 1.0, planes[2], -1.0, 128.0, difference);
  return difference;
}

// Thesis section 5.1.1: hue 0..50 degrees, saturation 0.23..0.68 of the scale.
Split split_by_hsv(const cv::Mat& bgr) {
  Split s;
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  cv::inRange(hsv, cv::Scalar(0, 0.23 * 255, 40), cv::Scalar(25, 0.68 * 255, 255), s.mask);
  s.contrast = 255;
  s.quality = 1;
  return s;
}

Split split(const cv::Mat& bgr, SilhouetteMethod method) {
  if (method == SilhouetteMethod::hsv) return split_by_hsv(bgr);
  if (method == SilhouetteMethod::chroma_otsu) {
    const cv::Mat channel = redness(bgr);
    Split found = split_by_otsu(channel, true);
    if (holds_background(found.mask)) found = split_inside(channel, found);
    return found;
  }
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return split_by_otsu(grey, false);
}

// How well a region fills the ellipse that has its moments: 1 for an ellipse, less for a hand with
// fingers.
double ellipticity(const cv::Mat& labels, int label, const cv::Rect& box) {
  cv::Mat region = labels(box) == label;
  // Eyes, glasses and a mouth are holes in a face.
  std::vector<std::vector<cv::Point>> outline;
  cv::findContours(region.clone(), outline, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(region, outline, -1, cv::Scalar(255), cv::FILLED);
  const cv::Moments m = cv::moments(region, true);
  if (!(m.m00 > 0)) return 0;
  const double a = m.mu20 / m.m00;
  const double b = m.mu11 / m.m00;
  const double c = m.mu02 / m.m00;
  const double root = std::sqrt((a - c) * (a - c) + 4 * b * b);
  const double major = 2 * std::sqrt(std::max(0.0, (a + c + root) / 2));
  const double minor = 2 * std::sqrt(std::max(0.0, (a + c - root) / 2));
  const double angle = 0.5 * std::atan2(2 * b, a - c) * 180.0 / CV_PI;
  cv::Mat ellipse = cv::Mat::zeros(region.size(), CV_8U);
  cv::ellipse(ellipse,
              cv::RotatedRect(
                  cv::Point2f(static_cast<float>(m.m10 / m.m00), static_cast<float>(m.m01 / m.m00)),
                  cv::Size2f(static_cast<float>(2 * major), static_cast<float>(2 * minor)),
                  static_cast<float>(angle)),
              cv::Scalar(255), cv::FILLED);
  const double both = cv::countNonZero(region & ellipse);
  const double any = cv::countNonZero(region | ellipse);
  return any > 0 ? both / any : 0;
}

// The label of the hand among the connected regions of `mask`; 0 when there is none.
int hand_label(const cv::Mat& labels, const cv::Mat& stats, const SilhouetteOptions& options) {
  const double total = static_cast<double>(labels.total());
  std::vector<int> candidates;
  for (int i = 1; i < stats.rows; ++i) {
    const double area = stats.at<int>(i, cv::CC_STAT_AREA) / total;
    if (area >= options.min_area && area <= options.max_area) candidates.push_back(i);
  }
  const auto by_area = [&](int p, int q) {
    return stats.at<int>(p, cv::CC_STAT_AREA) > stats.at<int>(q, cv::CC_STAT_AREA);
  };
  std::stable_sort(candidates.begin(), candidates.end(), by_area);
  if (candidates.empty()) return 0;
  // Regions much smaller than the largest are specks, not a second body part.
  constexpr double kComparable = 0.15;
  const double least = kComparable * stats.at<int>(candidates.front(), cv::CC_STAT_AREA);
  while (stats.at<int>(candidates.back(), cv::CC_STAT_AREA) < least) candidates.pop_back();
  if (!options.remove_face || candidates.size() < 2) return candidates.front();
  std::size_t face = 0;
  double best = -1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const int* s = stats.ptr<int>(candidates[i]);
    const cv::Rect box(s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH],
                       s[cv::CC_STAT_HEIGHT]);
    const double likeness = ellipticity(labels, candidates[i], box);
    if (likeness > best) {
      best = likeness;
      face = i;
    }
  }
  candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(face));
  return candidates.front();
}

}  // namespace

SilhouetteExtractor::SilhouetteExtractor(const SilhouetteOptions& options) : options_(options) {
  require(options.max_side_px >= 32 && options.max_side_px <= 4096,
          "max_side_px must lie in 32..4096");
  require(options.blur_px >= 1 && options.blur_px <= 31 && options.blur_px % 2 == 1,
          "blur_px must be odd, 1..31");
  require(options.min_contrast >= 0 && options.min_contrast <= options.sure_contrast &&
              options.sure_contrast <= 255,
          "min_contrast and sure_contrast must lie in 0..255, min_contrast not above");
  require(options.min_quality >= 0 && options.min_quality <= 1, "min_quality must lie in 0..1");
  require(options.min_area >= 0 && options.min_area <= options.max_area && options.max_area <= 1,
          "min_area and max_area must lie in 0..1, min_area not above max_area");
}

Silhouette SilhouetteExtractor::extract(ImageView bgr) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  const cv::Mat small = detail::scaled_down(detail::as_mat(bgr), options_.max_side_px);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  cv::Mat smooth;
  cv::GaussianBlur(small, smooth, cv::Size(options_.blur_px, options_.blur_px), 0);

  Silhouette result;
  result.grey = detail::copy_of(grey);
  result.mask = GreyImage(grey.cols, grey.rows);
  Split found = split(smooth, options_.method);
  if (found.contrast < options_.min_contrast) return result;
  if (found.contrast < options_.sure_contrast && found.quality < options_.min_quality)
    return result;
  cv::medianBlur(found.mask, found.mask, options_.blur_px);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  cv::connectedComponentsWithStats(found.mask, labels, stats, centroids);
  const int hand = hand_label(labels, stats, options_);
  if (hand == 0) return result;
  result.mask = detail::copy_of(labels == hand);
  result.quality = std::clamp(found.quality, 0.0, 1.0);
  return result;
}

}  // namespace hri
