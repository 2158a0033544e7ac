// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_crop.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

GreyImage rectangle(int width, int height, int left, int top, int right, int bottom) {
  GreyImage image(width, height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) image.pixels[static_cast<std::size_t>(y * width + x)] = 255;
  }
  return image;
}

TEST(HandBox, IsTheSquareAroundTheMask) {
  const HandBox wide = hand_box(rectangle(100, 100, 20, 40, 60, 60).view(), 1.6F, 0.0F);
  EXPECT_FLOAT_EQ(wide.side_px, 40);
  EXPECT_FLOAT_EQ(wide.left_px, 20);
  EXPECT_FLOAT_EQ(wide.top_px, 30);
  const HandBox high = hand_box(rectangle(100, 100, 20, 40, 40, 70).view(), 1.6F, 0.0F);
  EXPECT_FLOAT_EQ(high.side_px, 30);
  EXPECT_FLOAT_EQ(high.left_px, 15);
  EXPECT_FLOAT_EQ(high.top_px, 40);
}

TEST(HandBox, LeavesPaddingFreeOnEverySide) {
  const HandBox box = hand_box(rectangle(100, 100, 30, 30, 70, 70).view(), 1.6F, 0.25F);
  EXPECT_FLOAT_EQ(box.side_px, 60);
  EXPECT_FLOAT_EQ(box.left_px, 20);
  EXPECT_FLOAT_EQ(box.top_px, 20);
}

TEST(HandBox, CutsALongForearmAtTheBottom) {
  const HandBox box = hand_box(rectangle(200, 200, 80, 10, 120, 200).view(), 1.5F, 0.0F);
  EXPECT_FLOAT_EQ(box.top_px, 10);
  EXPECT_FLOAT_EQ(box.side_px, 60);
  EXPECT_FLOAT_EQ(box.left_px, 70);
}

TEST(HandBox, ReachesBeyondThePictureWhereTheHandTouchesIt) {
  const HandBox box = hand_box(rectangle(50, 50, 0, 0, 10, 15).view(), 1.6F, 0.1F);
  EXPECT_LT(box.left_px, 0);
  EXPECT_LT(box.top_px, 0);
}

TEST(HandBox, HasNoSideWithoutAHand) {
  EXPECT_EQ(hand_box(GreyImage(10, 10).view()).side_px, 0.0F);
  EXPECT_EQ(hand_box(ImageView{}).side_px, 0.0F);
  ImageView nowhere;
  nowhere.width_px = nowhere.height_px = 20;
  nowhere.stride_bytes = 20;
  EXPECT_EQ(hand_box(nowhere).side_px, 0.0F);
}

TEST(HandBox, TakesOnePixelAndRefusesColours) {
  EXPECT_FLOAT_EQ(hand_box(rectangle(9, 9, 4, 4, 5, 5).view(), 1.6F, 0.0F).side_px, 1);
  const GreyImage pixels(30, 10);
  EXPECT_THROW(hand_box({pixels.pixels.data(), 10, 10, 3, 30}), InvalidArgument);
}

TEST(HandBox, RefusesAnAspectOrPaddingThatMakesNoSquare) {
  const GreyImage mask = hand_testing::hand(3);
  EXPECT_THROW(hand_box(mask.view(), 0.0F), InvalidArgument);
  EXPECT_THROW(hand_box(mask.view(), std::nanf("")), InvalidArgument);
  EXPECT_THROW(hand_box(mask.view(), 1.6F, -0.6F), InvalidArgument);
}

TEST(Crop, CopiesPixelsAtTheirOwnSize) {
  GreyImage image(12, 12);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i + 50);
  MatrixF out(4, 4);
  crop(image.view(), {3, 5, 4}, out);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_NEAR(out(y, x), image.view().at(3 + x, 5 + y) / 255.0, 1e-6);
  }
}

TEST(Crop, AveragesWhatAPixelCovers) {
  GreyImage stripes(64, 64);
  for (std::size_t i = 0; i < stripes.pixels.size(); i += 2) stripes.pixels[i] = 255;
  for (const int factor : {2, 4, 8}) {
    MatrixF out(64 / factor, 64 / factor);
    crop(stripes.view(), {0, 0, 64}, out);
    for (int x = 1; x + 1 < out.cols(); ++x) EXPECT_NEAR(out(2, x), 0.5, 0.01) << factor;
  }
}

TEST(Crop, RepeatsTheBorderOutside) {
  const GreyImage image = rectangle(10, 10, 0, 0, 5, 10);
  MatrixF out(30, 30);
  crop(image.view(), {-10, -10, 30}, out);
  for (const int y : {0, 15, 29}) {
    EXPECT_FLOAT_EQ(out(y, 0), 1);
    EXPECT_FLOAT_EQ(out(y, 12), 1);
    EXPECT_FLOAT_EQ(out(y, 17), 0);
    EXPECT_FLOAT_EQ(out(y, 29), 0);
  }
}

TEST(Crop, StaysWithinZeroAndOneWhenItEnlarges) {
  const GreyImage mask = hand_testing::hand(4);
  MatrixF out(128, 128);
  crop(mask.view(), {90.3F, 88.7F, 20}, out);
  EXPECT_GE(out.minCoeff(), 0.0F);
  EXPECT_LE(out.maxCoeff(), 1.0F);
  MatrixF one(1, 1);
  crop(GreyImage(1, 1).view(), {0, 0, 1}, one);
  EXPECT_EQ(one(0, 0), 0.0F);
}

TEST(Crop, ReadsAViewWithALongerStride) {
  const GreyImage large = hand_testing::hand(3);
  GreyImage small(100, 90);
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 100; ++x)
      small.pixels[static_cast<std::size_t>(y * 100 + x)] = large.view().at(50 + x, 40 + y);
  }
  const ImageView part{large.view().row(40) + 50, 100, 90, 1, 200};
  const HandBox box = hand_box(part);
  EXPECT_EQ(box.side_px, hand_box(small.view()).side_px);
  MatrixF from_part(32, 32);
  MatrixF from_copy(32, 32);
  crop(part, box, from_part);
  crop(small.view(), box, from_copy);
  EXPECT_EQ(from_part, from_copy);
}

TEST(Crop, RefusesWhatIsNoSquareAndNoImage) {
  const GreyImage image(10, 10);
  MatrixF square(4, 4);
  MatrixF oblong(4, 5);
  MatrixF none(0, 0);
  EXPECT_THROW(crop(image.view(), {0, 0, 4}, oblong), InvalidArgument);
  EXPECT_THROW(crop(image.view(), {0, 0, 4}, none), InvalidArgument);
  EXPECT_THROW(crop(image.view(), {0, 0, 0}, square), InvalidArgument);
  EXPECT_THROW(crop(image.view(), {0, 0, -3}, square), InvalidArgument);
  const float nan = std::nanf("");
  EXPECT_THROW(crop(image.view(), {nan, 0, 4}, square), InvalidArgument);
  EXPECT_THROW(crop(image.view(), {0, -HUGE_VALF, 4}, square), InvalidArgument);
  EXPECT_THROW(crop(image.view(), {0, 0, HUGE_VALF}, square), InvalidArgument);
  EXPECT_THROW(crop({}, {0, 0, 4}, square), InvalidArgument);
  EXPECT_THROW(crop({image.pixels.data(), 3, 3, 3, 9}, {0, 0, 3}, square), InvalidArgument);
}

}  // namespace
}  // namespace hri
