// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gesture segments in a stream of masks, found as they are shown: the twin of Endpointer. Outlines
// are compared and not places, as fingers may move while the hand stays; so still signs and motions
// go the same way. The hand comes, and shows a sign until it rests, or moves until it rests or
// leaves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"

namespace hri {

/// `still_change` for hands found by colours of the stream: their outlines hardly flicker, and slow
/// movements are no rest.
constexpr double kLearnedStillChange = 0.12;

struct HRI_API GestureSegmenterOptions {
  double appear_s = 0.1;
  double leave_s = 0.3;
  double rest_s = 0.5;
  double still_change = 0.3;
  double compare_s = 0.2;
  double min_gesture_s = 0.3;
  double max_gesture_s = 6.0;
  double take_away_s = 1.0;
  double context_s = 0.1;
  bool arrivals = true;

  static constexpr const char* kName = "GestureSegmenterOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("appear_s", o.appear_s, above(0, 1e6),
      "a hand is there, or moves again, when it was seen, or moving, for so long");
    v("leave_s", o.leave_s, above(0, 1e6), "it has gone when it was not seen for so long");
    v("rest_s", o.rest_s, above(0, 1e6),
      "a hand that is still for so long ends the segment: it rests, or holds a sign");
    v("still_change", o.still_change, Range{0, 1, true, true},
      "it is still while the outlines of now and of compare_s ago differ by less than this share "
      "of what they cover together");
    v("compare_s", o.compare_s, above(0, 1e6), "time between the outlines that are compared");
    v("min_gesture_s", o.min_gesture_s, above(0, 1e6),
      "a shorter segment that ends in the hand leaving is dropped");
    v("max_gesture_s", o.max_gesture_s, above(0, 1e6),
      "a longer segment is cut; above min_gesture_s");
    v("take_away_s", o.take_away_s, above(0, 1e6),
      "a hand that rested and leaves within this time is taken away, and shows nothing");
    v("context_s", o.context_s, above(0, 1e6), "kept before a segment");
    v("arrivals", o.arrivals, any_value,
      "a hand that comes into view and rests has shown something, such as a sign that it holds; "
      "otherwise only what comes after that rest is a gesture");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

enum class GestureSegmentKind : std::uint8_t {
  none,
  start,    ///< something is shown since `first_s`
  end,      ///< and has ended: [first_s, last_s] is the segment
  dropped,  ///< what seemed to be a gesture was none
};
constexpr auto enum_names(GestureSegmentKind) {
  return std::array{"none", "start", "end", "dropped"};
}

/// Why a segment ended.
enum class GestureSegmentReason : std::uint8_t {
  none,
  rested,   ///< the hand is still
  left,     ///< it is out of view
  cut,      ///< the segment reached max_gesture_s
  ended,    ///< the stream did
  arrived,  ///< dropped: the hand only came into view
  stalled,  ///< dropped: the stream was interrupted
};
constexpr auto enum_names(GestureSegmentReason) {
  return std::array{"none", "rested", "left", "cut", "ended", "arrived", "stalled"};
}

/// An event in the stream; times are the caller's.
struct GestureSegment {
  GestureSegmentKind kind = GestureSegmentKind::none;
  GestureSegmentReason reason = GestureSegmentReason::none;
  double first_s = 0;
  double last_s = 0;
  bool from_rest = false;  ///< the hand rested in view before it
};

/// One stream. Nothing is allocated once masks of one size have come for compare_s. Not to be
/// shared by threads.
class HRI_API GestureSegmenter {
 public:
  /// Throws InvalidArgument for options out of range.
  explicit GestureSegmenter(const GestureSegmenterOptions& options);

  /// The next mask (0 is background; all 0 for no hand) and its time. Throws InvalidArgument for an
  /// empty mask, one of several channels, and a time that is not finite or runs backwards.
  GestureSegment push(ImageView mask, double time_s);

  /// What push() throws for a time that may not come next.
  void check_time(double time_s) const;

  /// The stream has ended, and with it any segment. The next stream may begin, at any time.
  GestureSegment finish();

  /// Forgets everything; a segment that had begun is dropped.
  GestureSegment interrupt();

  /// From now on the hand of now looks like `mask`, because it is found in another way: nothing has
  /// moved.
  void replace_outlines(ImageView mask);

  [[nodiscard]] const GestureSegmenterOptions& options() const { return options_; }
  [[nodiscard]] bool in_gesture() const { return phase_ == Phase::moving; }
  /// Whether no hand is in view, as far as segments are concerned.
  [[nodiscard]] bool hand_away() const { return phase_ == Phase::away; }
  /// Since when what is seen may turn out to be a gesture.
  [[nodiscard]] std::optional<double> may_have_begun_s() const;

 private:
  enum class Phase : std::uint8_t { away, moving, resting };
  struct Outline {
    double time_s = 0;
    GreyImage mask;
  };

  GestureSegment appear(bool hand, double time_s);
  GestureSegment rest(bool hand, bool still, bool gone, double time_s);
  GestureSegment move(bool still, bool gone, double time_s);
  GestureSegment begin(double first_s, bool from_rest);
  GestureSegment end(GestureSegmentReason reason, double last_s);
  void leave();
  void reset();
  double change(ImageView mask, double time_s);
  Outline& outline(std::size_t i) { return outlines_[(first_ + i) % outlines_.size()]; }
  Outline& append();

  GestureSegmenterOptions options_;
  Phase phase_ = Phase::away;
  std::vector<Outline> outlines_;  // a ring, of which `count_` from `first_` on are in use
  std::size_t first_ = 0, count_ = 0;
  std::optional<double> seen_since_s_;  // a hand without a gap, while it was away
  std::optional<double> still_since_s_, moving_since_s_;
  double time_s_ = -std::numeric_limits<double>::infinity();
  double last_hand_s_ = -std::numeric_limits<double>::infinity();
  double first_s_ = 0;
  bool from_rest_ = false;
  bool spent_ = false;  // cut: nothing new before the hand rests
};

}  // namespace hri
