// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr std::size_t kMostOutlines = 1024;  // for streams whose time hardly goes on
constexpr double kNever = -std::numeric_limits<double>::infinity();

struct Counts {
  int differ = 0;
  int either = 0;
};

HRI_SIMD_CLONES bool any_set(const std::uint8_t* row, int count) {
  std::uint8_t all = 0;
  for (int x = 0; x < count; ++x) all = static_cast<std::uint8_t>(all | row[x]);
  return all != 0;
}

HRI_SIMD_CLONES void count_differing(const std::uint8_t* a, const std::uint8_t* b, int count,
                                     Counts* out) {
  int differ = 0;
  int either = 0;
  for (int i = 0; i < count; ++i) {
    differ += (a[i] != 0) != (b[i] != 0) ? 1 : 0;
    either += (a[i] | b[i]) != 0 ? 1 : 0;
  }
  out->differ += differ;
  out->either += either;
}

bool any_set(ImageView mask) {
  for (int y = 0; y < mask.height_px; ++y) {
    if (any_set(mask.row(y), mask.width_px)) return true;
  }
  return false;
}

void copy(ImageView from, GreyImage* to) {
  to->width_px = from.width_px;
  to->height_px = from.height_px;
  const auto width = static_cast<std::size_t>(from.width_px);
  to->pixels.resize(width * static_cast<std::size_t>(from.height_px));
  for (int y = 0; y < from.height_px; ++y)
    std::copy_n(from.row(y), width, to->pixels.data() + static_cast<std::size_t>(y) * width);
}

void require_mask(ImageView mask) {
  require(!mask.empty() && mask.channels == 1, "mask must have one channel and at least one pixel");
}

}  // namespace

const char* GestureSegmenterOptions::conflict() const {
  return max_gesture_s > min_gesture_s ? nullptr : "max_gesture_s must be above min_gesture_s";
}

GestureSegmenter::GestureSegmenter(const GestureSegmenterOptions& options)
    : options_(validated(options)) {}

std::optional<double> GestureSegmenter::may_have_begun_s() const {
  if (phase_ == Phase::away) return seen_since_s_;
  return phase_ == Phase::moving ? std::optional<double>(first_s_) : moving_since_s_;
}

void GestureSegmenter::check_time(double time_s) const {
  require(std::isfinite(time_s), "time_s must be finite");
  if (time_s < time_s_) {
    fail(ErrorKind::invalid_argument, "time runs backwards: a picture at " +
                                          std::to_string(time_s) + " s after one at " +
                                          std::to_string(time_s_) + " s");
  }
}

GestureSegment GestureSegmenter::push(ImageView mask, double time_s) {
  require_mask(mask);
  check_time(time_s);
  time_s_ = time_s;
  const bool hand = any_set(mask);
  const bool still = hand && change(mask, time_s) < options_.still_change;
  if (hand) last_hand_s_ = time_s;
  const bool gone = time_s - last_hand_s_ >= options_.leave_s;
  if (phase_ == Phase::away) return appear(hand, time_s);
  return phase_ == Phase::resting ? rest(hand, still, gone, time_s) : move(still, gone, time_s);
}

GestureSegment GestureSegmenter::finish() {
  const GestureSegment last =
      in_gesture() ? end(GestureSegmentReason::ended, last_hand_s_) : GestureSegment{};
  reset();
  return last;
}

GestureSegment GestureSegmenter::interrupt() {
  GestureSegment dropped;
  if (in_gesture()) {
    dropped = {GestureSegmentKind::dropped, GestureSegmentReason::stalled, first_s_, time_s_,
               from_rest_};
  }
  reset();
  return dropped;
}

void GestureSegmenter::reset() {
  leave();
  still_since_s_.reset();
  moving_since_s_.reset();
  time_s_ = last_hand_s_ = kNever;
}

void GestureSegmenter::replace_outlines(ImageView mask) {
  require_mask(mask);
  for (std::size_t i = 0; i < count_; ++i) copy(mask, &outline(i).mask);
}

GestureSegment GestureSegmenter::appear(bool hand, double time_s) {
  if (!hand) {
    seen_since_s_.reset();
    return {};
  }
  if (!seen_since_s_) seen_since_s_ = time_s;
  if (time_s - *seen_since_s_ < options_.appear_s) return {};
  return begin(*seen_since_s_, false);
}

GestureSegment GestureSegmenter::rest(bool hand, bool still, bool gone, double time_s) {
  if (gone) leave();
  if (!hand) return {};
  if (still) {
    moving_since_s_.reset();
    if (!still_since_s_) still_since_s_ = time_s;
    spent_ = spent_ && time_s - *still_since_s_ < options_.rest_s;
    return {};
  }
  still_since_s_.reset();
  if (spent_) return {};  // no gesture has begun, however long it goes on
  if (!moving_since_s_) moving_since_s_ = time_s;
  if (time_s - *moving_since_s_ < options_.appear_s) return {};
  return begin(*moving_since_s_, true);
}

GestureSegment GestureSegmenter::move(bool still, bool gone, double time_s) {
  if (gone) return end(GestureSegmentReason::left, last_hand_s_);
  if (!still) {
    still_since_s_.reset();
  } else if (!still_since_s_) {
    still_since_s_ = time_s;
  }
  if (still_since_s_ && time_s - *still_since_s_ >= options_.rest_s)
    return end(GestureSegmentReason::rested, time_s);
  if (time_s - first_s_ >= options_.max_gesture_s) return end(GestureSegmentReason::cut, time_s);
  return {};
}

GestureSegment GestureSegmenter::begin(double first_s, bool from_rest) {
  phase_ = Phase::moving;
  first_s_ = first_s;
  from_rest_ = from_rest;
  still_since_s_.reset();
  return {GestureSegmentKind::start, GestureSegmentReason::none, first_s, first_s, from_rest};
}

GestureSegment GestureSegmenter::end(GestureSegmentReason reason, double last_s) {
  const bool left = reason == GestureSegmentReason::left;
  const bool over = left || reason == GestureSegmentReason::ended;
  const double least_s = from_rest_ && left ? options_.take_away_s : options_.min_gesture_s;
  const bool too_short = over && last_s - first_s_ < least_s;
  if (over) {
    leave();
  } else {
    phase_ = Phase::resting;
    moving_since_s_.reset();
    still_since_s_.reset();
    spent_ = reason == GestureSegmentReason::cut;
  }
  if (reason == GestureSegmentReason::rested && !from_rest_ && !options_.arrivals) {
    return {GestureSegmentKind::dropped, GestureSegmentReason::arrived, first_s_, last_s, false};
  }
  return {too_short ? GestureSegmentKind::dropped : GestureSegmentKind::end, reason, first_s_,
          last_s, from_rest_};
}

void GestureSegmenter::leave() {
  phase_ = Phase::away;
  seen_since_s_.reset();
  spent_ = false;
  count_ = 0;
}

// How much the outline differs from that of compare_s ago, 0..1.
double GestureSegmenter::change(ImageView mask, double time_s) {
  if (count_ > 0) {
    const GreyImage& oldest = outline(0).mask;
    if (oldest.width_px != mask.width_px || oldest.height_px != mask.height_px) count_ = 0;
  }
  Outline& now = append();
  now.time_s = time_s;
  copy(mask, &now.mask);
  while (count_ > 1 && time_s - outline(1).time_s >= options_.compare_s) {
    first_ = (first_ + 1) % outlines_.size();
    --count_;
  }
  const Outline& before = outline(0);
  if (time_s - before.time_s < options_.compare_s) return 1;
  Counts counts;
  for (int y = 0; y < mask.height_px; ++y)
    count_differing(mask.row(y), before.mask.view().row(y), mask.width_px, &counts);
  return static_cast<double>(counts.differ) / std::max(1, counts.either);
}

GestureSegmenter::Outline& GestureSegmenter::append() {
  if (count_ == kMostOutlines) {
    first_ = (first_ + 1) % outlines_.size();
    --count_;
  }
  if (count_ == outlines_.size()) {
    std::rotate(outlines_.begin(), outlines_.begin() + static_cast<std::ptrdiff_t>(first_),
                outlines_.end());
    first_ = 0;
    outlines_.emplace_back();
  }
  return outline(count_++);
}

}  // namespace hri
