// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/person_hands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>

#include "hri/core/error.hpp"
#include "hri/features/hand/regions.hpp"
#include "vision/hand_streams.hpp"
#include "vision/mask_quality.hpp"
#include "vision/pictures.hpp"
#include "vision/pixels.hpp"
#include "vision/skin_model.hpp"

namespace hri {
namespace {

// Frames from which on a face is searched for as in a stream.
constexpr std::size_t kStills = 8;

// Lengths are in sides of the face, from its centre.
constexpr double kMargin = 0.4;      // of the room that is looked at, around what hands reach
constexpr double kSurePixels = 0.8;  // share of the face's pixels that are skin, not eyes or hair
constexpr double kDarkest = 0.3, kBrightest = 2.2;   // skin, against the face's median
constexpr float kLimit = 4, kNoSkin = -3;            // of logarithms of ratios
constexpr double kHandArea = 0.6, kLargeHand = 1.0;  // in areas of the face
constexpr double kFall = 0.6;  // power by which larger regions are less likely
constexpr int kCentreBins = 256;

struct Place {
  double u, v;
};

// In units of its half axes. Most places are far outside: these need no root.
bool in_ellipse(double a, double b) {
  return std::abs(a) < 1 && std::abs(b) < 1 && std::hypot(a, b) < 1;
}

// The middle of the face, most of it skin.
bool in_middle(Place p) { return in_ellipse(p.u / 0.33, (p.v - 0.05) / 0.42); }

// Head and neck: what is no hand.
bool in_head(Place p) {
  const bool face = in_ellipse(p.u / 0.52, (p.v - 0.02) / 0.64);
  const bool neck = std::abs(p.u) < 0.25 && p.v > 0 && p.v < 0.75;
  const bool hair = std::abs(p.u) < 0.52 && p.v > -0.8 && p.v < -0.2;
  return face || neck || hair;
}

// Whose colours are not the room's.
bool beside_head(Place p) { return p.v > -0.8 && p.v < 0.95; }
bool near_head(Place p) { return std::abs(p.u) < 0.6 && beside_head(p); }

// A part of the scaled picture around the face.
struct Surroundings {
  cv::Rect box;
  double centre_x = 0, centre_y = 0, side = 0;  // of the face, in pixels of the part

  [[nodiscard]] Place place(int x, int y) const {
    return {(x - centre_x) / side, (y - centre_y) / side};
  }
};

int median(const std::array<int, kCentreBins>& counts) {
  int total = 0;
  for (const int count : counts) total += count;
  int below = 0;
  for (int value = 0; value < kCentreBins; ++value) {
    below += counts[static_cast<std::size_t>(value)];
    if (2 * below >= total) return value;
  }
  return 0;
}

// Working memory of one thread.
struct PersonWorkspace {
  cv::Mat smooth, ycrcb, scores;
  std::vector<const std::uint8_t*> face;  // pixels of its middle
  GreyImage raw, cleaned, best, one;
  std::vector<std::uint16_t> counts;
  RegionFinder finder;
  detail::ChromaHistogram skin, room, hand;
};

PersonWorkspace& person_workspace() {
  thread_local PersonWorkspace w;
  return w;
}

// Fills the histograms of skin and room; gives the median of the face's brightness.
int learn(const Surroundings& around, PersonWorkspace* w) {
  w->skin.clear();
  w->room.clear();
  w->face.clear();
  std::array<std::array<int, kCentreBins>, 3> values{};
  for (int y = 0; y < w->ycrcb.rows; ++y) {
    const auto* pixel = w->ycrcb.ptr<std::uint8_t>(y);
    if (!beside_head(around.place(0, y))) {  // most rows: all of them is room
      for (int x = 0; x < w->ycrcb.cols; ++x, pixel += 3) w->room.add(pixel);
      continue;
    }
    for (int x = 0; x < w->ycrcb.cols; ++x, pixel += 3) {
      const Place p = around.place(x, y);
      if (in_middle(p)) {
        w->face.push_back(pixel);
        for (std::size_t c = 0; c < 3; ++c) ++values[c][pixel[c]];
      } else if (!near_head(p)) {
        w->room.add(pixel);
      }
    }
  }
  if (w->face.empty()) return 0;
  const int cr = median(values[1]);
  const int cb = median(values[2]);
  const auto apart = [&](const std::uint8_t* p) {
    return std::abs(p[1] - cr) + std::abs(p[2] - cb);
  };
  const auto last = static_cast<std::ptrdiff_t>(kSurePixels * static_cast<double>(w->face.size()));
  std::nth_element(w->face.begin(), w->face.begin() + last, w->face.end(),
                   [&](const std::uint8_t* p, const std::uint8_t* q) {
                     return apart(p) != apart(q) ? apart(p) < apart(q) : p < q;
                   });
  std::array<int, kCentreBins> brightness{};
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    const std::uint8_t* const pixel = w->face[static_cast<std::size_t>(i)];
    w->skin.add(pixel);
    ++brightness[pixel[0]];
  }
  return median(brightness);
}

// Fills the scores of all pixels, and `raw` with what may be a hand.
void score(const Surroundings& around, int brightness, double min_log_ratio, PersonWorkspace* w) {
  const cv::Mat ratios = detail::log_ratios(w->skin, w->room);
  w->scores.create(w->ycrcb.size(), CV_32F);
  for (int y = 0; y < w->ycrcb.rows; ++y) {
    const auto* pixel = w->ycrcb.ptr<std::uint8_t>(y);
    auto* const scores = w->scores.ptr<float>(y);
    for (int x = 0; x < w->ycrcb.cols; ++x, pixel += 3) {
      const bool lit = pixel[0] > kDarkest * brightness && pixel[0] < kBrightest * brightness;
      scores[x] = lit ? ratios.at<float>(pixel[1] / 2, pixel[2] / 2) : kNoSkin;
    }
  }
  cv::GaussianBlur(w->scores, w->scores, cv::Size(3, 3), 0);
  detail::resize(&w->raw, w->scores.cols, w->scores.rows);
  std::uint8_t* raw = w->raw.pixels.data();
  for (int y = 0; y < w->scores.rows; ++y) {
    auto* const scores = w->scores.ptr<float>(y);
    for (int x = 0; x < w->scores.cols; ++x) {
      scores[x] = std::clamp(scores[x], -kLimit, kLimit);
      *raw++ = scores[x] > min_log_ratio && !in_head(around.place(x, y)) ? 255 : 0;
    }
  }
}

struct Candidate {
  Region region;
  double score = 0;  // how likely it is a hand: by its colours, and its size in areas of the face
  double distance = 0;  // from the face
};

Candidate rate(const Region& region, const Surroundings& around, PersonWorkspace* w) {
  std::fill(w->one.pixels.begin(), w->one.pixels.end(), std::uint8_t{0});
  w->finder.fill(region, &w->one);
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int y = region.top; y < region.bottom; ++y) {
    const std::uint8_t* const row = w->one.view().row(y);
    for (int x = region.left; x < region.right; ++x) {
      if (row[x] == 0) continue;
      sum += static_cast<double>(w->scores.at<float>(y, x));
      sum_x += x;
      sum_y += y;
    }
  }
  const double mean_x = (sum_x / region.area - around.centre_x) / around.side;
  const double mean_y = (sum_y / region.area - around.centre_y) / around.side;
  const double area = region.area / (around.side * around.side);
  const double size = std::min(area, kHandArea) * std::min(1.0, std::pow(kLargeHand / area, kFall));
  return {region, sum / region.area * size, std::hypot(mean_x, mean_y)};
}

// Leaves the most likely regions in `best`, and gives them, the most likely first.
std::vector<Region> choose(const PersonOptions& options, const Surroundings& around,
                           PersonWorkspace* w) {
  detail::majority(w->raw, 1, &w->counts, &w->cleaned);
  detail::resize(&w->one, w->cleaned.width_px, w->cleaned.height_px);
  const double face_area = around.side * around.side;
  std::vector<Candidate> candidates;
  for (const Region& region : w->finder.find(w->cleaned)) {
    if (region.area < options.min_area * face_area || region.area > options.max_area * face_area)
      continue;
    const Candidate rated = rate(region, around, w);
    if (rated.score > 0 && rated.distance <= options.reach) candidates.push_back(rated);
  }
  const auto hangs = [&](const Candidate& c) {
    return options.max_hands == 1 && c.distance > options.signing_reach;
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& p, const Candidate& q) {
                     return hangs(p) != hangs(q) ? hangs(q) : p.score > q.score;
                   });
  if (candidates.size() > static_cast<std::size_t>(options.max_hands))
    candidates.resize(static_cast<std::size_t>(options.max_hands));
  w->best = GreyImage(w->cleaned.width_px, w->cleaned.height_px);
  std::vector<Region> hands;
  for (const Candidate& candidate : candidates) {
    w->finder.fill(candidate.region, &w->best);
    hands.push_back(candidate.region);
  }
  return hands;
}

// Adds the colours of the hands to those of the face.
void learn_hands(PersonWorkspace* w) {
  w->hand.clear();
  const std::uint8_t* set = w->best.pixels.data();
  for (int y = 0; y < w->ycrcb.rows; ++y) {
    const auto* pixel = w->ycrcb.ptr<std::uint8_t>(y);
    for (int x = 0; x < w->ycrcb.cols; ++x, pixel += 3)
      if (*set++ != 0) w->hand.add(pixel);
  }
  w->skin.blend(w->hand);
}

// Of the mask in the rectangle of a region, grown by half its sides.
double quality(const Region& region, const PersonWorkspace& w) {
  const int across = (region.right - region.left + 1) / 2;
  const int down = (region.bottom - region.top + 1) / 2;
  const int left = std::max(0, region.left - across);
  const int top = std::max(0, region.top - down);
  GreyImage part(std::min(w.best.width_px, region.right + across) - left,
                 std::min(w.best.height_px, region.bottom + down) - top);
  for (int y = 0; y < part.height_px; ++y) {
    std::copy_n(w.best.view().row(top + y) + left, part.width_px,
                part.pixels.data() + static_cast<std::ptrdiff_t>(y) * part.width_px);
  }
  return detail::mask_quality(part, 1, [&](std::size_t i) {
    const int at = static_cast<int>(i);
    return static_cast<double>(
        w.scores.at<float>(top + at / part.width_px, left + at % part.width_px));
  });
}

double median_side(const std::vector<std::optional<Face>>& faces) {
  std::vector<double> sides;
  for (const auto& face : faces) {
    if (face) sides.push_back(face->side_px);
  }
  const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
  std::nth_element(sides.begin(), middle, sides.end());
  return *middle;
}

void require_face(ImageView bgr, const Face& face) {
  const double half = face.side_px / 2;
  const double x = face.left_px + half;
  const double y = face.top_px + half;
  require(face.side_px >= 1 && std::isfinite(face.side_px),
          "side_px of the face must be at least 1");
  require(x >= 0 && y >= 0 && x < bgr.width_px && y < bgr.height_px,
          "the centre of the face must lie in the picture");
}

}  // namespace

const char* PersonOptions::conflict() const {
  return min_area <= max_area ? nullptr : "min_area must not exceed max_area";
}

PersonHands::PersonHands(const PersonOptions& options) : options_(validated(options)) {}

HandObservation PersonHands::extract(ImageView bgr, const Face& face) const {
  HandObservation result;
  extract(bgr, face, &result);
  return result;
}

void PersonHands::extract(ImageView bgr, const Face& face, HandObservation* out) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  require_face(bgr, face);
  const double wanted = std::min(1.0, options_.face_side_px / face.side_px);
  const int side = std::max(bgr.width_px, bgr.height_px);
  const cv::Mat small =
      detail::scaled_down(detail::as_mat(bgr), std::max(1, cvRound(wanted * side)));
  const double scale = small.cols / static_cast<double>(bgr.width_px);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  detail::resize(&out->grey, small.cols, small.rows);
  grey.copyTo(cv::Mat(small.rows, small.cols, CV_8U, out->grey.pixels.data()));
  detail::resize(&out->mask, small.cols, small.rows);
  std::fill(out->mask.pixels.begin(), out->mask.pixels.end(), std::uint8_t{0});
  out->quality = 0;
  out->repaired = false;
  out->touching = false;

  Surroundings around;
  around.side = face.side_px * scale;
  const double x = face.left_px * scale + around.side / 2;
  const double y = face.top_px * scale + around.side / 2;
  const int reach = static_cast<int>(
      std::min<double>((options_.reach + kMargin) * around.side, small.cols + small.rows));
  around.box = cv::Rect(static_cast<int>(x) - reach, static_cast<int>(y) - reach, 2 * reach + 1,
                        2 * reach + 1) &
               cv::Rect(0, 0, small.cols, small.rows);
  around.centre_x = x - around.box.x;
  around.centre_y = y - around.box.y;

  PersonWorkspace& w = person_workspace();
  cv::GaussianBlur(small(around.box), w.smooth, cv::Size(3, 3), 0);
  cv::cvtColor(w.smooth, w.ycrcb, cv::COLOR_BGR2YCrCb);
  const int brightness = learn(around, &w);
  if (w.face.empty() || w.room.empty()) return;
  std::vector<Region> hands;
  for (int round = 0; round <= options_.num_rounds; ++round) {
    if (round > 0) learn_hands(&w);
    score(around, brightness, options_.min_log_ratio, &w);
    hands = choose(options_, around, &w);
    if (hands.empty()) return;
  }
  out->quality = 1;
  for (const Region& hand : hands) out->quality = std::min(out->quality, quality(hand, w));
  const cv::Mat best(w.best.height_px, w.best.width_px, CV_8U, w.best.pixels.data());
  best.copyTo(cv::Mat(small.rows, small.cols, CV_8U, out->mask.pixels.data())(around.box));
}

std::optional<std::vector<HandObservation>> PersonHands::find(Span<const ImageView> clip,
                                                              const FaceFinder& faces,
                                                              const FrameProgress& progress) const {
  for (std::size_t i = 0; i < clip.size(); ++i) {
    if (clip[i].empty() || clip[i].channels != 3) {
      fail(ErrorKind::invalid_argument,
           "frame " + std::to_string(i) + " must have three channels and at least one pixel");
    }
  }
  const bool alike = std::all_of(clip.begin(), clip.end(), [&](const ImageView& frame) {
    return frame.width_px == clip[0].width_px && frame.height_px == clip[0].height_px;
  });
  if (!alike) return std::nullopt;
  const auto interval = static_cast<std::size_t>(options_.face_interval);
  std::vector<std::optional<Face>> seen;
  for (std::size_t i = 0; i < clip.size(); i += interval)
    seen.push_back(clip.size() < kStills ? faces.find_in_still(clip[i]) : faces.find(clip[i]));
  const auto count = static_cast<std::size_t>(std::count_if(
      seen.begin(), seen.end(), [](const std::optional<Face>& face) { return face.has_value(); }));
  if (count == 0 || 2 * count < seen.size()) return std::nullopt;
  const auto first = std::find_if(seen.begin(), seen.end(),
                                  [](const std::optional<Face>& face) { return face.has_value(); });
  const double side_px = median_side(seen);
  Face face = **first;
  std::vector<HandObservation> found(clip.size());
  for (std::size_t i = 0; i < clip.size(); ++i) {
    if (i % interval == 0 && seen[i / interval]) face = *seen[i / interval];
    extract(clip[i], detail::resized(face, side_px), &found[i]);
    if (progress) progress(static_cast<int>(i) + 1, static_cast<int>(clip.size()));
  }
  return found;
}

}  // namespace hri
