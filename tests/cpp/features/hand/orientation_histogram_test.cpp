// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/orientation_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using detail::kPi;

using testing_data::argmax;

OrientationHistogramOptions grid(int num_cells, int num_bins) {
  OrientationHistogramOptions options;
  options.num_cells = num_cells;
  options.num_bins = num_bins;
  return options;
}

VectorF histogram(const MatrixF& image, const OrientationHistogramOptions& options) {
  VectorF out = VectorF::Constant(orientation_histogram_size(options), testing_data::kNan);
  orientation_histogram(image, options, {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

// Brightness that rises by `slope` a pixel towards `angle_deg` (x to the right, y down).
MatrixF ramp(double angle_deg, double slope = 1, int size = 32) {
  MatrixF image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double angle = angle_deg * kPi / 180;
      image(y, x) = static_cast<float>(slope * (x * std::cos(angle) + y * std::sin(angle)));
    }
  }
  return image;
}

// Soft stripes and spots in 0..1, without any symmetry.
MatrixF picture(int size = 64) {
  MatrixF image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = x * 64.0 / size;
      const double v = y * 64.0 / size;
      image(y, x) = static_cast<float>(0.5 + 0.25 * std::sin(0.31 * u + 0.12 * v) +
                                       0.25 * std::cos(0.17 * u - 0.4 * v + 0.002 * u * v));
    }
  }
  return image;
}

TEST(OrientationHistogram, HasTheDocumentedSize) {
  EXPECT_EQ(orientation_histogram_size({}), 7 * 7 * 4 * 9);
  EXPECT_EQ(orientation_histogram_size(grid(1, 36)), 36);
  EXPECT_EQ(orientation_histogram_size(grid(2, 5)), 20);
}

TEST(OrientationHistogram, PutsEveryRampIntoItsBin) {
  for (const int num_bins : {6, 9, 18, 36}) {
    for (int bin = 0; bin < num_bins; ++bin) {
      const double middle_deg = (bin + 0.5) * 180 / num_bins;
      EXPECT_EQ(argmax(histogram(ramp(middle_deg), grid(1, num_bins))), bin) << num_bins;
      // Dark to bright and bright to dark count as one orientation.
      EXPECT_EQ(argmax(histogram(ramp(middle_deg + 180), grid(1, num_bins))), bin) << num_bins;
    }
  }
}

TEST(OrientationHistogram, SharesARampBetweenTwoBinsOverBothNeighbours) {
  for (const double angle_deg : {0.0, 20.0, 179.999}) {  // borders of the 9 bins
    const VectorF h = histogram(ramp(angle_deg), grid(1, 9));
    const int upper = angle_deg > 10 && angle_deg < 30 ? 1 : 0;
    const int lower = (upper + 8) % 9;
    EXPECT_NEAR(h[upper], h[lower], 1e-3) << angle_deg;
    EXPECT_NEAR(h.sum(), h[upper] + h[lower], 1e-4) << angle_deg;
    EXPECT_GT(h[upper], 0.5F);
  }
}

TEST(OrientationHistogram, DoesNotMindBrightness) {
  const VectorF h = histogram(picture(), {});
  const MatrixF brighter = (picture().array() + 5.0F).matrix();
  EXPECT_LT((histogram(brighter, {}) - h).cwiseAbs().maxCoeff(), 1e-3F);
}

TEST(OrientationHistogram, DoesNotMindContrastWhileThereIsSome) {
  const VectorF h = histogram(picture(), {});
  for (const float scale : {0.5F, 4.0F, 255.0F})
    EXPECT_LT((histogram(scale * picture(), {}) - h).norm(), 0.05F * h.norm()) << scale;
}

TEST(OrientationHistogram, FadesWhereThereIsNothingButRounding) {
  EXPECT_LT(histogram(1e-5F * picture(), {}).norm(), 0.2F * histogram(picture(), {}).norm());
  EXPECT_EQ(histogram(MatrixF::Constant(32, 32, 3), {}), VectorF(VectorF::Zero(7 * 7 * 36)));
  EXPECT_EQ(histogram(MatrixF::Constant(32, 32, 3), grid(1, 18)), VectorF(VectorF::Zero(18)));
}

TEST(OrientationHistogram, ClipsAndScalesItsBlocks) {
  const VectorF h = histogram(picture(), {});
  EXPECT_GE(h.minCoeff(), 0.0F);
  for (Eigen::Index block = 0; block < 49; ++block)
    EXPECT_NEAR(h.segment(36 * block, 36).norm(), 1, 0.01) << block;
}

// Edges of two directions, one ten times as strong: clipping at 0.2 would make them nearly equal.
TEST(OrientationHistogram, DoesNotClipASingleCell) {
  MatrixF image = MatrixF::Zero(40, 40);
  image.rightCols(20).setConstant(10);
  image.bottomRows(20).array() += 1;
  for (const int num_bins : {9, 18, 36}) {
    const VectorF h = histogram(image, grid(1, num_bins));
    EXPECT_NEAR(h.norm(), 1, 1e-3) << num_bins;
    EXPECT_GT(h.maxCoeff(), 0.6F) << num_bins;
    EXPECT_LT(h[num_bins / 2], 0.3F * h.maxCoeff()) << num_bins;
  }
}

TEST(OrientationHistogram, KeepsPlacesApart) {
  MatrixF left = MatrixF::Zero(32, 32);
  left.block(8, 4, 16, 6).setOnes();
  const MatrixF right = left.rowwise().reverse();
  EXPECT_GT((histogram(left, grid(4, 9)) - histogram(right, grid(4, 9))).norm(), 1);
  // One cell does not see where; a mirrored upright rectangle has the same edges.
  EXPECT_LT((histogram(left, grid(1, 9)) - histogram(right, grid(1, 9))).norm(), 1e-4F);
}

TEST(OrientationHistogram, TakesSidesThatAreNotMultiplesOfTheCells) {
  for (const auto& [rows, cols] : {std::pair{8, 8}, {9, 31}, {65, 8}, {3, 3}}) {
    const MatrixF image = testing_data::noise(rows, cols, 4);
    EXPECT_TRUE(histogram(image, grid(rows < 8 ? 3 : 8, 9)).allFinite()) << rows << "x" << cols;
  }
}

TEST(OrientationHistogram, ReadsARectangleOfALargerImage) {
  MatrixF large = MatrixF::Constant(80, 90, 9);
  large.block(5, 7, 64, 64) = picture();
  VectorF out(orientation_histogram_size({}));
  orientation_histogram(large.block(5, 7, 64, 64), {},
                        {out.data(), static_cast<std::size_t>(out.size())});
  EXPECT_EQ(out, histogram(picture(), {}));
}

TEST(OrientationHistogram, RefusesPixelsThatAreNotFiniteOrTooLarge) {
  for (const float value : {testing_data::kNan, static_cast<float>(testing_data::kInfinity), 2e6F,
                            -std::numeric_limits<float>::max()}) {
    MatrixF image = picture();
    image(17, 23) = value;
    const std::string message =
        testing_data::message_of<InvalidArgument>([&] { histogram(image, {}); });
    EXPECT_NE(message.find("row 17, column 23"), std::string::npos) << message;
  }
}

TEST(OrientationHistogram, TakesTheLargestPixelsItPromises) {
  MatrixF image = MatrixF::Constant(16, 16, -1e6F);
  image.rightCols(8).setConstant(1e6F);
  for (const int num_cells : {1, 4, 8}) {
    const VectorF h = histogram(image, grid(num_cells, 9));
    EXPECT_TRUE(h.allFinite());
    EXPECT_GT(h.maxCoeff(), 0.1F);
  }
}

TEST(OrientationHistogram, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(histogram(ramp(0), grid(33, 9)), InvalidArgument);
  EXPECT_THROW(histogram(MatrixF::Zero(2, 32), grid(1, 9)), InvalidArgument);
  EXPECT_THROW(histogram(MatrixF(0, 0), grid(1, 9)), InvalidArgument);
  VectorF out(5);
  EXPECT_THROW(orientation_histogram(ramp(0), grid(1, 9), {out.data(), 5}), InvalidArgument);
}

TEST(OrientationHistogram, NamesTheOptionThatIsOutOfRange) {
  const auto refusal = [](int num_cells, int num_bins) {
    return testing_data::message_of<InvalidArgument>(
        [&] { (void)orientation_histogram_size(grid(num_cells, num_bins)); });
  };
  for (const int v : {0, -1, 65})
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, ".num_cells must", refusal(v, 9));
  for (const int v : {1, 0, 73})
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, ".num_bins must", refusal(8, v));
}

}  // namespace
}  // namespace hri
