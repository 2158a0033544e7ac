// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_segmenter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr double kStep_s = 1.0 / 20;

// A square at a column; none below 0.
GreyImage mask_at(int column) {
  GreyImage mask(40, 40);
  for (int y = 10; column >= 0 && y < 20; ++y) {
    for (int x = column; x < column + 10; ++x)
      mask.pixels[static_cast<std::size_t>(40 * y + x)] = 255;
  }
  return mask;
}

using Places = std::vector<int>;

Places operator+(Places a, const Places& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Places operator*(const Places& a, int times) {
  Places result;
  for (int i = 0; i < times; ++i) result = std::move(result) + a;
  return result;
}

const Places kMoving = {0, 5, 10, 15, 20, 15, 10, 5};
const Places kStill = Places(20, 5);
const Places kGone = Places(10, -1);

std::string name(const GestureSegment& s) {
  constexpr const char* kKinds[] = {"", "start", "end", "dropped"};
  constexpr const char* kReasons[] = {"",       " rested",  " left",   " cut",
                                      " ended", " arrived", " stalled"};
  return std::string(kKinds[static_cast<int>(s.kind)]) + kReasons[static_cast<int>(s.reason)];
}

std::vector<std::string> events(const Places& places, const GestureSegmenterOptions& options = {}) {
  GestureSegmenter segmenter(options);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GreyImage mask = mask_at(places[i]);
    const GestureSegment s = segmenter.push(mask.view(), kStep_s * static_cast<double>(i));
    if (s.kind != GestureSegmentKind::none) found.push_back(name(s));
  }
  const GestureSegment last = segmenter.finish();
  if (last.kind != GestureSegmentKind::none) found.push_back(name(last));
  return found;
}

using Names = std::vector<std::string>;

TEST(GestureSegmenter, FindsGesturesBetweenRestsAndAbsences) {
  EXPECT_EQ(events(kMoving * 2 + kGone), (Names{"start", "end left"}));
  EXPECT_EQ(events(Places{0, 5, 10, 15} + kGone), (Names{"start", "dropped left"}));
  EXPECT_EQ(events(kMoving + kStill + kGone), (Names{"start", "end rested"}));
  EXPECT_EQ(events(kMoving * 2), (Names{"start", "end ended"}));
  EXPECT_EQ(events(kMoving + kStill + kMoving * 4 + kGone),
            (Names{"start", "end rested", "start", "end left"}));
}

TEST(GestureSegmenter, DropsAHandThatIsTakenAwayOrOnlyArrives) {
  EXPECT_EQ(events(kMoving + kStill + kMoving + kGone),
            (Names{"start", "end rested", "start", "dropped left"}));
  GestureSegmenterOptions options;
  options.arrivals = false;
  EXPECT_EQ(events(kMoving + kStill + kMoving * 2, options),
            (Names{"start", "dropped arrived", "start", "end ended"}));
  EXPECT_EQ(events(kMoving + kStill + kMoving * 2 + kStill, options),
            (Names{"start", "dropped arrived", "start", "end rested"}));
  // What ends in a rest is not too short.
  options = {};
  options.min_gesture_s = 3;
  EXPECT_EQ(events(kMoving + kStill + kMoving, options),
            (Names{"start", "end rested", "start", "dropped ended"}));
}

TEST(GestureSegmenter, CutsWhatGoesOnForTooLongUntilTheHandRests) {
  GestureSegmenterOptions options;
  options.max_gesture_s = 1.0;
  EXPECT_EQ(events(kMoving * 8, options), (Names{"start", "end cut"}));
  EXPECT_EQ(events(kMoving * 4 + kStill + kMoving * 2, options),
            (Names{"start", "end cut", "start", "end ended"}));
}

TEST(GestureSegmenter, NothingMayHaveBegunAfterACutBeforeTheHandRests) {
  GestureSegmenterOptions options;
  options.max_gesture_s = 1.0;
  GestureSegmenter segmenter(options);
  double time_s = 0;
  const auto push = [&](int column) {
    time_s += kStep_s;
    return segmenter.push(mask_at(column).view(), time_s);
  };
  bool cut = false;
  for (const int column : kMoving * 8) {
    cut = push(column).reason == GestureSegmentReason::cut || cut;
    EXPECT_EQ(segmenter.may_have_begun_s().has_value(), !cut);
  }
  EXPECT_TRUE(cut);
  for (const int column : kStill) push(column);
  EXPECT_FALSE(segmenter.may_have_begun_s().has_value());
  push(25);
  EXPECT_DOUBLE_EQ(segmenter.may_have_begun_s().value_or(-1), time_s);
}

TEST(GestureSegmenter, SaysWhenAGestureBeganAndWhetherFromRest) {
  GestureSegmenter segmenter({});
  std::vector<GestureSegment> starts;
  const Places places = kGone + kMoving + kStill + kMoving;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GestureSegment s =
        segmenter.push(mask_at(places[i]).view(), kStep_s * static_cast<double>(i));
    if (s.kind == GestureSegmentKind::start) starts.push_back(s);
  }
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_FALSE(starts[0].from_rest);
  EXPECT_DOUBLE_EQ(starts[0].first_s, kStep_s * 10);
  EXPECT_TRUE(starts[1].from_rest);
  EXPECT_TRUE(segmenter.in_gesture());
  const GestureSegment stalled = segmenter.interrupt();
  EXPECT_EQ(name(stalled), "dropped stalled");
  EXPECT_TRUE(segmenter.hand_away());
}

TEST(GestureSegmenter, AnotherLookOfTheHandIsNoMovement) {
  GestureSegmenter segmenter({});
  int index = 0;
  const auto push = [&](int column) {
    return segmenter.push(mask_at(column).view(), kStep_s * index++);
  };
  while (segmenter.may_have_begun_s() || index < 30) {
    if (push(5).kind == GestureSegmentKind::end) break;
  }
  for (int i = 0; i < 20; ++i) push(5);
  segmenter.replace_outlines(mask_at(25).view());
  for (int i = 0; i < 20; ++i) EXPECT_EQ(push(25).kind, GestureSegmentKind::none);
  push(5);
  push(5);
  EXPECT_EQ(push(5).kind, GestureSegmentKind::start);
}

// Dyadic, so that times that are shifted by whole seconds differ by these exactly.
constexpr double kReplay_s = 1.0 / 16;

// Hands that come, rest, move and go, at random.
Places wandering(std::uint64_t seed, std::size_t size) {
  Random random(seed);
  Places places;
  while (places.size() < size) {
    const auto place = static_cast<int>(random.below(30));
    switch (random.below(4)) {
      case 0:
        places = std::move(places) + Places(random.below(16), -1);
        break;
      case 1:
        places = std::move(places) + Places(random.below(16), place);
        break;
      default:
        places = std::move(places) + kMoving * (1 + static_cast<int>(random.below(3)));
    }
  }
  places.resize(size);
  return places;
}

// Whether both say the same of the same masks, from different times on.
void expect_same(GestureSegmenter* used, double used_s, const Places& places,
                 const std::string& where) {
  GestureSegmenter fresh(used->options());
  EXPECT_FALSE(used->in_gesture()) << where;
  EXPECT_TRUE(used->hand_away()) << where;
  EXPECT_FALSE(used->may_have_begun_s().has_value()) << where;
  const auto expect_equal = [&](const GestureSegment& a, const GestureSegment& b) {
    ASSERT_EQ(name(a), name(b)) << where;
    if (b.kind == GestureSegmentKind::none) return;
    EXPECT_EQ(a.first_s - used_s, b.first_s) << where;
    EXPECT_EQ(a.last_s - used_s, b.last_s) << where;
    EXPECT_EQ(a.from_rest, b.from_rest) << where;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GreyImage mask = mask_at(places[i]);
    const double time_s = kReplay_s * static_cast<double>(i);
    const GestureSegment found = used->push(mask.view(), used_s + time_s);
    expect_equal(found, fresh.push(mask.view(), time_s));
    ASSERT_EQ(used->in_gesture(), fresh.in_gesture()) << where << " " << i;
    ASSERT_EQ(used->hand_away(), fresh.hand_away()) << where << " " << i;
    ASSERT_EQ(used->may_have_begun_s().value_or(used_s - 1) - used_s,
              fresh.may_have_begun_s().value_or(-1))
        << where << " " << i;
  }
  expect_equal(used->finish(), fresh.finish());
}

GestureSegmenterOptions short_gestures(bool arrivals) {
  GestureSegmenterOptions options;
  options.max_gesture_s = 1.5;
  options.arrivals = arrivals;
  return options;
}

TEST(GestureSegmenter, IsAsNewAfterTheEndOfAStream) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Places before = wandering(seed, 20 + 3 * seed);
    for (const bool interrupted : {false, true}) {
      GestureSegmenter used(short_gestures(seed % 2 == 0));
      for (std::size_t i = 0; i < before.size(); ++i)
        used.push(mask_at(before[i]).view(), 100 + kReplay_s * static_cast<double>(i));
      if (interrupted) {
        used.interrupt();
      } else {
        used.finish();
      }
      // The next one may begin at any time.
      expect_same(&used, seed % 3 == 0 ? 0 : 200, wandering(seed + 1000, 150),
                  std::to_string(seed) + (interrupted ? " interrupted" : " finished"));
    }
  }
}

// From a gesture, a rest, and what goes on after a cut.
TEST(GestureSegmenter, IsAsNewOnceTheHandHasLeft) {
  int num_left = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    GestureSegmenter used(short_gestures(seed % 2 == 0));
    double time_s = 0;
    const auto push = [&](int column) {
      used.push(mask_at(column).view(), time_s);
      time_s += kReplay_s;
    };
    for (const int column : wandering(seed, 20 + seed)) push(column);
    if (used.hand_away()) continue;
    ++num_left;
    while (!used.hand_away()) push(-1);
    for (int i = 0; i < 8; ++i) push(-1);
    expect_same(&used, std::ceil(time_s), wandering(seed + 1000, 150), std::to_string(seed));
  }
  EXPECT_GT(num_left, 20);
}

// Nor is it compared with how it looked before.
TEST(GestureSegmenter, IsAsNewWhereTheHandComesBackToItsPlace) {
  for (const Places& before : {kStill, kMoving + Places(6, 5)}) {
    GestureSegmenter used({});
    double time_s = 0;
    for (const int column : before + Places(10, -1)) {
      used.push(mask_at(column).view(), time_s);
      time_s += kReplay_s;
    }
    expect_same(&used, std::ceil(time_s), kStill + kMoving + kGone, std::to_string(before.size()));
  }
}

TEST(GestureSegmenter, SaysWhatItInterruptsAndFinishes) {
  for (const bool interrupted : {false, true}) {
    GestureSegmenter segmenter({});
    double time_s = 3;
    for (const int column : kStill + kMoving + kMoving) {
      time_s += kReplay_s;
      segmenter.push(mask_at(column).view(), time_s);
    }
    const double last_s = time_s;
    segmenter.push(mask_at(-1).view(), time_s + kReplay_s);
    ASSERT_TRUE(segmenter.in_gesture());
    const double first_s = segmenter.may_have_begun_s().value_or(-1);
    const GestureSegment found = interrupted ? segmenter.interrupt() : segmenter.finish();
    EXPECT_EQ(name(found), interrupted ? "dropped stalled" : "end ended");
    EXPECT_EQ(found.first_s, first_s);
    EXPECT_EQ(found.last_s,
              interrupted ? last_s + kReplay_s : last_s);  // the hand was seen till then
    EXPECT_TRUE(found.from_rest);
    EXPECT_EQ(name(segmenter.interrupt()), "");
    EXPECT_EQ(name(segmenter.finish()), "");
  }
}

// Every time of the options: not a frame before it, and in the frame in which it is over.
TEST(GestureSegmenter, KeepsToItsTimesToTheFrame) {
  GestureSegmenterOptions options;
  options.appear_s = 2 * kReplay_s;
  options.leave_s = 3 * kReplay_s;
  options.rest_s = 5 * kReplay_s;
  options.compare_s = kReplay_s;
  options.min_gesture_s = 6 * kReplay_s;
  options.max_gesture_s = 20 * kReplay_s;
  options.take_away_s = 9 * kReplay_s;
  // The frames of the events, and what they are.
  const auto reported = [&](const Places& places) {
    GestureSegmenter segmenter(options);
    std::vector<std::pair<int, std::string>> found;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const GestureSegment s =
          segmenter.push(mask_at(places[i]).view(), kReplay_s * static_cast<double>(i));
      if (s.kind != GestureSegmentKind::none) found.emplace_back(static_cast<int>(i), name(s));
    }
    return found;
  };
  using Events = std::vector<std::pair<int, std::string>>;
  const Places moving = kMoving * 5;
  const auto first = [&](int count) { return Places(moving.begin(), moving.begin() + count); };
  EXPECT_EQ(reported(first(2) + kGone), Events{});
  EXPECT_EQ(reported(first(6) + kGone),
            (Events{{2, "start"}, {8, "dropped left"}}));  // 5 frames long
  EXPECT_EQ(reported(first(7) + kGone), (Events{{2, "start"}, {9, "end left"}}));
  EXPECT_EQ(reported(moving), (Events{{2, "start"}, {20, "end cut"}}));
  // It stands still from the frame after it arrived on.
  const Places rested = first(8) + Places(7, 25);
  EXPECT_EQ(reported(rested), (Events{{2, "start"}, {14, "end rested"}}));
  EXPECT_EQ(reported(first(8) + Places(6, 25)), (Events{{2, "start"}}));
  const auto next = [&](int count) { return reported(rested + first(count) + kGone); };
  EXPECT_EQ(next(2), (Events{{2, "start"}, {14, "end rested"}}));
  EXPECT_EQ(next(9),
            (Events{{2, "start"}, {14, "end rested"}, {17, "start"}, {26, "dropped left"}}));
  EXPECT_EQ(next(10), (Events{{2, "start"}, {14, "end rested"}, {17, "start"}, {27, "end left"}}));
  // What was seen, moved or rested for too short a time does not count towards the next one.
  const Places gap{-1};
  EXPECT_EQ(reported(first(2) + gap + first(4)), (Events{{5, "start"}}));
  EXPECT_EQ(reported(rested + Places{20, 20, 25, 20, 15}),
            (Events{{2, "start"}, {14, "end rested"}, {19, "start"}}));
  const auto after_cut = [&](int still) {
    return reported(first(21) + Places(static_cast<std::size_t>(still), 20) + first(4)).size();
  };
  EXPECT_EQ(after_cut(5), 2U);
  EXPECT_EQ(after_cut(6), 3U);
}

// A square of 10 columns that goes on by one differs from the one before in 20 of 110 pixels, by
// two in 40 of 120.
TEST(GestureSegmenter, TakesForStillWhatChangesByLessThanStillChange) {
  const auto rests = [](int step, double still_change) {
    GestureSegmenterOptions options;
    options.compare_s = kReplay_s;
    options.still_change = still_change;
    Places places;
    for (int i = 0; i < 14; ++i) places.push_back(step * i);
    GestureSegmenter segmenter(options);
    bool rested = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      rested |=
          segmenter.push(mask_at(places[i]).view(), kReplay_s * static_cast<double>(i)).reason ==
          GestureSegmentReason::rested;
    }
    return rested;
  };
  EXPECT_TRUE(rests(1, 20.0 / 110 + 1e-9));
  EXPECT_FALSE(rests(1, 20.0 / 110));
  EXPECT_TRUE(rests(2, 40.0 / 120 + 1e-9));
  EXPECT_FALSE(rests(2, 40.0 / 120));
}

TEST(GestureSegmenter, RefusesBadMasksTimesAndOptions) {
  GestureSegmenter segmenter({});
  segmenter.push(mask_at(3).view(), 1.0);
  EXPECT_NO_THROW(segmenter.push(mask_at(3).view(), 1.0));
  EXPECT_THROW(segmenter.push(mask_at(3).view(), 0.9), InvalidArgument);
  EXPECT_THROW(segmenter.push(mask_at(3).view(), std::nan("")), InvalidArgument);
  EXPECT_THROW(segmenter.push(ImageView{}, 2.0), InvalidArgument);
  GestureSegmenterOptions options;
  options.still_change = 1;
  EXPECT_THROW(GestureSegmenter{options}, InvalidArgument);
  options = {};
  options.rest_s = 0;
  EXPECT_THROW(GestureSegmenter{options}, InvalidArgument);
  options = {};
  for (const double max_gesture_s : {0.2, options.min_gesture_s}) {
    options.max_gesture_s = max_gesture_s;
    EXPECT_THROW(GestureSegmenter{options}, InvalidArgument);
  }
}

}  // namespace
}  // namespace hri
