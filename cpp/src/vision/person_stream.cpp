// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "vision/hand_streams.hpp"

namespace hri::detail {
namespace {

constexpr double kResized = 0.25;  // a face whose side changes by less is as large as before

}  // namespace

Face resized(const Face& face, double side_px) {
  const double grown = (side_px - face.side_px) / 2;
  return {face.left_px - grown, face.top_px - grown, side_px};
}

const HandObservation& PersonHandStream::push(ImageView bgr, double time_s, bool in_gesture) {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  const bool same_size = bgr.width_px == width_px_ && bgr.height_px == height_px_;
  const bool was_by_person = by_person_;
  const double side_before_px = face_.side_px;
  if (!same_size) {
    width_px_ = bgr.width_px;
    height_px_ = bgr.height_px;
    num_looks_ = 0;
    by_person_ = false;
  }
  if (num_looks_ == 0 || ++num_pictures_ >= options_.face_interval) look(bgr, in_gesture);
  const std::size_t looks = std::min(num_looks_, kNumLooks);
  const auto seen = static_cast<std::size_t>(
      std::count(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(looks), true));
  if (!in_gesture || !same_size) by_person_ = seen > 0 && 2 * seen >= looks;
  const bool resized = by_person_ && face_.side_px != side_before_px;
  renewed_ = by_person_ != was_by_person || resized;
  if (by_person_) {
    hands_.extract(bgr, face_, &found_);
    return found_;
  }
  const HandObservation& found = others_->push(bgr, time_s, in_gesture);
  renewed_ |= others_->renewed();
  return found;
}

void PersonHandStream::look(ImageView bgr, bool in_gesture) {
  num_pictures_ = 0;
  const std::optional<Face> found = faces_->find(bgr);
  const bool any_before =
      num_looks_ > 0 && std::find(seen_.begin(), seen_.end(), true) != seen_.end();
  if (num_looks_ == 0) seen_.fill(false);
  seen_[num_looks_++ % kNumLooks] = found.has_value();
  if (!found) return;
  // Masks are scaled by the side: they keep their size in a gesture, and while it hardly changes.
  const bool as_large =
      any_before && (in_gesture || std::abs(found->side_px / face_.side_px - 1) < kResized);
  face_ = as_large ? detail::resized(*found, face_.side_px) : *found;
}

}  // namespace hri::detail
