// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/silhouette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/features/hand/regions.hpp"
#include "vision/mask_quality.hpp"
#include "vision/pictures.hpp"
#include "vision/pixels.hpp"

namespace hri {
namespace {

// How a picture is split in two.
struct Split {
  int threshold = 0;
  double contrast = 0;  // difference of the classes' means
  double quality = 0;   // between-class share of the variance, 0..1
};

using Histogram = std::array<std::int64_t, 256>;

// Otsu's threshold, as OpenCV finds it; values above it are the other class.
int otsu_threshold(const Histogram& counts, double total, double mean) {
  double below_mean = 0;
  double below = 0;
  double largest = 0;
  int best = 0;
  for (int v = 0; v < 256; ++v) {
    const double share = static_cast<double>(counts[static_cast<std::size_t>(v)]) / total;
    below_mean *= below;
    below += share;
    const double above = 1 - below;
    constexpr double kNone = std::numeric_limits<float>::epsilon();
    if (std::min(below, above) < kNone || std::max(below, above) > 1 - kNone) continue;
    below_mean = (below_mean + v * share) / below;
    const double above_mean = (mean - below * below_mean) / above;
    const double between = below * above * (below_mean - above_mean) * (below_mean - above_mean);
    if (between > largest) {
      largest = between;
      best = v;
    }
  }
  return best;
}

// Of the values above `least`.
Split split_by_otsu(const Histogram& all, int least = -1) {
  Histogram counts = all;
  std::fill(counts.begin(), counts.begin() + (least + 1), 0);
  double total = 0;
  double sum = 0;
  double squares = 0;
  for (int v = 0; v < 256; ++v) {
    const auto count = static_cast<double>(counts[static_cast<std::size_t>(v)]);
    total += count;
    sum += count * v;
    squares += count * v * v;
  }
  const double mean = sum / total;
  Split s;
  s.threshold = otsu_threshold(counts, total, mean);
  double above = 0;
  double above_sum = 0;
  for (int v = s.threshold + 1; v < 256; ++v) {
    above += static_cast<double>(counts[static_cast<std::size_t>(v)]);
    above_sum += static_cast<double>(counts[static_cast<std::size_t>(v)]) * v;
  }
  if (above <= 0 || above >= total) return s;
  const double share = above / total;
  s.contrast = std::abs(above_sum / above - (sum - above_sum) / (total - above));
  const double variance = squares / total - mean * mean;
  if (variance > 0) s.quality = share * (1 - share) * s.contrast * s.contrast / variance;
  return s;
}

// A hand does not reach three corners of the picture: then the wall was mistaken for skin, because
// something else, such as a blue shirt, lies further from both.
bool holds_background(const GreyImage& channel, int threshold) {
  const ImageView view = channel.view();
  const auto set = [&](int x, int y) { return view.at(x, y) > threshold ? 1 : 0; };
  const int right = channel.width_px - 1;
  const int bottom = channel.height_px - 1;
  const int upper = set(0, 0) + set(right, 0);
  const int corners = upper + set(0, bottom) + set(right, bottom);
  return corners >= 3 || (corners == 2 && upper == 2);
}

// Fixed bounds of the thesis, in OpenCV's units: hue 0..180, saturation and value 0..255.
struct HsvBounds {
  double hue_high, saturation_low, saturation_high, value_low;
};

// 5.1.1: 0 <= H <= 50 degrees, 0.25 <= S <= 0.57, V >= 40.
constexpr HsvBounds kNarrowBounds{25, 64, 145, 40};
// 4.6.2: not skin is H > 0.55 or S <= 0.20 or S > 0.95.
constexpr HsvBounds kWideBounds{99, 52, 242, 0};

// nullptr for a method without fixed bounds.
const HsvBounds* bounds_of(SilhouetteMethod method) {
  if (method == SilhouetteMethod::hsv_narrow) return &kNarrowBounds;
  return method == SilhouetteMethod::hsv_wide ? &kWideBounds : nullptr;
}

void split_by_hsv(const detail::ColourImage& bgr, const HsvBounds& bounds, GreyImage* mask) {
  detail::resize(mask, bgr.width_px, bgr.height_px);
  cv::Mat hsv;
  cv::cvtColor(detail::as_mat(bgr.view()), hsv, cv::COLOR_BGR2HSV);
  cv::Mat out(mask->height_px, mask->width_px, CV_8U, mask->pixels.data());
  cv::inRange(hsv, cv::Scalar(0, bounds.saturation_low, bounds.value_low),
              cv::Scalar(bounds.hue_high, bounds.saturation_high, 255), out);
}

// Sets what may be a hand.
Split split(const detail::ColourImage& bgr, SilhouetteMethod method, GreyImage* channel,
            GreyImage* mask) {
  if (const HsvBounds* bounds = bounds_of(method)) {
    split_by_hsv(bgr, *bounds, mask);
    return {0, 255, 1};
  }
  if (method == SilhouetteMethod::grey_otsu) {
    detail::to_grey(bgr, channel);
    const Split found = split_by_otsu(detail::histogram(*channel));
    detail::set_where(*channel, found.threshold, false, mask);
    return found;
  }
  detail::to_redness(bgr, channel);
  const Histogram counts = detail::histogram(*channel);
  Split found = split_by_otsu(counts);
  // Splits again what was segmented as skin, as an image of its own.
  if (holds_background(*channel, found.threshold)) found = split_by_otsu(counts, found.threshold);
  detail::set_where(*channel, found.threshold, true, mask);
  return found;
}

// Splits another picture where one was split.
void split_as(const detail::ColourImage& bgr, SilhouetteMethod method, int threshold,
              GreyImage* channel, GreyImage* mask) {
  if (const HsvBounds* bounds = bounds_of(method)) return split_by_hsv(bgr, *bounds, mask);
  const bool by_grey = method == SilhouetteMethod::grey_otsu;
  by_grey ? detail::to_grey(bgr, channel) : detail::to_redness(bgr, channel);
  detail::set_where(*channel, threshold, !by_grey, mask);
}

// How well a region fills the ellipse that has its moments: 1 for an ellipse, less for a hand with
// fingers.
double ellipticity(const GreyImage& mask, const Region& found) {
  cv::Mat region(found.bottom - found.top, found.right - found.left, CV_8U);
  for (int y = found.top; y < found.bottom; ++y)
    std::copy_n(mask.view().row(y) + found.left, region.cols, region.ptr<uchar>(y - found.top));
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

// Working memory of one thread.
struct SilhouetteWorkspace {
  detail::Shrinker shrinker;
  detail::Smoother smoother;
  detail::ColourImage small, smooth;
  GreyImage channel, raw, cleaned, other, other_channel;
  std::vector<std::uint16_t> counts;
  RegionFinder finder;
  std::vector<Region> candidates;
};

// Fills w.candidates with what may be a hand by its size, the largest first.
void find_candidates(const SilhouetteOptions& options, SilhouetteWorkspace* w) {
  const auto total = static_cast<double>(w->cleaned.pixels.size());
  w->candidates.clear();
  for (const Region& r : w->finder.find(w->cleaned)) {
    const double area = r.area / total;
    if (area >= options.min_area && area <= options.max_area) w->candidates.push_back(r);
  }
  std::sort(w->candidates.begin(), w->candidates.end(), [](const Region& p, const Region& q) {
    return p.area != q.area ? p.area > q.area : p.first_run < q.first_run;
  });
  if (w->candidates.empty()) return;
  // Regions much smaller than the largest are specks, not a second body part.
  constexpr double kComparable = 0.15;
  const double least = kComparable * w->candidates.front().area;
  while (w->candidates.back().area < least) w->candidates.pop_back();
}

// Of more candidates than hands the one most like an ellipse is a face.
void remove_face(SilhouetteWorkspace* w, int max_hands) {
  if (static_cast<int>(w->candidates.size()) <= max_hands) return;
  std::size_t face = 0;
  double best = -1;
  for (std::size_t i = 0; i < w->candidates.size(); ++i) {
    w->other = w->cleaned;
    w->finder.keep(w->candidates[i], &w->other);
    const double likeness = ellipticity(w->other, w->candidates[i]);
    if (likeness > best) {
      best = likeness;
      face = i;
    }
  }
  w->candidates.erase(w->candidates.begin() + static_cast<std::ptrdiff_t>(face));
}

SilhouetteWorkspace& silhouette_workspace() {
  thread_local SilhouetteWorkspace w;
  return w;
}

}  // namespace

// The background at the working size, blurred as pictures are.
struct SilhouetteExtractor::Background {
  int width_px = 0;  // of the picture that was given
  int height_px = 0;
  detail::ColourImage smooth;
};

SilhouetteExtractor::SilhouetteExtractor(const SilhouetteOptions& options, ImageView background)
    : SilhouetteExtractor(options) {
  require(!background.empty() && background.channels == 3,
          "background must have three channels and at least one pixel");
  auto kept = std::make_shared<Background>();
  kept->width_px = background.width_px;
  kept->height_px = background.height_px;
  SilhouetteWorkspace& w = silhouette_workspace();
  w.shrinker.shrink(background, options_.max_side_px, &w.small);
  w.smoother.smooth(w.small, options_.blur_px, &kept->smooth);
  background_ = std::move(kept);
}

SilhouetteExtractor::SilhouetteExtractor(const SilhouetteOptions& options) : options_(options) {
  validate(options);
}

HandObservation SilhouetteExtractor::extract(ImageView bgr) const {
  HandObservation result;
  extract(bgr, &result);
  return result;
}

void SilhouetteExtractor::extract(ImageView bgr, HandObservation* out) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  if (background_ &&
      (bgr.width_px != background_->width_px || bgr.height_px != background_->height_px)) {
    fail(ErrorKind::invalid_argument,
         "picture is " + std::to_string(bgr.width_px) + " x " + std::to_string(bgr.height_px) +
             " pixels, the background " + std::to_string(background_->width_px) + " x " +
             std::to_string(background_->height_px));
  }
  SilhouetteWorkspace& w = silhouette_workspace();
  w.shrinker.shrink(bgr, options_.max_side_px, &w.small);
  detail::to_grey(w.small, &out->grey);
  out->repaired = false;
  w.smoother.smooth(w.small, options_.blur_px, &w.smooth);
  out->quality = 0;
  detail::resize(&out->mask, w.small.width_px, w.small.height_px);
  const Split found = split(w.smooth, options_.method, &w.channel, &w.raw);
  const bool clear =
      found.contrast >= options_.min_contrast &&
      (found.contrast >= options_.sure_contrast || found.quality >= options_.min_quality);
  w.candidates.clear();
  if (clear) {
    if (background_) {
      split_as(background_->smooth, options_.method, found.threshold, &w.other_channel, &w.other);
      for (std::size_t i = 0; i < w.raw.pixels.size(); ++i) w.raw.pixels[i] ^= w.other.pixels[i];
    }
    detail::majority(w.raw, options_.blur_px / 2, &w.counts, &w.cleaned);
    find_candidates(options_, &w);
    if (options_.remove_face) remove_face(&w, options_.max_hands);
  }
  if (w.candidates.empty()) {
    std::fill(out->mask.pixels.begin(), out->mask.pixels.end(), std::uint8_t{0});
    return;
  }
  w.finder.keep(w.candidates.front(), &out->mask);
  if (options_.max_hands > 1 && w.candidates.size() > 1) w.finder.fill(w.candidates[1], &out->mask);
  if (bounds_of(options_.method) != nullptr) detail::to_redness(w.smooth, &w.channel);
  const std::uint8_t* const values = w.channel.pixels.data();
  out->quality =
      detail::mask_quality(out->mask, options_.max_hands, [&](std::size_t i) { return values[i]; });
}

}  // namespace hri
