// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_stream.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

constexpr double kPeriod_s = 1.0 / 20;

// Pictures of these tests are masks already: what a team with another camera would plug in.
class OneHandStream : public HandStream {
 public:
  const HandObservation& push(ImageView bgr, double /*time_s*/, bool /*in_gesture*/) override {
    found_.mask = GreyImage(bgr.width_px, bgr.height_px);
    for (std::size_t i = 0; i < found_.mask.pixels.size(); ++i)
      found_.mask.pixels[i] = bgr.data[3 * i];
    found_.grey = hand_testing::grey(found_.mask);
    found_.quality = 1;
    return found_;
  }

 private:
  HandObservation found_;
};

// Where a hand is; none below 0.
struct Place {
  double x, y;
};
using Way = std::vector<Place>;

// A straight way, in so many frames, then a rest.
void go(Way* way, Place to, int frames, int rest) {
  const Place from = way->empty() ? to : way->back();
  for (int i = 1; i <= frames; ++i) {
    const double share = static_cast<double>(i) / frames;
    way->push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
  }
  for (int i = 0; i < rest; ++i) way->push_back(to);
}

std::vector<HandObservation> observed(const Way& way) {
  std::vector<HandObservation> hands;
  for (const Place& p : way) {
    const GreyImage mask = hand(2, p.x, p.y, 0.6);
    hands.push_back({hand_testing::grey(mask), mask, 1, false, false});
  }
  return hands;
}

// "right" goes right, "down" goes down; those that pause do so half-way and go on the other way.
Way shown(const std::string& label, double start, bool pauses, int rest_before) {
  Way way;
  go(&way, {start, start + 20}, 1, rest_before);
  const bool right = label == "right";
  go(&way, {start + (right ? 60 : 0), start + 20 + (right ? 0 : 60)}, 8, 0);
  if (!pauses) return way;
  go(&way, way.back(), 0, 16);
  go(&way, {start + 60, start + 80}, 8, 0);
  return way;
}

GestureRecognizer trained(bool pauses, int rest_before) {
  std::vector<GestureSample> samples;
  for (int take = 0; take < 4; ++take) {
    for (const std::string label : {"right", "down"}) {
      const auto hands = observed(shown(label, 60 + 2 * take, pauses, rest_before));
      samples.push_back(
          {GestureFeatureComputer({}, 0).compute(Span<const HandObservation>(hands)), label, ""});
    }
  }
  GestureRecognizerOptions options;
  options.model = GestureModel::trajectory;
  return GestureRecognizer::train(samples, options);
}

struct Found {
  std::vector<std::string> kinds, labels;
  std::vector<double> times;
  std::vector<Decision> decisions;
};

Found watch(const GestureRecognizer& recognizer, const Way& way, int gone = 0) {
  GestureStreamOptions options = GestureStream::options_for(recognizer);
  GestureStream stream(recognizer, std::make_unique<OneHandStream>(), options);
  Found found;
  double time_s = 0;
  const auto keep = [&](const std::vector<GestureEvent>& events) {
    for (const GestureEvent& e : events) {
      if (e.kind != GestureEventKind::preliminary && e.kind != GestureEventKind::decision) continue;
      found.kinds.emplace_back(e.kind == GestureEventKind::decision ? "decision" : "preliminary");
      found.labels.push_back(e.decision.nbest.at(0).label);
      found.decisions.push_back(e.decision);
      found.times.push_back(time_s);
    }
  };
  const auto push = [&](const GreyImage& mask) {
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t v : mask.pixels) bgr.insert(bgr.end(), 3, v);
    keep(stream.push(
        {bgr.data(), mask.width_px, mask.height_px, 3, std::ptrdiff_t{3} * mask.width_px}, time_s));
    time_s += kPeriod_s;
  };
  for (const Place& p : way) push(p.x < 0 ? GreyImage(200, 200) : hand(2, p.x, p.y, 0.6));
  for (int i = 0; i < gone; ++i) push(GreyImage(200, 200));
  keep(stream.finish());
  return found;
}

using Names = std::vector<std::string>;

TEST(GestureStream, DecidesAsTheRecogniserDoesOnTheSegment) {
  const GestureRecognizer recognizer = trained(false, 10);
  ASSERT_TRUE(recognizer.starts_at_rest());
  ASSERT_FALSE(recognizer.pauses());
  Way way = shown("right", 60, false, 30);
  const std::size_t before = way.size();
  go(&way, way.back(), 0, 14);
  const Found found = watch(recognizer, way);
  EXPECT_EQ(found.kinds, Names{"decision"});
  EXPECT_EQ(found.labels, Names{"right"});
  // From context_s before the movement was seen to the frame in which the rest had lasted.
  double best = 0;
  for (std::size_t first = 28; first < 34; ++first) {
    for (std::size_t last = before; last <= way.size(); ++last) {
      const Decision d =
          recognizer.recognise(observed({way.begin() + static_cast<std::ptrdiff_t>(first),
                                         way.begin() + static_cast<std::ptrdiff_t>(last)}));
      if (d.score == found.decisions[0].score) best = 1;
    }
  }
  EXPECT_EQ(best, 1);
}

TEST(GestureStream, SettlesWhatMayBePartOfAGestureWhenNothingFollows) {
  const GestureRecognizer recognizer = trained(true, 10);
  ASSERT_TRUE(recognizer.pauses());
  Way way = shown("down", 60, true, 30);
  go(&way, way.back(), 0, 80);
  const Found found = watch(recognizer, way);
  // The first stroke is preliminary and never final; the second settles after max_pause_s.
  EXPECT_EQ(found.kinds, (Names{"preliminary", "preliminary", "decision"}));
  EXPECT_EQ(found.labels[1], "down");
  EXPECT_EQ(found.labels[2], "down");
  EXPECT_EQ(found.decisions[2].score, found.decisions[1].score);
  EXPECT_NEAR(found.times[2] - found.times[1], 2.5, 2 * kPeriod_s);
}

TEST(GestureStream, SettlesAtOnceWhenTheHandLeavesOrTheStreamEnds) {
  const GestureRecognizer recognizer = trained(true, 10);
  Way way = shown("right", 60, true, 30);
  go(&way, way.back(), 0, 16);
  const Found left = watch(recognizer, way, 12);
  EXPECT_EQ(left.kinds, (Names{"preliminary", "preliminary", "decision"}));
  EXPECT_LT(left.times[2] - left.times[1], 0.6);
  const Found ended = watch(recognizer, way);
  EXPECT_EQ(ended.kinds, (Names{"preliminary", "preliminary", "decision"}));
  EXPECT_EQ(ended.labels[2], "right");
}

TEST(GestureStream, AHandThatIsTakenAwayLeavesTheDecisionBehind) {
  const GestureRecognizer recognizer = trained(true, 10);
  Way way = shown("right", 60, true, 30);
  go(&way, way.back(), 0, 16);
  go(&way, {way.back().x, 250}, 8, 0);
  const Found found = watch(recognizer, way, 12);
  ASSERT_FALSE(found.kinds.empty());
  EXPECT_EQ(found.kinds.back(), "decision");
  EXPECT_EQ(found.labels.back(), "right");
}

TEST(GestureStream, ForgetsWhatAStallInterrupted) {
  const GestureRecognizer recognizer = trained(true, 10);
  GestureStream stream(recognizer, std::make_unique<OneHandStream>(),
                       GestureStream::options_for(recognizer));
  Way way = shown("right", 60, true, 30);
  double time_s = 0;
  for (const Place& p : way) {
    const GreyImage mask = hand(2, p.x, p.y, 0.6);
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t v : mask.pixels) bgr.insert(bgr.end(), 3, v);
    stream.push({bgr.data(), 200, 200, 3, 600}, time_s);
    time_s += kPeriod_s;
  }
  const auto& events = stream.interrupt();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].segment.reason, GestureSegmentReason::stalled);
  EXPECT_TRUE(stream.finish().empty());
}

// All events of what is shown from 0 s on, as text to the last digit.
std::vector<std::string> reported(GestureStream* stream, const Way& way, bool to_the_end) {
  std::vector<std::string> found;
  const auto keep = [&](const std::vector<GestureEvent>& events) {
    for (const GestureEvent& e : events) {
      std::ostringstream text;
      text.precision(17);
      text << enum_name(e.kind) << " " << enum_name(e.segment.kind) << " "
           << enum_name(e.segment.reason) << " " << e.segment.first_s << " " << e.segment.last_s
           << " " << e.segment.from_rest << " " << e.decision.label << " " << e.decision.score;
      for (const auto& entry : e.decision.nbest) text << " " << entry.label << entry.probability;
      found.push_back(text.str());
    }
  };
  double time_s = 0;
  for (const Place& p : way) {
    const GreyImage mask = p.x < 0 ? GreyImage(200, 200) : hand(2, p.x, p.y, 0.6);
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t v : mask.pixels) bgr.insert(bgr.end(), 3, v);
    keep(stream->push({bgr.data(), 200, 200, 3, 600}, time_s));
    time_s += kPeriod_s;
  }
  if (to_the_end) keep(stream->finish());
  return found;
}

// In a rest, a stroke, the pause behind it with a preliminary decision, the second stroke, the rest
// that settles, and after the hand has gone.
TEST(GestureStream, ReportsOfTheNextStreamWhatANewOneWould) {
  const GestureRecognizer recognizer = trained(true, 10);
  const auto made = [&] {
    GestureStreamOptions options = GestureStream::options_for(recognizer);
    options.partial_interval_s = 0.4;
    return GestureStream(recognizer, std::make_unique<OneHandStream>(), options);
  };
  Way before = shown("right", 70, true, 20);
  go(&before, before.back(), 0, 14);
  before.insert(before.end(), 12, {-1, -1});
  // It begins where the other one may have been, and pauses, too.
  Way next = shown("down", 60, true, 18);
  go(&next, next.back(), 0, 14);
  GestureStream fresh = made();
  const std::vector<std::string> expected = reported(&fresh, next, true);
  ASSERT_GE(expected.size(), 8U);
  for (const std::size_t size : {25U, 40U, 48U, 66U}) {
    ASSERT_LE(size, before.size());
    for (const bool interrupted : {false, true}) {
      GestureStream used = made();
      reported(&used, {before.begin(), before.begin() + static_cast<std::ptrdiff_t>(size)}, false);
      if (interrupted) {
        used.interrupt();
      } else {
        used.finish();
      }
      EXPECT_TRUE(used.finish().empty());
      EXPECT_TRUE(used.interrupt().empty());
      EXPECT_EQ(reported(&used, next, true), expected) << size << " " << interrupted;
    }
  }
}

// What follows a hand that has gone for longer than a pause is as in a new stream, but later.
TEST(GestureStream, ReportsOfTheNextHandWhatANewStreamWould) {
  const GestureRecognizer recognizer = trained(true, 10);
  Way next = shown("down", 60, true, 18);
  const Found alone = watch(recognizer, next, 12);
  const std::vector<std::string>& expected = alone.labels;
  ASSERT_FALSE(expected.empty());
  Way both = shown("right", 70, true, 20);
  go(&both, both.back(), 0, 14);
  both.insert(both.end(), 80, {-1, -1});
  both.insert(both.end(), next.begin(), next.end());
  const Found found = watch(recognizer, both, 12);
  ASSERT_GT(found.labels.size(), expected.size());
  const std::size_t more = found.labels.size() - expected.size();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(found.labels[more + i], expected[i]);
    EXPECT_EQ(found.decisions[more + i].score, alone.decisions[i].score);
  }
}

TEST(GestureStream, RefusesOptionsOutOfRange) {
  const GestureRecognizer recognizer = trained(false, 0);
  GestureStreamOptions options;
  options.max_pause_s = -1;
  EXPECT_THROW(GestureStream(recognizer, std::make_unique<OneHandStream>(), options),
               InvalidArgument);
  options = {};
  options.partial_interval_s = 0;
  EXPECT_THROW(GestureStream(recognizer, std::make_unique<OneHandStream>(), options),
               InvalidArgument);
  EXPECT_THROW(GestureStream(recognizer, nullptr, {}), InvalidArgument);
}

}  // namespace
}  // namespace hri
