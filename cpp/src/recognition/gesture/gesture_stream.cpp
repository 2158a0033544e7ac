// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/features/hand/landmarks.hpp"
#include "hri/features/hand/pair_rows.hpp"

namespace hri {
namespace {

constexpr std::size_t kMostRows = 20000;  // for streams whose time hardly goes on
constexpr double kSpare_s = 1.0;          // by how much rows are kept longer than they are needed

bool learns_colours(const GestureRecognizer& recognizer) {
  return recognizer.is_dynamic() &&
         recognizer.options().hands.learning == ColourLearning::automatic;
}

// Masks of streams hold hands only, however small.
HandPairOptions all_regions() {
  HandPairOptions options;
  options.min_area = 0;
  return options;
}

}  // namespace

GestureStreamOptions GestureStream::options_for(const GestureRecognizer& recognizer) {
  GestureStreamOptions options;
  if (learns_colours(recognizer)) options.segmenter.still_change = kLearnedStillChange;
  options.segmenter.arrivals = !recognizer.starts_at_rest();
  return options;
}

GestureStream::GestureStream(GestureRecognizer recognizer, std::unique_ptr<HandStream> hands,
                             const GestureStreamOptions& options)
    : recognizer_(std::move(recognizer)),
      options_(validated(options)),
      spotter_(std::move(hands), options.segmenter),
      pair_(all_regions()) {}

GestureStream::GestureStream(const GestureRecognizer& recognizer, const HandSource& source)
    : GestureStream(recognizer,
                    source.stream(recognizer.is_dynamic(), recognizer.options().num_hands),
                    options_for(recognizer)) {}

const std::vector<GestureEvent>& GestureStream::push(ImageView bgr, double time_s,
                                                     Span<const MatrixF> landmarks_px) {
  events_.clear();
  const GestureSegment segment = spotter_.push(bgr, time_s);
  keep_row(bgr, time_s, landmarks_px);
  forget_rows(segment, time_s);
  if (segment.kind != GestureSegmentKind::none)
    events_.push_back({GestureEventKind::segment, segment, {}});
  if (segment.kind == GestureSegmentKind::end) {
    conclude(segment);
  } else if (!spotter_.segmenter().in_gesture()) {
    partial_s_ = time_s;
  } else if (time_s - partial_s_ >= options_.partial_interval_s) {
    partial_s_ = time_s;
    const double begun_s = spotter_.segmenter().may_have_begun_s().value_or(time_s);
    const GestureSegment so_far{GestureSegmentKind::none, GestureSegmentReason::none, begun_s,
                                time_s, false};
    events_.push_back({GestureEventKind::partial, so_far,
                       recognise(begun_s - options_.segmenter.context_s, time_s)});
  }
  settle_if_over(segment, time_s);
  return events_;
}

const std::vector<GestureEvent>& GestureStream::finish() {
  events_.clear();
  const GestureSegment segment = spotter_.finish();
  if (segment.kind != GestureSegmentKind::none)
    events_.push_back({GestureEventKind::segment, segment, {}});
  if (segment.kind == GestureSegmentKind::end) conclude(segment);
  settle();
  before_.reset();
  count_ = 0;
  partial_s_ = 0;
  pair_.reset();
  landmark_pair_.reset();
  return events_;
}

const std::vector<GestureEvent>& GestureStream::interrupt() {
  events_.clear();
  const GestureSegment segment = spotter_.interrupt();
  if (segment.kind != GestureSegmentKind::none)
    events_.push_back({GestureEventKind::segment, segment, {}});
  pending_.reset();
  before_.reset();
  count_ = 0;
  pair_.reset();
  landmark_pair_.reset();
  return events_;
}

void GestureStream::keep_row(ImageView bgr, double time_s, Span<const MatrixF> landmarks_px) {
  if (count_ == kMostRows) {
    first_ = (first_ + 1) % rows_.size();
    --count_;
  }
  if (count_ == rows_.size()) {
    std::rotate(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(first_), rows_.end());
    first_ = 0;
    rows_.emplace_back();
  }
  Row& now = row(count_++);
  now.time_s = time_s;
  const bool pair = recognizer_.options().num_hands == 2;
  const int num_features = recognizer_.options().source == GestureSource::landmarks
                               ? kNumLandmarkFeatures
                               : recognizer_.front_end().num_features();
  now.features.resize(static_cast<std::size_t>(pair ? 2 * num_features : num_features));
  now.hand = pair ? compute_pair(bgr, landmarks_px, now.features)
                  : compute_hand(bgr, landmarks_px, now.features);
}

bool GestureStream::compute_hand(ImageView bgr, Span<const MatrixF> landmarks_px,
                                 Span<float> row) const {
  if (recognizer_.options().source == GestureSource::silhouettes)
    return recognizer_.front_end().compute(spotter_.hand(), row);
  if (landmarks_px.empty()) return false;
  landmark_features(landmarks_px[0], bgr.width_px, bgr.height_px, row);
  return true;
}

bool GestureStream::compute_pair(ImageView bgr, Span<const MatrixF> landmarks_px, Span<float> row) {
  std::fill(row.begin(), row.end(), std::numeric_limits<float>::quiet_NaN());
  const std::size_t length = row.size() / 2;
  bool any = false;
  if (recognizer_.options().source == GestureSource::landmarks) {
    const std::array<int, 2> found = landmark_pair_.push(landmarks_px, bgr.width_px);
    for (std::size_t side = 0; side < 2; ++side) {
      if (found[side] < 0) continue;
      landmark_features(landmarks_px[static_cast<std::size_t>(found[side])], bgr.width_px,
                        bgr.height_px, row.subspan(side * length, length));
      any = true;
    }
    return any;
  }
  const HandObservation& both = spotter_.hand();
  if (both.mask.pixels.empty()) return false;
  const std::array<PairedHand, 2>& hands = pair_.push(both.mask.view());
  if (both.quality < recognizer_.options().min_quality) return false;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!hands[side].seen) continue;
    any |= recognizer_.front_end().compute(HandImage{both.grey.view(), hands[side].mask.view()},
                                           row.subspan(side * length, length));
  }
  return any;
}

void GestureStream::forget_rows(const GestureSegment& segment, double time_s) {
  double first_s = time_s - options_.segmenter.context_s;
  if (segment.kind == GestureSegmentKind::end) {
    first_s = frames_of(segment).first_s;
  } else if (spotter_.segmenter().in_gesture()) {
    GestureSegment so_far;
    so_far.first_s = spotter_.segmenter().may_have_begun_s().value_or(time_s);
    so_far.last_s = time_s;
    first_s = frames_of(so_far).first_s;
  }
  if (before_) {
    if (first_s - before_->last_s > options_.max_pause_s)
      before_.reset();
    else
      first_s = before_->first_s;
  }
  first_s = std::min(first_s, spotter_.kept_since_s()) - kSpare_s;
  while (count_ > 1 && row(0).time_s < first_s) {
    first_ = (first_ + 1) % rows_.size();
    --count_;
  }
}

// The times of the first and the last picture of a segment and its context.
GestureStream::Span_s GestureStream::frames_of(const GestureSegment& segment) const {
  const double first_s = segment.first_s - options_.segmenter.context_s;
  Span_s found{segment.first_s, segment.last_s};
  bool any = false;
  for (std::size_t i = 0; i < count_; ++i) {
    const double time_s = row(i).time_s;
    if (time_s < first_s || time_s > segment.last_s) continue;
    if (!any) found.first_s = time_s;
    found.last_s = time_s;
    any = true;
  }
  return found;
}

Decision GestureStream::recognise(double first_s, double last_s) const {
  MatrixF features(static_cast<Eigen::Index>(count_),
                   count_ > 0 ? static_cast<Eigen::Index>(row(0).features.size()) : 0);
  Eigen::Index used = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Row& r = row(i);
    if (!r.hand || r.time_s < first_s || r.time_s > last_s) continue;
    std::copy(r.features.begin(), r.features.end(), features.data() + used++ * features.cols());
  }
  if (recognizer_.options().num_hands == 1 || used == 0)
    return recognizer_.recognise_features(features.topRows(used));
  const Eigen::Index length = features.cols() / 2;
  return recognizer_.recognise_features(pair_rows(features.topRows(used).leftCols(length),
                                                  features.topRows(used).rightCols(length),
                                                  recognizer_.options().relation_weight));
}

// Where the gestures trained on pause, a segment is decided on by itself and with the one before
// it; the surer answer stands.
Decision GestureStream::decide(const GestureSegment& segment) {
  const Span_s frames = frames_of(segment);
  Decision alone = recognise(frames.first_s, frames.last_s);
  if (!recognizer_.pauses()) return alone;
  const std::optional<Span_s> before = std::exchange(before_, frames);
  if (!before || frames.first_s - before->last_s > options_.max_pause_s) return alone;
  Decision both = recognise(before->first_s, frames.last_s);
  return both.score > alone.score ? both : alone;
}

void GestureStream::conclude(const GestureSegment& segment) {
  const bool on_the_way = recognizer_.starts_at_rest() && !segment.from_rest;
  const bool over =
      segment.reason == GestureSegmentReason::left || segment.reason == GestureSegmentReason::ended;
  const bool open = (recognizer_.pauses() || on_the_way) && !over;
  GestureEvent event{GestureEventKind::decision, segment, decide(segment)};
  pending_.reset();
  if (open) {
    pending_ = event;
    event.kind = GestureEventKind::preliminary;
  }
  events_.push_back(std::move(event));
}

void GestureStream::settle() {
  if (pending_) events_.push_back(std::move(*pending_));
  pending_.reset();
}

void GestureStream::settle_if_over(const GestureSegment& segment, double time_s) {
  if (!pending_ || segment.kind == GestureSegmentKind::end || spotter_.segmenter().in_gesture())
    return;
  if (spotter_.segmenter().hand_away() || time_s - pending_->segment.last_s > options_.max_pause_s)
    settle();
}

}  // namespace hri
