// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_spotter.hpp"

#include <utility>

#include "hri/core/error.hpp"

namespace hri {

GestureSpotter::GestureSpotter(std::unique_ptr<HandStream> hands,
                               const GestureSegmenterOptions& options)
    : hands_(std::move(hands)), segmenter_(options) {
  require(hands_ != nullptr, "hands must be a stream");
}

GestureSegment GestureSpotter::push(ImageView bgr, double time_s) {
  segmenter_.check_time(time_s);
  const HandObservation& hand = hands_->push(bgr, time_s, segmenter_.in_gesture());
  if (hands_->renewed()) segmenter_.replace_outlines(hand.mask.view());
  const GestureSegment segment = segmenter_.push(hand.mask.view(), time_s);
  hand_ = &hand;
  place_ = hand_place(hand.mask.view());
  time_s_ = time_s;
  return segment;
}

GestureSegment GestureSpotter::finish() { return segmenter_.finish(); }

GestureSegment GestureSpotter::interrupt() { return segmenter_.interrupt(); }

const HandObservation& GestureSpotter::hand() const { return hand_ != nullptr ? *hand_ : none_; }

double GestureSpotter::kept_since_s() const {
  return segmenter_.may_have_begun_s().value_or(time_s_) - segmenter_.options().context_s;
}

}  // namespace hri
