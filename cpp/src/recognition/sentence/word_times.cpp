// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/word_times.hpp"

#include <algorithm>
#include <cmath>

#include "signal/word_bounds.hpp"

namespace hri::detail {
namespace {

// Noise, averaged over all bands and over a frame and as many on each side, varies by less than
// this.
constexpr float kSteadyDb = 3;
constexpr std::size_t kNeighbours = 2;

}  // namespace

WordTimes::WordTimes(int sample_rate_hz, const ActivityOptions& activity)
    : meter_(sample_rate_hz, activity),
      activity_(activity),
      shift_s_(static_cast<double>(meter_.frame_shift()) / sample_rate_hz),
      length_s_(static_cast<double>(meter_.frame_length()) / sample_rate_hz) {}

std::vector<ActivityFrame> WordTimes::frames(Span<const float> audio) const {
  ActivityMeter meter = meter_;
  std::vector<ActivityFrame> result;
  result.reserve(audio.size() / meter.frame_shift() + 1);
  for (std::size_t at = 0; at < audio.size();) {
    ActivityFrame frame;
    bool complete = false;
    at += meter.take(audio.subspan(at, audio.size() - at), &frame, &complete);
    if (complete) result.push_back(frame);
  }
  return result;
}

void WordTimes::extend(const ScoredRecording& recording,
                       std::vector<TranscribedWord>* words) const {
  if (recording.activity.empty()) return;
  WordFinder finder(meter_, activity_);
  double from_s = recording.activity_first_s;
  for (std::size_t i = 0; i < words->size();) {
    TranscribedWord& first = (*words)[i];
    // Behind the words that follow one another without a pause.
    ++i;
    while (i < words->size() && (*words)[i].first_s <= (*words)[i - 1].last_s) ++i;
    TranscribedWord& last = (*words)[i - 1];
    const double to_s = i < words->size() ? quietest_s(recording, last.last_s, (*words)[i].first_s)
                                          : middle_s(recording, recording.activity.size());
    std::size_t begin = 0;
    const WordFrames found = finder.find(within(recording, from_s, to_s, &begin));
    if (found.found) {
      const double half_s = 0.5 * length_s_;
      const double first_s = middle_s(recording, begin + found.first) - half_s;
      const double last_s = middle_s(recording, begin + found.last - 1) + half_s;
      first.first_s = std::min(first.first_s, std::max(from_s, first_s));
      last.last_s = std::max(last.last_s, std::min(to_s, last_s));
    }
    from_s = to_s;
  }
}

double WordTimes::middle_s(const ScoredRecording& recording, std::size_t frame) const {
  return recording.activity_first_s + static_cast<double>(frame) * shift_s_ + 0.5 * length_s_;
}

Span<const ActivityFrame> WordTimes::within(const ScoredRecording& recording, double first_s,
                                            double last_s, std::size_t* first) const {
  const std::size_t num_frames = recording.activity.size();
  const auto frame_at = [&](double time_s) {
    const double frame = std::ceil((time_s - middle_s(recording, 0)) / shift_s_);
    return static_cast<std::size_t>(std::clamp(frame, 0.0, static_cast<double>(num_frames)));
  };
  *first = frame_at(first_s);
  return Span<const ActivityFrame>(recording.activity)
      .subspan(*first, std::max(*first, frame_at(last_s)) - *first);
}

// The middle of all frames around which it is about as quiet as around the quietest: where there is
// silence, that of the silence.
double WordTimes::quietest_s(const ScoredRecording& recording, double first_s,
                             double last_s) const {
  std::size_t begin = 0;
  const Span<const ActivityFrame> pause = within(recording, first_s, last_s, &begin);
  if (pause.empty()) return 0.5 * (first_s + last_s);
  std::vector<float> level_db(pause.size(), 0.0F);
  for (std::size_t t = 0; t < pause.size(); ++t) {
    const std::size_t first = t - std::min(t, kNeighbours);
    const std::size_t last = std::min(pause.size(), t + kNeighbours + 1);
    for (std::size_t u = first; u < last; ++u) {
      for (std::size_t b = 0; b < static_cast<std::size_t>(meter_.num_bands()); ++b)
        level_db[t] += pause[u].band_db[b];
    }
    level_db[t] /=
        static_cast<float>((last - first) * static_cast<std::size_t>(meter_.num_bands()));
  }
  const float lowest_db = *std::min_element(level_db.begin(), level_db.end());
  std::vector<std::size_t> quiet;
  for (std::size_t t = 0; t < pause.size(); ++t) {
    if (level_db[t] < lowest_db + kSteadyDb) quiet.push_back(t);
  }
  return middle_s(recording, begin + quiet[quiet.size() / 2]);
}

}  // namespace hri::detail
