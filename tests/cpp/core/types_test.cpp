// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/types.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>
#include <type_traits>

#include "hri/core/image_view.hpp"
#include "hri/core/version.hpp"

namespace hri {
namespace {

double sum(Span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// What converts and what must not: a read-only span never becomes writable.
static_assert(std::is_convertible_v<Span<float>, Span<const float>>);
static_assert(!std::is_convertible_v<Span<const float>, Span<float>>);
static_assert(!std::is_convertible_v<Span<float>, Span<double>>);
static_assert(std::is_convertible_v<const std::vector<float>&, Span<const float>>);
static_assert(!std::is_convertible_v<const std::vector<float>&, Span<float>>);
static_assert(!std::is_convertible_v<std::vector<float>&, Span<double>>);
static_assert(std::is_trivially_copyable_v<Span<float>>);

TEST(Span, OfNothingIsEmptyAndCanBeWalked) {
  EXPECT_EQ(sum({}), 0);
  const std::vector<double> none;
  EXPECT_TRUE(Span<const double>(none).empty());
  EXPECT_EQ(Span<double>().data(), nullptr);
}

TEST(Span, ReachesThePartItWasMadeOf) {
  std::array<double, 5> values{1, 2, 3, 4, 5};
  const Span<double> all(values.data(), values.size());
  EXPECT_EQ(sum(all.subspan(1, 3)), 9);
  EXPECT_EQ(sum(all.subspan(5, 0)), 0);
  for (double& v : all.subspan(3, 2)) v = 0;
  EXPECT_EQ(sum(all), 6);
  EXPECT_EQ(&all[2], &values[2]);
}

TEST(RowSpan, FollowsTheStrideOfAPartOfAMatrix) {
  MatrixF m(4, 6);
  std::iota(m.data(), m.data() + m.size(), 0.0F);
  const ConstMatrixRefF part = m.block(1, 2, 3, 3);  // no copy: rows stay contiguous
  EXPECT_EQ(part.data(), &m(1, 2));
  const Span<const float> row = row_span(part, 2);
  EXPECT_EQ(std::vector<float>(row.begin(), row.end()), (std::vector<float>{20, 21, 22}));
  const Span<const float> whole = row_span(m, 0);
  EXPECT_EQ(whole.size(), 6U);
  EXPECT_EQ(whole[5], 5);
}

TEST(MatrixRef, WritesIntoTheCallersMatrix) {
  MatrixF m = MatrixF::Zero(3, 2);
  const auto fill = [](MatrixRefF out) { out.row(1).setConstant(7); };
  fill(m);
  EXPECT_EQ(m.data()[2], 7);
  EXPECT_EQ(m.data()[3], 7);
  EXPECT_EQ(m.sum(), 14);
}

TEST(ImageView, WithoutAnySideIsEmpty) {
  const std::uint8_t pixel = 9;
  EXPECT_TRUE((ImageView{nullptr, 1, 1, 1, 1}).empty());
  EXPECT_TRUE((ImageView{&pixel, 0, 1, 1, 1}).empty());
  EXPECT_TRUE((ImageView{&pixel, 1, -1, 1, 1}).empty());
  EXPECT_EQ((ImageView{&pixel, 1, 1, 1, 1}).at(0, 0), 9);
}

// Rows may stand in memory from the bottom up, as some cameras give them.
TEST(ImageView, ReadsUpsideDownByANegativeStride) {
  const std::vector<std::uint8_t> pixels{1, 2, 3, 4, 5, 6};
  const ImageView view{pixels.data() + 4, 2, 3, 1, -2};
  EXPECT_EQ(view.at(0, 0), 5);
  EXPECT_EQ(view.at(1, 2), 2);
}

TEST(Version, IsItsThreeParts) {
  EXPECT_EQ(std::string(HRI_VERSION), std::to_string(HRI_VERSION_MAJOR) + "." +
                                          std::to_string(HRI_VERSION_MINOR) + "." +
                                          std::to_string(HRI_VERSION_PATCH));
}

TEST(GreyImage, ViewsItsOwnPixels) {
  GreyImage image(3, 2);
  image.pixels[4] = 255;
  const ImageView view = image.view();
  EXPECT_EQ(view.at(1, 1), 255);
  EXPECT_EQ(view.stride_bytes, 3);
  EXPECT_EQ(view.channels, 1);
  EXPECT_TRUE(GreyImage().view().empty());
}

}  // namespace
}  // namespace hri
