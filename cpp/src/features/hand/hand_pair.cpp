// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kSlowing = 0.7;  // of the way of a hand that is not seen, each frame

using detail::at;

using detail::squared;

}  // namespace

HandPairTracker::HandPairTracker(const HandPairOptions& options) : options_(validated(options)) {}

void HandPairTracker::reset() {
  for (Track& t : tracks_) t.known = false;
  paired_ = false;
  num_hidden_ = 0;
}

const std::array<PairedHand, 2>& HandPairTracker::push(ImageView mask) {
  require(!mask.empty() && mask.channels == 1, "mask must have one channel and at least one pixel");
  if (mask.width_px != mask_.width_px || mask.height_px != mask_.height_px) {
    reset();
    for (GreyImage* image : {&mask_, &region_, &rest_, &hands_[0].mask, &hands_[1].mask})
      *image = GreyImage(mask.width_px, mask.height_px);
  }
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* row = mask.row(y);
    std::transform(row, row + mask.width_px, mask_.pixels.data() + at(y) * at(mask.width_px),
                   [](std::uint8_t v) { return v != 0 ? std::uint8_t{255} : std::uint8_t{0}; });
  }
  for (PairedHand& hand : hands_) {
    hand.seen = hand.touching = false;
    std::fill(hand.mask.pixels.begin(), hand.mask.pixels.end(), std::uint8_t{0});
  }
  find_hands();
  const bool both_known = tracks_[0].known && tracks_[1].known;
  if (!regions_.empty() && both_known && holds_both(regions_[0])) {
    split_region();
    forget_hidden();
  } else if (regions_.size() == 2) {
    assign_two();
  } else if (regions_.size() == 1) {
    assign_one();
  } else {
    miss(0);
    miss(1);
  }
  if (!tracks_[0].known && !tracks_[1].known) paired_ = false;
  for (int side = 0; side < 2; ++side) {
    hands_[at(side)].x_px = tracks_[at(side)].x;
    hands_[at(side)].y_px = tracks_[at(side)].y;
  }
  return hands_;
}

// The two largest regions that may be hands.
void HandPairTracker::find_hands() {
  regions_ = finder_.find_largest(mask_, options_.min_area, 2);
  if (regions_.size() == 2 && regions_[1].area < options_.min_share * regions_[0].area)
    regions_.pop_back();
}

namespace {

struct Middle {
  double x = 0, y = 0;
};

Middle middle(const GreyImage& mask) {
  double count = 0;
  Middle sum;
  const std::uint8_t* pixel = mask.pixels.data();
  for (int y = 0; y < mask.height_px; ++y) {
    double in_row = 0;
    double columns = 0;
    for (int x = 0; x < mask.width_px; ++x, ++pixel) {
      const int set = *pixel != 0 ? 1 : 0;
      in_row += set;
      columns += set * x;
    }
    count += in_row;
    sum.x += columns;
    sum.y += in_row * y;
  }
  return count > 0 ? Middle{sum.x / count, sum.y / count} : sum;
}

}  // namespace

void HandPairTracker::assign_two() {
  std::array<Middle, 2> places;
  for (int i = 0; i < 2; ++i) {
    finder_.keep(regions_[at(i)], &region_);
    places[at(i)] = middle(region_);
  }
  // How much better the first region is the left hand's than the right one's.
  double straight = 0;
  double crossed = 0;
  for (int side = 0; side < 2; ++side) {
    const Track& t = tracks_[at(side)];
    if (!t.known) continue;
    const auto cost = [&](const Middle& m) {
      return squared(t.x + t.dx - m.x) + squared(t.y + t.dy - m.y);
    };
    straight += cost(places[at(side)]);
    crossed += cost(places[at(1 - side)]);
  }
  if (!paired_) {
    straight = places[0].x;
    crossed = places[1].x;
  }
  const int first = straight <= crossed ? 0 : 1;
  see(first, regions_[0]);
  see(1 - first, regions_[1]);
  paired_ = true;
}

void HandPairTracker::assign_one() {
  finder_.keep(regions_[0], &region_);
  const Middle place = middle(region_);
  const auto far = [&](const Track& t) {
    return squared(t.x + t.dx - place.x) + squared(t.y + t.dy - place.y);
  };
  int side = place.x + 0.5 < 0.5 * mask_.width_px ? 0 : 1;
  if (tracks_[0].known && tracks_[1].known) {
    side = far(tracks_[0]) <= far(tracks_[1]) ? 0 : 1;
  } else if (tracks_[0].known || tracks_[1].known) {
    side = tracks_[0].known ? 0 : 1;
  }
  see(side, regions_[0]);
  miss(1 - side);
}

void HandPairTracker::see(int side, const Region& region) {
  Track& t = tracks_[at(side)];
  PairedHand& hand = hands_[at(side)];
  finder_.keep(region, &hand.mask);
  hand.seen = true;
  const Middle m = middle(hand.mask);
  if (t.known && t.num_unseen == 0) {
    t.dx += 0.5 * (m.x - t.x - t.dx);
    t.dy += 0.5 * (m.y - t.y - t.dy);
  } else {
    t.dx = t.dy = 0;
  }
  t.x = m.x;
  t.y = m.y;
  t.area = region.area;
  t.known = true;
  t.num_unseen = 0;
  remember_shape(&t, hand.mask);
}

void HandPairTracker::miss(int side) {
  Track& t = tracks_[at(side)];
  if (!t.known) return;
  if (++t.num_unseen > options_.num_kept_frames) {
    t.known = false;
    return;
  }
  t.x = std::clamp(t.x + t.dx, 0.0, mask_.width_px - 1.0);
  t.y = std::clamp(t.y + t.dy, 0.0, mask_.height_px - 1.0);
  t.dx *= kSlowing;
  t.dy *= kSlowing;
}

void HandPairTracker::remember_shape(Track* hand, const GreyImage& mask) {
  hand->shape.clear();
  const auto x0 = static_cast<int>(std::lround(hand->x));
  const auto y0 = static_cast<int>(std::lround(hand->y));
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* const row = mask.view().row(y);
    const std::uint8_t* const end = row + mask.width_px;
    const std::uint8_t* first = std::find(row, end, std::uint8_t{255});
    while (first != end) {
      const std::uint8_t* after = std::find(first, end, std::uint8_t{0});
      hand->shape.push_back(
          {y - y0, static_cast<int>(first - row) - x0, static_cast<int>(after - row) - x0});
      first = std::find(after, end, std::uint8_t{255});
    }
  }
}

}  // namespace hri
