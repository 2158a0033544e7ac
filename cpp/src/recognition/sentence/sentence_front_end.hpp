// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// From a recording of several words to frames: those of all streams of WordFrontEnd side by side,
// normalised over the whole utterance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/recognition/word/word_front_end.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri::detail {

/// An utterance at the rate of the front end, with kEdgeMs around its speech.
struct CutSentence {
  std::vector<float> samples;   ///< empty without speech
  std::int64_t offset = 0;      ///< of its first sample in the recording; may be negative
  std::vector<float> recorded;  ///< as it is, with kAroundMs around the speech where there are
  std::size_t recorded_offset = 0;
  std::vector<std::string> notes;  ///< what was converted on the way
};

class SentenceFrontEnd {
 public:
  static constexpr double kEdgeMs = 100;
  static constexpr double kAroundMs = 300;

  /// Throws InvalidArgument naming the option that is out of range.
  explicit SentenceFrontEnd(const WordRecognizerOptions& options, double warp_factor = 1);

  /// Throws InvalidArgument as WordFrontEnd::trim() does.
  [[nodiscard]] CutSentence cut(Span<const float> audio, int sample_rate_hz) const;
  /// Adds the noise floor, as far below the peak of `audio` as it is below that of a word.
  void add_floor(std::vector<float>* audio) const;
  /// Of what cut() gave, or of audio that add_floor() was called on. Shape (num_frames,
  /// num_features()).
  [[nodiscard]] MatrixF frames(std::vector<float> audio) const;

  [[nodiscard]] int num_features() const { return words_.num_features() * words_.num_streams(); }
  [[nodiscard]] int sample_rate_hz() const { return words_.sample_rate_hz(); }
  [[nodiscard]] std::size_t samples_of(double ms) const;
  /// The sample in the middle of a frame; between two frames for t - 0.5.
  [[nodiscard]] double middle_of(double t) const;

 private:
  WordFrontEnd words_;
  ActivityOptions activity_;
  double noise_floor_db_;
  int frame_shift_;
  int frame_length_;
  bool is_centred_;
};

/// Throws InvalidArgument for a sample that is not finite and a rate outside 1000..384000 Hz.
void check_recording(Span<const float> audio, int sample_rate_hz);

}  // namespace hri::detail
