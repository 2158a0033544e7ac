// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/silhouette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using hand_testing::hand;

struct Picture {
  int width = 200;
  int height = 200;
  std::vector<std::uint8_t> bgr;

  [[nodiscard]] ImageView view() const { return {bgr.data(), width, height, 3, 3 * width}; }
};

struct Colour {
  double b, g, r;
};
constexpr Colour kWall{165, 160, 150};
constexpr Colour kSkin{110, 135, 195};
constexpr Colour kShirt{150, 60, 30};

// A picture whose pixels are `colour_at(x, y)`, in light of the given strength, with camera noise.
Picture photograph(const std::function<Colour(int, int)>& colour_at, double light = 1,
                   double noise = 2) {
  Random random(9);
  Picture p;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const Colour c = colour_at(x, y);
      for (const double v : {c.b, c.g, c.r}) {
        p.bgr.push_back(
            static_cast<std::uint8_t>(std::clamp(light * v + noise * random.normal(), 0.0, 255.0)));
      }
    }
  }
  return p;
}

Colour hand_on_wall(const GreyImage& mask, int x, int y) {
  return mask.view().at(x, y) != 0 ? kSkin : kWall;
}

double overlap(const GreyImage& found, const GreyImage& truth) {
  double both = 0;
  double any = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    both += found.pixels[i] != 0 && truth.pixels[i] != 0 ? 1 : 0;
    any += found.pixels[i] != 0 || truth.pixels[i] != 0 ? 1 : 0;
  }
  return any > 0 ? both / any : 0;
}

TEST(Silhouette, FindsTheHandInStrongAndWeakLight) {
  const GreyImage truth = hand(4);
  for (const double light : {1.2, 1.0, 0.5, 0.3, 0.15}) {
    const Picture p = photograph([&](int x, int y) { return hand_on_wall(truth, x, y); }, light);
    const HandObservation s = SilhouetteExtractor({}).extract(p.view());
    EXPECT_GT(overlap(s.mask, truth), 0.9) << light;
    EXPECT_GT(s.quality, 0.5);
  }
}

TEST(Silhouette, FindsTheHandThatReachesTheBorder) {
  GreyImage truth = hand(3);
  for (int y = 120; y < 200; ++y) {
    for (int x = 85; x < 115; ++x) truth.pixels[static_cast<std::size_t>(y * 200 + x)] = 255;
  }
  const Picture p = photograph([&](int x, int y) { return hand_on_wall(truth, x, y); });
  EXPECT_GT(overlap(SilhouetteExtractor({}).extract(p.view()).mask, truth), 0.9);
}

TEST(Silhouette, LeavesTheFaceOut) {
  const GreyImage truth = hand(3, 60, 130, 0.7);
  const auto colour_at = [&](int x, int y) {
    const double u = (x - 145) / 26.0;
    const double v = (y - 70) / 36.0;
    const bool eye = std::abs(y - 62) < 5 && (std::abs(x - 135) < 6 || std::abs(x - 155) < 6);
    return u * u + v * v < 1 && !eye ? kSkin : hand_on_wall(truth, x, y);
  };
  const Picture p = photograph(colour_at);
  EXPECT_GT(overlap(SilhouetteExtractor({}).extract(p.view()).mask, truth), 0.9);
  SilhouetteOptions options;
  options.remove_face = false;
  EXPECT_LT(overlap(SilhouetteExtractor(options).extract(p.view()).mask, truth), 0.1);
}

TEST(Silhouette, IsNotMisledByAShirt) {
  const GreyImage truth = hand(5, 100, 80, 0.8);
  const Picture p =
      photograph([&](int x, int y) { return y > 130 ? kShirt : hand_on_wall(truth, x, y); });
  const HandObservation s = SilhouetteExtractor({}).extract(p.view());
  EXPECT_GT(overlap(s.mask, truth), 0.85);
}

TEST(Silhouette, IsEmptyWithoutAHand) {
  const HandObservation s =
      SilhouetteExtractor({}).extract(photograph([](int, int) { return kWall; }).view());
  EXPECT_EQ(s.quality, 0.0);
  EXPECT_TRUE(
      std::all_of(s.mask.pixels.begin(), s.mask.pixels.end(), [](auto v) { return v == 0; }));
  EXPECT_EQ(s.mask.width_px, s.grey.width_px);
}

TEST(Silhouette, DoesNotTakeCameraNoiseForAHand) {
  for (const double light : {1.0, 0.3, 0.1}) {
    for (const double noise : {1.0, 2.0, 4.0}) {
      const Picture p = photograph([](int, int) { return kWall; }, light, noise);
      EXPECT_EQ(SilhouetteExtractor({}).extract(p.view()).quality, 0.0) << light << ", " << noise;
    }
  }
}

TEST(Silhouette, TakesPicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {1000, 20}, {640, 480}}) {
    Picture p;
    p.width = width;
    p.height = height;
    p.bgr.assign(static_cast<std::size_t>(3 * width * height), 100);
    const HandObservation s = SilhouetteExtractor({}).extract(p.view());
    EXPECT_LE(std::max(s.mask.width_px, s.mask.height_px), 320);
    EXPECT_GE(std::min(s.mask.width_px, s.mask.height_px), 1);
  }
}

TEST(Silhouette, EveryMethodWorksWhereItMay) {
  const GreyImage truth = hand(4);
  const Picture lit = photograph([&](int x, int y) { return hand_on_wall(truth, x, y); });
  SilhouetteOptions options;
  for (const auto method : {SilhouetteMethod::hsv_narrow, SilhouetteMethod::hsv_wide}) {
    options.method = method;
    EXPECT_GT(overlap(SilhouetteExtractor(options).extract(lit.view()).mask, truth), 0.85);
  }
  options.method = SilhouetteMethod::grey_otsu;
  const Picture dark = photograph([&](int x, int y) {
    return truth.view().at(x, y) != 0 ? Colour{40, 40, 40} : Colour{220, 220, 220};
  });
  EXPECT_GT(overlap(SilhouetteExtractor(options).extract(dark.view()).mask, truth), 0.85);
}

TEST(Silhouette, NamesTheOptionThatDoesNotFit) {
  const auto refused = [](auto change) {
    SilhouetteOptions options;
    change(options);
    EXPECT_THROW(SilhouetteExtractor{options}, InvalidArgument);
  };
  refused([](auto& o) { o.blur_px = 4; });
  refused([](auto& o) { o.max_side_px = 1; });
  refused([](auto& o) { o.min_area = 0.9; });
  refused([](auto& o) { o.min_contrast = -1; });
  refused([](auto& o) { o.min_contrast = 9; });
  refused([](auto& o) { o.min_quality = 2; });
  const GreyImage grey(10, 10);
  EXPECT_THROW((void)SilhouetteExtractor({}).extract(grey.view()), InvalidArgument);
  EXPECT_THROW((void)SilhouetteExtractor({}).extract({}), InvalidArgument);
}

// A wooden board that is larger than the hand and looks like skin: only a picture of the place
// without the hand separates them.
TEST(SilhouetteExtractor, LeavesOutWhatTheBackgroundHasAlready) {
  const GreyImage mask = hand(5, 70, 115, 0.8);
  const auto board = [](int x, int y) { return x >= 140 && x < 190 && y >= 10 && y < 190; };
  const Picture place = photograph([&](int x, int y) { return board(x, y) ? kSkin : kWall; });
  const Picture picture = photograph(
      [&](int x, int y) { return board(x, y) ? kSkin : hand_on_wall(mask, x, y); }, 1, 3);
  for (const auto method : {SilhouetteMethod::chroma_otsu, SilhouetteMethod::hsv_wide}) {
    SilhouetteOptions options;
    options.method = method;
    options.remove_face = false;
    EXPECT_LT(overlap(SilhouetteExtractor(options).extract(picture.view()).mask, mask), 0.1);
    const SilhouetteExtractor extractor(options, place.view());
    EXPECT_GT(overlap(extractor.extract(picture.view()).mask, mask), 0.9);
    const HandObservation empty = extractor.extract(place.view());
    EXPECT_TRUE(std::all_of(empty.mask.pixels.begin(), empty.mask.pixels.end(),
                            [](std::uint8_t v) { return v == 0; }));
    EXPECT_EQ(empty.quality, 0);
  }
}

TEST(SilhouetteExtractor, RefusesABackgroundThatDoesNotFit) {
  const Picture picture = photograph([](int, int) { return kWall; });
  EXPECT_THROW(SilhouetteExtractor({}, ImageView{}), InvalidArgument);
  const ImageView half{picture.bgr.data(), 200, 100, 3, 600};
  const SilhouetteExtractor extractor({}, half);
  try {
    static_cast<void>(extractor.extract(picture.view()));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "picture is 200 x 200 pixels, the background 200 x 100");
  }
}

}  // namespace
}  // namespace hri
