// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How HandPairTracker divides a region that holds both hands.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/numbers.hpp"
#include "hri/features/hand/hand_pair.hpp"

namespace hri {
namespace {

constexpr double kSteering = 0.2;    // weight of the newest step in a way
constexpr double kHeld = 0.5;        // share of a shape that a region must cover to hold the hand
constexpr double kStiffness = 0.02;  // of the ways of hands that touch, against what they cover
constexpr double kHidden = 1.15;     // a region smaller than so many hands holds a hidden one
// What a shape is worth that covers a pixel: one that nothing else covers, or one that the other
// hand covers too, against one beside the region.
constexpr std::uint8_t kFree = 3;
constexpr std::uint8_t kTaken = 1;
constexpr int kNumRounds = 2;  // of moving one shape, then the other
constexpr int kCoarse_px = 4;
constexpr int kMostUnseen = 2;  // frames after which hands are not thought to touch

using detail::at;

using detail::squared;

struct Spot {
  double x = 0, y = 0;
};

}  // namespace

// Fills sums_: at (x, y), of the pixels of row y left of x.
void HandPairTracker::sum_rows(const GreyImage& image) {
  sums_.resize(at(image.width_px + 1) * at(image.height_px));
  int* out = sums_.data();
  const std::uint8_t* pixel = image.pixels.data();
  for (int y = 0; y < image.height_px; ++y) {
    int sum = 0;
    *out++ = 0;
    for (int x = 0; x < image.width_px; ++x) *out++ = sum += *pixel++;
  }
}

// Sum of the pixels under the hand's shape, moved to (x, y).
int HandPairTracker::covered(const Track& hand, int x, int y) const {
  int sum = 0;
  for (const Run& run : hand.shape) {
    const int row = y + run.dy;
    if (row < 0 || row >= mask_.height_px) continue;
    const int* sums = sums_.data() + at(row) * at(mask_.width_px + 1);
    const int first = std::clamp(x + run.first, 0, mask_.width_px);
    const int end = std::clamp(x + run.end, 0, mask_.width_px);
    sum += sums[end] - sums[first];
  }
  return sum;
}

// Whether a region covers both hands where they were or would be; with a second region beside it,
// only where that one is too small for a hand.
bool HandPairTracker::holds_both(const Region& region) {
  const double smaller = std::min(tracks_[0].area, tracks_[1].area);
  if (regions_.size() == 2 && regions_[1].area > 0.5 * smaller) return false;
  finder_.keep(region, &region_);
  sum_rows(region_);
  return std::all_of(tracks_.begin(), tracks_.end(), [&](const Track& t) {
    if (t.num_unseen > kMostUnseen) return false;
    const auto share = [&](double x, double y) {
      return covered(t, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))) /
             (255 * t.area);
    };
    return std::max(share(t.x, t.y), share(t.x + t.dx, t.y + t.dy)) > kHeld;
  });
}

// Sets rest_ to what the region's pixels are worth beside a hand.
void HandPairTracker::weigh_beside(const Track& hand) {
  std::transform(region_.pixels.begin(), region_.pixels.end(), rest_.pixels.begin(),
                 [](std::uint8_t v) { return v != 0 ? kFree : std::uint8_t{0}; });
  const auto x0 = static_cast<int>(std::lround(hand.x));
  const auto y0 = static_cast<int>(std::lround(hand.y));
  for (const Run& run : hand.shape) {
    const int row = y0 + run.dy;
    if (row < 0 || row >= mask_.height_px) continue;
    std::uint8_t* pixels = rest_.pixels.data() + at(row) * at(mask_.width_px);
    const int first = std::clamp(x0 + run.first, 0, mask_.width_px);
    const int end = std::clamp(x0 + run.end, 0, mask_.width_px);
    for (int x = first; x < end; ++x) pixels[x] = std::min(pixels[x], kTaken);
  }
}

// Moves a hand to where its shape is worth most, near (x, y), by the sums of rest_.
void HandPairTracker::settle(Track* hand, double x, double y) {
  const double stiffness = kStiffness * std::sqrt(hand->area);
  const auto worth = [&](int px, int py) {
    return 0.5 * covered(*hand, px, py) - stiffness * (squared(px - x) + squared(py - y));
  };
  int best_x = static_cast<int>(std::lround(hand->x));
  int best_y = static_cast<int>(std::lround(hand->y));
  double best = worth(best_x, best_y);
  for (int step = kCoarse_px; step >= 1; step /= 2) {
    for (bool moved = true; moved;) {
      moved = false;
      const int from_x = best_x;
      const int from_y = best_y;
      for (int i = 0; i < 9; ++i) {
        const int px = from_x + step * (i % 3 - 1);
        const int py = from_y + step * (i / 3 - 1);
        const double value = worth(px, py);
        if (value <= best) continue;
        best = value;
        best_x = px;
        best_y = py;
        moved = true;
      }
    }
  }
  hand->x = best_x;
  hand->y = best_y;
}

void HandPairTracker::split_region() {
  finder_.keep(regions_[0], &region_);
  std::array<Spot, 2> before;
  std::array<Spot, 2> expected;
  for (int side = 0; side < 2; ++side) {
    Track& t = tracks_[at(side)];
    before[at(side)] = {t.x, t.y};
    expected[at(side)] = {t.x + t.dx, t.y + t.dy};
    t.x += t.dx;
    t.y += t.dy;
  }
  for (int round = 0; round < kNumRounds; ++round) {
    for (int side = 0; side < 2; ++side) {
      weigh_beside(tracks_[at(1 - side)]);
      sum_rows(rest_);
      settle(&tracks_[at(side)], expected[at(side)].x, expected[at(side)].y);
    }
  }
  for (int side = 0; side < 2; ++side) {
    Track& t = tracks_[at(side)];
    t.dx += kSteering * (t.x - before[at(side)].x - t.dx);
    t.dy += kSteering * (t.y - before[at(side)].y - t.dy);
    t.num_unseen = 0;
  }
  share_out();
}

// A hand that was hidden for as long as places are kept has left.
void HandPairTracker::forget_hidden() {
  const bool hidden = regions_[0].area < kHidden * std::max(tracks_[0].area, tracks_[1].area);
  num_hidden_ = hidden ? num_hidden_ + 1 : 0;
  if (num_hidden_ <= options_.num_kept_frames) return;
  num_hidden_ = 0;
  const auto area = [&](int side) {
    const std::vector<std::uint8_t>& pixels = hands_[at(side)].mask.pixels;
    return std::count(pixels.begin(), pixels.end(), std::uint8_t{255});
  };
  tracks_[area(0) < area(1) ? 0 : 1].known = false;
}

// Every pixel of the region to the hand that covers it, or whose middle is nearer.
void HandPairTracker::share_out() {
  for (int side = 0; side < 2; ++side) {
    weigh_beside(tracks_[at(side)]);
    std::transform(
        rest_.pixels.begin(), rest_.pixels.end(), hands_[at(side)].mask.pixels.begin(),
        [](std::uint8_t v) { return v == kTaken ? std::uint8_t{255} : std::uint8_t{0}; });
  }
  std::uint8_t* left = hands_[0].mask.pixels.data();
  std::uint8_t* right = hands_[1].mask.pixels.data();
  const std::uint8_t* pixel = region_.pixels.data();
  for (int y = 0; y < mask_.height_px; ++y) {
    for (int x = 0; x < mask_.width_px; ++x, ++left, ++right, ++pixel) {
      if (*pixel == 0 || *left != *right) continue;
      const auto far = [&](const Track& t) { return squared(t.x - x) + squared(t.y - y); };
      const bool is_left = far(tracks_[0]) <= far(tracks_[1]);
      *left = is_left ? 255 : 0;
      *right = is_left ? 0 : 255;
    }
  }
  for (PairedHand& hand : hands_) {
    hand.touching = true;
    hand.seen = std::any_of(hand.mask.pixels.begin(), hand.mask.pixels.end(),
                            [](std::uint8_t v) { return v != 0; });
  }
}

}  // namespace hri
