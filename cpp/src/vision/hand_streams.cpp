// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/hand_streams.hpp"

#include <algorithm>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

constexpr double kSample_s = 0.25;
constexpr std::size_t kFewestSamples = 4;
constexpr double kLearn_s = 1.0;
constexpr double kAlike = 0.9;   // outlines that share so much are of the same colours
constexpr double kMoved = 0.3;   // those that differ by so much are of something that moves, as
                                 // hands do and furniture does not
constexpr double kSurer = 0.05;  // by how much better the quality of better colours is

// What both cover, as a share of what either does, 0..1; 1 where neither covers anything.
double shared(const GreyImage& a, const GreyImage& b) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    both += (a.pixels[i] & b.pixels[i]) != 0 ? 1 : 0;
    either += (a.pixels[i] | b.pixels[i]) != 0 ? 1 : 0;
  }
  return either > 0 ? both / static_cast<double>(either) : 1.0;
}

double differ(const std::array<GreyImage, 3>& outlines) {
  return 1.0 - std::min(shared(outlines[0], outlines[1]), shared(outlines[1], outlines[2]));
}

bool shows_a_hand(const GreyImage& mask) {
  return std::any_of(mask.pixels.begin(), mask.pixels.end(), [](std::uint8_t v) { return v != 0; });
}

}  // namespace

const HandObservation& LearningHandStream::push(ImageView bgr, double time_s, bool in_gesture) {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  renewed_ = false;
  const Sample& oldest = samples_[first_];
  if (count_ > 0 && (oldest.width_px != bgr.width_px || oldest.height_px != bgr.height_px))
    count_ = 0;
  if (time_s - sampled_s_ >= kSample_s) {
    keep(bgr);
    sampled_s_ = time_s;
  }
  if (!tried_s_) tried_s_ = time_s;
  const bool may_change = !colours_ || !in_gesture;
  if (may_change && count_ >= kFewestSamples && time_s - *tried_s_ >= kLearn_s) {
    tried_s_ = time_s;
    consider(HandColours::learn(samples(), options_.colours));
  }
  colours_ ? colours_->extract(bgr, &found_) : extractor_.extract(bgr, &found_);
  return found_;
}

void LearningHandStream::keep(ImageView bgr) {
  if (count_ == kNumSamples) {
    first_ = (first_ + 1) % kNumSamples;
    --count_;
  }
  Sample& sample = samples_[(first_ + count_++) % kNumSamples];
  sample.width_px = bgr.width_px;
  sample.height_px = bgr.height_px;
  const std::size_t length = 3 * static_cast<std::size_t>(bgr.width_px);
  sample.pixels.resize(length * static_cast<std::size_t>(bgr.height_px));
  for (int y = 0; y < bgr.height_px; ++y)
    std::copy_n(bgr.row(y), length, sample.pixels.data() + static_cast<std::size_t>(y) * length);
}

std::vector<ImageView> LearningHandStream::samples() const {
  std::vector<ImageView> views;
  for (std::size_t i = 0; i < count_; ++i) {
    const Sample& s = samples_[(first_ + i) % kNumSamples];
    views.push_back({s.pixels.data(), s.width_px, s.height_px, 3, std::ptrdiff_t{3} * s.width_px});
  }
  return views;
}

// Takes other colours where they are better than the present ones.
void LearningHandStream::consider(const std::optional<HandColours>& found) {
  if (!found) return;
  if (colours_) {
    const Outlines before = outlines(*colours_);
    const Outlines after = outlines(*found);
    if (shared(before[2], after[2]) >= kAlike) return;
    const double moves_before = differ(before);
    const double moves_after = differ(after);
    const bool surer = found->quality() > colours_->quality() + kSurer && shows_a_hand(before[2]);
    const bool moves = moves_after > kMoved && kMoved > moves_before;
    if (!moves && !(surer && moves_after >= moves_before)) return;
  }
  colours_ = found;
  renewed_ = true;
}

// Of the oldest, a middle and the newest sample.
LearningHandStream::Outlines LearningHandStream::outlines(const HandColours& colours) const {
  const std::vector<ImageView> views = samples();
  Outlines result;
  HandObservation found;
  const std::array<std::size_t, 3> chosen = {0, count_ / 2, count_ - 1};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    colours.extract(views[chosen[i]], &found);
    result[i] = found.mask;
  }
  return result;
}

}  // namespace hri::detail
