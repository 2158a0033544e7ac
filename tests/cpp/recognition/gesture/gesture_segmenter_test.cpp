// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_segmenter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hri/core/error.hpp"

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

TEST(GestureSegmenter, RefusesBadMasksTimesAndOptions) {
  GestureSegmenter segmenter({});
  segmenter.push(mask_at(3).view(), 1.0);
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
  options.max_gesture_s = 0.2;
  EXPECT_THROW(GestureSegmenter{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
