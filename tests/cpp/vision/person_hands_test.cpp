// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/person_hands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr int kHandSide = 40;
const Face kFace{140, 60, 32};

struct Colour {
  double b, g, r;
};
constexpr Colour kWall{170, 185, 190};
constexpr Colour kWood{60, 100, 165};
constexpr Colour kSkin{125, 150, 200};
constexpr Colour kShirt{40, 35, 35};
constexpr Colour kHair{25, 30, 35};

struct Corner {
  int x, y;
};

// A person in a dark shirt before a beige wall, beside wood, with hands at these places.
struct Room {
  std::vector<std::uint8_t> bgr;
  GreyImage hands{kWidth, kHeight};

  explicit Room(const std::vector<Corner>& corners, bool wood = true) {
    const GreyImage shape = hand_testing::hand(5, 20, 26, 0.33);
    for (const Corner& corner : corners) {
      for (int y = 0; y < kHandSide; ++y) {
        for (int x = 0; x < kHandSide; ++x) {
          if (shape.view().at(x, y) != 0)
            hands.pixels[static_cast<std::size_t>((corner.y + y) * kWidth + corner.x + x)] = 255;
        }
      }
    }
    Random random(4);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Colour c = colour_at(x, y, wood);
        for (const double v : {c.b, c.g, c.r})
          bgr.push_back(static_cast<std::uint8_t>(std::clamp(v + 2 * random.normal(), 0.0, 255.0)));
      }
    }
  }

  [[nodiscard]] Colour colour_at(int x, int y, bool wood) const {
    if (hands.view().at(x, y) != 0) return kSkin;
    if (std::hypot((x - 156) / 15.0, (y - 78) / 19.0) < 1) return kSkin;
    if (std::hypot((x - 156) / 18.0, (y - 70) / 20.0) < 1) return kHair;
    if (std::abs(x - 156) < 45 && y > 98) return kShirt;
    return wood && x > 240 && y > 90 ? kWood : kWall;
  }

  [[nodiscard]] ImageView view() const { return {bgr.data(), kWidth, kHeight, 3, 3 * kWidth}; }
};

double shared(const GreyImage& found, const GreyImage& truth) {
  double both = 0;
  double any = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    both += found.pixels[i] != 0 && truth.pixels[i] != 0 ? 1 : 0;
    any += found.pixels[i] != 0 || truth.pixels[i] != 0 ? 1 : 0;
  }
  return both / any;
}

int count(const GreyImage& mask) {
  return static_cast<int>(
      std::count_if(mask.pixels.begin(), mask.pixels.end(), [](auto v) { return v != 0; }));
}

TEST(PersonHands, FindsTheHandAndNotFaceOrWood) {
  const Room room({{70, 80}});
  const HandObservation found = PersonHands().extract(room.view(), kFace);
  ASSERT_EQ(found.mask.width_px, kWidth);
  EXPECT_GT(shared(found.mask, room.hands), 0.75);
  EXPECT_GT(found.quality, 0.5);
  EXPECT_LE(found.quality, 1);
}

TEST(PersonHands, FindsBothHandsOrTheOneThatSigns) {
  const Room room({{70, 80}, {190, 160}});
  PersonOptions options;
  options.max_hands = 2;
  EXPECT_GT(shared(PersonHands(options).extract(room.view(), kFace).mask, room.hands), 0.75);
  const GreyImage upper = PersonHands().extract(room.view(), kFace).mask;
  EXPECT_GT(shared(upper, Room({{70, 80}}).hands), 0.75);
}

TEST(PersonHands, TakesAHangingHandWhereThereIsNoOther) {
  const Room room({{190, 160}});  // 3.8 sides of the face away
  EXPECT_GT(shared(PersonHands().extract(room.view(), kFace).mask, room.hands), 0.75);
  PersonOptions options;
  options.reach = options.signing_reach = 2;
  EXPECT_EQ(count(PersonHands(options).extract(room.view(), kFace).mask), 0);
}

TEST(PersonHands, FindsNothingWithoutAHand) {
  const HandObservation found = PersonHands().extract(Room({}).view(), kFace);
  EXPECT_EQ(count(found.mask), 0);
  EXPECT_EQ(found.quality, 0);
}

TEST(PersonHands, ScalesPicturesWithLargeFacesDown) {
  const Room room({{70, 80}});
  PersonOptions options;
  options.face_side_px = 16;
  const HandObservation found = PersonHands(options).extract(room.view(), kFace);
  EXPECT_EQ(found.mask.width_px, kWidth / 2);
  EXPECT_EQ(found.grey.height_px, kHeight / 2);
  EXPECT_NEAR(4.0 * count(found.mask) / count(room.hands), 1, 0.45);  // fingers are 2 pixels wide
}

TEST(PersonHands, StandsFacesThatFillThePictureOrAreAFewPixels) {
  const Room room({{70, 80}});
  for (const Face& face : {Face{0, 0, 239}, Face{-4000, -4000, 8200}, Face{150, 70, 1}})
    EXPECT_EQ(PersonHands().extract(room.view(), face).grey.pixels.empty(), false);
}

TEST(PersonHands, RefusesBadInput) {
  const Room room({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Face& face : {Face{0, 0, 0}, Face{0, 0, nan}, Face{nan, 0, 20}, Face{-30, 0, 20},
                           Face{0, 235, 20}, Face{0, 0, std::numeric_limits<double>::infinity()}})
    EXPECT_THROW(PersonHands().extract(room.view(), face), InvalidArgument);
  EXPECT_THROW(PersonHands().extract({}, kFace), InvalidArgument);
  EXPECT_THROW(PersonHands().extract(room.hands.view(), kFace), InvalidArgument);
  PersonOptions options;
  options.min_area = 3;
  EXPECT_THROW(PersonHands{options}, InvalidArgument);
}

TEST(FaceFinder, RefusesWhatIsNoCascade) {
  EXPECT_THROW(FaceFinder("/nonexistent/cascade.xml"), IoError);
  const TestFolder folder;
  for (const char* text :
       {"<?xml version=\"1.0\"?><opencv_storage><other/></opencv_storage>", "not XML"}) {
    EXPECT_THROW(FaceFinder{folder.write("cascade.xml", text)}, FormatError);
  }
}

}  // namespace
}  // namespace hri
