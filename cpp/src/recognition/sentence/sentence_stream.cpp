// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/sentence_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
constexpr float kFarthest = 1e6F;          // of a track, as TwoHandFeatureComputer has it
constexpr std::size_t kReference = 4;      // first column of the head in tracks
constexpr double kLeastSpread = 1e-6;      // of a column that is constant
constexpr std::size_t kFramesTooMany = 2;  // so many times as are needed are kept

[[noreturn]] void fail_at(std::int64_t frame, std::size_t column, float value, const char* must) {
  fail(ErrorKind::invalid_argument, "frame " + std::to_string(frame) + ", column " +
                                        std::to_string(column) + " is " + std::to_string(value) +
                                        ", must be " + must);
}

// How much each of the first columns varies over the states of all models.
std::vector<float> spreads_of(const std::vector<GaussianMixtureHmm>& models, Eigen::Index count) {
  VectorD sum = VectorD::Zero(count);
  VectorD squares = VectorD::Zero(count);
  VectorD within_states = VectorD::Zero(count);
  double number = 0;
  for (const GaussianMixtureHmm& model : models) {
    const MatrixD means = model.bank().means().leftCols(count);
    sum += means.colwise().sum();
    squares += means.array().square().matrix().colwise().sum();
    within_states += model.bank().variances().leftCols(count).colwise().sum();
    number += static_cast<double>(means.rows());
  }
  const VectorD between = squares / number - (sum / number).array().square().matrix();
  const VectorD variances = between + within_states / number;
  std::vector<float> spreads;
  for (const double variance : variances)
    spreads.push_back(static_cast<float>(std::max(kLeastSpread, std::sqrt(variance))));
  return spreads;
}

}  // namespace

bool SentenceStream::same_label(const Settling& settling, const RecognisedSign& word) {
  return settling.label == word.label;
}

SentenceStream::SentenceStream(SentenceRecognizer recognizer, const SentenceStreamOptions& options)
    : recognizer_(std::move(recognizer)), options_(validated(options)) {
  const TwoHandFeatureOptions& features = recognizer_.options().features;
  require(are_tracks() || options_.scale_px == 0, "scale_px is of tracks, rows have none");
  const Eigen::Index dim = recognizer_.models().front().dim();
  const Eigen::Index columns =
      are_tracks() ? kNumTwoHandTrackColumns : dim / (1 + features.delta_orders);
  // Of tracks, places of the hands from the head are the first features.
  const Eigen::Index compared = are_tracks() ? (features.use_left ? 4 : 2) : columns;
  spreads_ = spreads_of(recognizer_.models(), compared);
  held_.assign(static_cast<std::size_t>(columns), kUnseen);
  dropped_ = held_;
}

bool SentenceStream::are_tracks() const {
  return recognizer_.options().input == SentenceInput::tracks;
}

void SentenceStream::check(Span<const float> row, double time_s) const {
  if (row.size() != held_.size()) {
    fail(ErrorKind::invalid_argument, "a frame has " + std::to_string(row.size()) +
                                          " values, must have " + std::to_string(held_.size()));
  }
  require(std::isfinite(time_s), "time must be finite");
  require(time_s >= time_s_, "time runs backwards");
  const std::int64_t frame = first_kept_ + static_cast<std::int64_t>(times_.size());
  const std::size_t group = are_tracks() ? 2 : row.size();  // NaN together
  for (std::size_t c = 0; c < row.size(); ++c) {
    const bool shown = !std::isnan(row[c / group * group]);
    if (shown ? !std::isfinite(row[c]) : !std::isnan(row[c])) {
      fail_at(frame, c, row[c],
              are_tracks() ? "finite, or the whole point NaN" : "finite, or the whole frame NaN");
    }
    if (are_tracks() && std::abs(row[c]) > kFarthest) fail_at(frame, c, row[c], "within 1e6");
  }
}

// Whether the row shows a hand.
bool SentenceStream::hold(Span<const float> row) {
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (!std::isnan(row[c])) held_[c] = row[c];
  }
  if (!are_tracks()) return !std::isnan(row[0]);
  const bool left = recognizer_.options().features.use_left && !std::isnan(row[0]);
  return left || !std::isnan(row[2]);
}

void SentenceStream::keep(Span<const float> row, double time_s) {
  rows_.insert(rows_.end(), row.begin(), row.end());
  times_.push_back(time_s);
  append_place();
}

// What movement is measured by: rows, or the hands from the head in lengths of the signer.
void SentenceStream::append_place() {
  if (!are_tracks()) {
    places_.insert(places_.end(), held_.begin(), held_.end());
    return;
  }
  const std::size_t first = places_.size();
  for (std::size_t c = 0; c < spreads_.size(); ++c) {
    const std::size_t hand = c < 2 ? 2 : 0;  // the right one first, as features have it
    places_.push_back(held_[hand + c % 2] - held_[kReference + c % 2]);
  }
  for (std::size_t c = first; c + 1 < places_.size(); c += 2) {
    if (std::isnan(places_[c])) continue;
    square_sum_ += static_cast<double>(places_[c]) * places_[c] +
                   static_cast<double>(places_[c + 1]) * places_[c + 1];
    num_distances_ += 1;
  }
  const double own = num_distances_ > 0 ? std::sqrt(square_sum_ / num_distances_) : 0;
  const double scale = options_.scale_px > 0 ? options_.scale_px : own;
  for (std::size_t c = first; c < places_.size(); ++c)
    places_[c] = scale > 0 ? static_cast<float>(places_[c] / scale) : kUnseen;
}

// The root mean square over the columns that both frames show; 0 where none does.
double SentenceStream::change_since_compared() const {
  const double then_s = times_.back() - options_.compare_s;
  std::size_t then = times_.size() - 1;
  while (then > 0 && times_[then] > then_s) --then;
  const std::size_t width = spreads_.size();
  const float* const now = places_.data() + (times_.size() - 1) * width;
  const float* const before = places_.data() + then * width;
  double sum = 0;
  double count = 0;
  for (std::size_t c = 0; c < width; ++c) {
    const double moved = (now[c] - before[c]) / spreads_[c];
    if (std::isnan(moved)) continue;
    sum += moved * moved;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) / options_.still_change : 0;
}

SentenceEvent SentenceStream::push(Span<const float> row, double time_s) {
  check(row, time_s);
  if (time_s - seen_s_ >= options_.leave_s && !in_sentence_) {
    // Hands that come back are elsewhere, which is no movement.
    drop(times_.size());
    std::fill(held_.begin(), held_.end(), kUnseen);
    dropped_ = held_;
  }
  time_s_ = time_s;
  const bool seen = hold(row);
  if (seen) seen_s_ = time_s;
  keep(row, time_s);
  change_ = change_since_compared();
  const bool still = change_ < 1;
  return in_sentence_ ? follow(seen, still, time_s) : wait(seen, still, time_s);
}

SentenceEvent SentenceStream::wait(bool seen, bool still, double time_s) {
  if (!seen || still) {
    moving_since_s_.reset();
  } else if (!moving_since_s_) {
    moving_since_s_ = time_s;
  }
  const double lead_s = options_.compare_s + options_.context_s;
  const std::size_t old = num_before(moving_since_s_.value_or(time_s) - lead_s);
  if (old * kFramesTooMany > times_.size()) drop(old);  // not at every frame
  const bool begins = moving_since_s_ && time_s - *moving_since_s_ >= options_.appear_s;
  if (!begins || (are_tracks() && std::isnan(held_[kReference]))) return {};
  // The first movement was seen against the frame of compare_s before.
  first_s_ = std::max(times_.front(), *moving_since_s_ - options_.compare_s);
  drop(num_before(*moving_since_s_ - lead_s));
  in_sentence_ = true;
  still_since_s_.reset();
  next_search_s_ = time_s + options_.partial_s;
  settling_.clear();
  num_stable_ = 0;
  SentenceEvent event;
  event.kind = SentenceEventKind::start;
  event.first_s = first_s_;
  event.last_s = time_s;
  return event;
}

SentenceEvent SentenceStream::follow(bool seen, bool still, double time_s) {
  if (seen && !still) still_since_s_.reset();
  // Still: as it was compare_s ago.
  if (seen && still && !still_since_s_)
    still_since_s_ = std::max(first_s_, time_s - options_.compare_s);
  if (still_since_s_ && seen && time_s - *still_since_s_ >= options_.rest_s)
    return end(SentenceEventReason::rested, *still_since_s_);
  if (time_s - seen_s_ >= options_.leave_s) return end(SentenceEventReason::left, seen_s_);
  if (time_s - first_s_ >= options_.max_sentence_s || times_.size() >= kMostFrames)
    return end(SentenceEventReason::cut, time_s);
  return time_s >= next_search_s_ ? search_so_far(time_s) : SentenceEvent();
}

SentenceEvent SentenceStream::search_so_far(double time_s) {
  next_search_s_ =
      time_s + std::max(options_.partial_s, options_.partial_share * (time_s - times_.front()));
  const MatrixF rows = rows_until(time_s);
  const RecognisedSentence found = recognizer_.recognise_begun(rows, options_.scale_px);
  settle(found.words, rows.rows());
  const bool agrees = found.words.size() >= num_stable_ &&
                      std::equal(settling_.begin(), settling_.begin() + num_stable_,
                                 found.words.begin(), same_label);
  if (!agrees || found.words.empty()) return {};  // what was given last still stands
  SentenceEvent event;
  event.kind = SentenceEventKind::partial;
  event.words = placed(found);
  event.log_score = found.log_score;
  event.num_stable = static_cast<int>(num_stable_);
  event.first_s = first_s_;
  event.last_s = time_s;
  return event;
}

// Counts for every word that has ended how many searches in a row have found it; those that are
// stable stay, whatever this one finds.
void SentenceStream::settle(const std::vector<RecognisedSign>& words, std::int64_t num_frames) {
  std::size_t ended = words.size();
  while (ended > 0 && words[ended - 1].last_frame >= num_frames) --ended;
  std::size_t i = 0;
  while (i < ended && i < settling_.size() && same_label(settling_[i], words[i])) {
    ++settling_[i].num_searches;
    ++i;
  }
  if (i < num_stable_) return;
  settling_.resize(i);
  for (; i < ended; ++i) settling_.push_back({words[i].label, 1});
  while (num_stable_ < settling_.size() &&
         settling_[num_stable_].num_searches >= options_.num_agreeing)
    ++num_stable_;
}

SentenceEvent SentenceStream::end(SentenceEventReason reason, double last_s) {
  const double context_s = reason == SentenceEventReason::rested ? options_.context_s : 0;
  const RecognisedSentence found =
      recognizer_.recognise(rows_until(last_s + context_s), options_.scale_px);
  SentenceEvent event;
  event.kind = found.words.empty() ? SentenceEventKind::dropped : SentenceEventKind::end;
  event.reason = reason;
  event.words = placed(found);
  event.log_score = found.log_score;
  event.num_stable = static_cast<int>(event.words.size());
  event.first_s = first_s_;
  event.last_s = last_s;
  in_sentence_ = false;
  moving_since_s_.reset();
  // What follows shares no frame with a sentence that was cut.
  if (reason == SentenceEventReason::cut) drop(times_.size() - 1);
  if (reason == SentenceEventReason::rested) drop(num_before(last_s + context_s));
  return event;
}

SentenceEvent SentenceStream::finish() {
  SentenceEvent event;
  if (in_sentence_) event = end(SentenceEventReason::ended, time_s_);
  forget();
  return event;
}

SentenceEvent SentenceStream::interrupt() {
  SentenceEvent event;
  if (in_sentence_) {
    event.kind = SentenceEventKind::dropped;
    event.reason = SentenceEventReason::stalled;
    event.first_s = first_s_;
    event.last_s = time_s_;
  }
  const double time_s = time_s_;
  forget();
  time_s_ = time_s;
  return event;
}

// The frames kept, as recognise() takes them: points that the first does not show are where they
// were last seen before it.
MatrixF SentenceStream::rows_until(double last_s) const {
  const auto end = std::upper_bound(times_.begin(), times_.end(), last_s);
  const auto width = static_cast<Eigen::Index>(held_.size());
  const Eigen::Index count = std::max<Eigen::Index>(1, end - times_.begin());
  MatrixF rows = Eigen::Map<const MatrixF>(rows_.data(), count, width);
  for (Eigen::Index c = 0; c < width; ++c) {
    if (std::isnan(rows(0, c))) rows(0, c) = dropped_[static_cast<std::size_t>(c)];
  }
  return rows;
}

std::vector<StreamedSign> SentenceStream::placed(const RecognisedSentence& found) const {
  std::vector<StreamedSign> words;
  words.reserve(found.words.size());
  for (const RecognisedSign& word : found.words) {
    StreamedSign sign;
    static_cast<RecognisedSign&>(sign) = word;
    sign.first_s = times_[static_cast<std::size_t>(word.first_frame)];
    sign.last_s = times_[static_cast<std::size_t>(word.last_frame - 1)];
    sign.first_frame += first_kept_;
    sign.last_frame += first_kept_;
    words.push_back(std::move(sign));
  }
  return words;
}

std::size_t SentenceStream::num_before(double time_s) const {
  const auto needed = std::lower_bound(times_.begin(), times_.end(), time_s);
  return static_cast<std::size_t>(needed - times_.begin());
}

void SentenceStream::drop(std::size_t count) {
  const std::size_t width = held_.size();
  for (std::size_t i = 0; i < count * width; ++i) {
    if (!std::isnan(rows_[i])) dropped_[i % width] = rows_[i];
  }
  const auto of = [count](std::size_t each) { return static_cast<std::ptrdiff_t>(count * each); };
  rows_.erase(rows_.begin(), rows_.begin() + of(width));
  times_.erase(times_.begin(), times_.begin() + of(1));
  places_.erase(places_.begin(), places_.begin() + of(spreads_.size()));
  first_kept_ += static_cast<std::int64_t>(count);
}

void SentenceStream::forget() {
  rows_.clear();
  times_.clear();
  places_.clear();
  first_kept_ = 0;
  std::fill(held_.begin(), held_.end(), kUnseen);
  dropped_ = held_;
  time_s_ = seen_s_ = -std::numeric_limits<double>::infinity();
  moving_since_s_.reset();
  still_since_s_.reset();
  square_sum_ = num_distances_ = change_ = 0;
  in_sentence_ = false;
}

}  // namespace hri
