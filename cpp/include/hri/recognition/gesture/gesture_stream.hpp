// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Decisions on the gestures of a stream of pictures, as they are shown. Features are computed as
// the pictures come, and kept in place of them: the decision stands when a gesture ends, and memory
// is bounded by the longest gesture.
//
// Decisions are of two kinds. A robot obeys final ones. A preliminary one says what a segment looks
// like that may be but part of a gesture:
//  - the gestures trained on pause (GestureRecognizer::pauses), so that another segment may follow;
//  - the gestures trained on begin at rest, and this one did not: it may be the way to where one
//    begins.
// A preliminary decision settles, that is, becomes final, when the hand leaves, when no other
// segment follows within `max_pause_s`, or with the end of the stream. When another segment
// follows, the decision on that takes its place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/features/hand/hand_pair.hpp"
#include "hri/features/hand/landmark_pair.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/gesture/gesture_spotter.hpp"

namespace hri {

struct GestureStreamOptions {
  GestureSegmenterOptions segmenter;
  double max_pause_s = 2.5;
  double partial_interval_s = 0.5;

  static constexpr const char* kName = "GestureStreamOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("segmenter", o.segmenter, any_value, "when a gesture begins and ends");
    v("max_pause_s", o.max_pause_s, within(0, 1e6),
      "after a longer pause, what was shown before it is another gesture");
    v("partial_interval_s", o.partial_interval_s, above(0, 1e6).or_infinity(),
      "between decisions on a gesture that has not ended");
  }
};

enum class GestureEventKind : std::uint8_t {
  segment,      ///< one began, ended or was dropped: see `segment`
  partial,      ///< `decision` is on what was shown of a segment so far
  preliminary,  ///< on a segment that may be part of a gesture
  decision,     ///< final: to be obeyed
};
constexpr auto enum_names(GestureEventKind) {
  return std::array{"segment", "partial", "preliminary", "decision"};
}

struct GestureEvent {
  GestureEventKind kind = GestureEventKind::segment;
  GestureSegment segment;  ///< what happened, or which segment the decision is on
  Decision decision;
};

/// One stream. What is allocated once gestures have been shown are decisions, and colours that are
/// learned anew. Not to be shared by threads.
class HRI_API GestureStream {
 public:
  /// What suits a recogniser: whether its gestures begin at rest, and how their hands are found.
  static GestureStreamOptions options_for(const GestureRecognizer& recognizer);

  /// `hands` gives masks of as many hands as the recogniser takes. Throws InvalidArgument for no
  /// stream of hands and options out of range.
  GestureStream(GestureRecognizer recognizer, std::unique_ptr<HandStream> hands,
                const GestureStreamOptions& options);
  /// Hands as the recogniser's options say, found by `source`.
  GestureStream(const GestureRecognizer& recognizer, const HandSource& source);

  /// The next picture (BGR) and its time; what happened with it, which is overwritten by the next
  /// call. A recogniser of landmarks takes those of the hands in this picture, in pixels
  /// (kNumLandmarks rows each), the surest first: the first, or both. Throws as GestureSpotter and
  /// LandmarkPairTracker do.
  const std::vector<GestureEvent>& push(ImageView bgr, double time_s,
                                        Span<const MatrixF> landmarks_px = {});

  /// The stream has ended; preliminary decisions settle. The next stream may begin.
  const std::vector<GestureEvent>& finish();

  /// The stream was interrupted: what was shown and has not settled is forgotten.
  const std::vector<GestureEvent>& interrupt();

  [[nodiscard]] const GestureSpotter& spotter() const { return spotter_; }
  [[nodiscard]] const GestureRecognizer& recognizer() const { return recognizer_; }
  [[nodiscard]] const GestureStreamOptions& options() const { return options_; }

 private:
  struct Row {
    double time_s = 0;
    bool hand = false;
    std::vector<float> features;  // of both hands: the left one's, the right one's; NaN: not seen
  };
  struct Span_s {
    double first_s = 0;
    double last_s = 0;
  };

  void keep_row(ImageView bgr, double time_s, Span<const MatrixF> landmarks_px);
  bool compute_hand(ImageView bgr, Span<const MatrixF> landmarks_px, Span<float> row) const;
  bool compute_pair(ImageView bgr, Span<const MatrixF> landmarks_px, Span<float> row);
  void forget_rows(const GestureSegment& segment, double time_s);
  Row& row(std::size_t i) { return rows_[(first_ + i) % rows_.size()]; }
  [[nodiscard]] const Row& row(std::size_t i) const { return rows_[(first_ + i) % rows_.size()]; }
  [[nodiscard]] Span_s frames_of(const GestureSegment& segment) const;
  [[nodiscard]] Decision recognise(double first_s, double last_s) const;
  [[nodiscard]] Decision decide(const GestureSegment& segment);
  void conclude(const GestureSegment& segment);
  void settle();
  void settle_if_over(const GestureSegment& segment, double time_s);

  GestureRecognizer recognizer_;
  GestureStreamOptions options_;
  GestureSpotter spotter_;
  HandPairTracker pair_;
  LandmarkPairTracker landmark_pair_;
  std::vector<Row> rows_;  // a ring, of which `count_` from `first_` on are in use
  std::size_t first_ = 0, count_ = 0;
  std::optional<Span_s> before_;         // the segment before a pause
  std::optional<GestureEvent> pending_;  // a preliminary decision
  double partial_s_ = 0;
  std::vector<GestureEvent> events_;
};

}  // namespace hri
