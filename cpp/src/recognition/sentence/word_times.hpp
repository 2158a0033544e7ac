// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Where words begin and end beside pauses. A first fricative and a word that dies away look like
// silence to the models; the rule of end points of isolated words still finds them.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/signal/activity_meter.hpp"

namespace hri::detail {

class WordTimes {
 public:
  /// Throws InvalidArgument for options and a rate out of range.
  WordTimes(int sample_rate_hz, const ActivityOptions& activity);

  /// Of audio at this rate; none where it is shorter than one.
  [[nodiscard]] std::vector<ActivityFrame> frames(Span<const float> audio) const;

  /// Moves boundaries of words beside pauses into these, as far as find_speech() finds sound;
  /// before the first word and behind the last one, too. Boundaries between words do not move, none
  /// moves inwards, and a pause between two words is divided where it is quietest. `words` have the
  /// times of the decoder, as one path has them.
  void extend(const ScoredRecording& recording, std::vector<TranscribedWord>* words) const;

 private:
  [[nodiscard]] double middle_s(const ScoredRecording& recording, std::size_t frame) const;
  /// The activity frames whose middles lie in [first_s, last_s).
  [[nodiscard]] Span<const ActivityFrame> within(const ScoredRecording& recording, double first_s,
                                                 double last_s, std::size_t* first) const;
  [[nodiscard]] double quietest_s(const ScoredRecording& recording, double first_s,
                                  double last_s) const;

  ActivityMeter meter_;  // never used itself: a copy is
  ActivityOptions activity_;
  double shift_s_;
  double length_s_;
};

}  // namespace hri::detail
