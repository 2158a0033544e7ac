// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook/codebook.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

CodebookOptions with_size(int num_codewords) {
  CodebookOptions options;
  options.num_codewords = num_codewords;
  return options;
}

// The nearest centroid in double, by brute force.
int nearest(const MatrixF& centroids, const Eigen::RowVectorXf& x) {
  Eigen::Index best = 0;
  (centroids.cast<double>().rowwise() - x.cast<double>()).rowwise().squaredNorm().minCoeff(&best);
  return static_cast<int>(best);
}

TEST(Codebook, FindsTheCentresOfSeparateClusters) {
  const LabelledRows data = blobs(4, 50, 20.0, 1);
  const Codebook book = Codebook::train_lbg(data.rows, with_size(4));
  ASSERT_EQ(book.size(), 4);
  const std::vector<std::int32_t> symbols = book.quantise(data.rows);
  for (std::size_t r = 4; r < symbols.size(); ++r) EXPECT_EQ(symbols[r], symbols[r % 4]);
  EXPECT_EQ(std::set<std::int32_t>(symbols.begin(), symbols.begin() + 4).size(), 4U);
  EXPECT_NEAR(book.distortion(data.rows), 3.0, 0.5);  // three columns of variance 1
}

TEST(Codebook, QuantisesToTheNearestCodeword) {
  for (const int size : {1, 3, 31, 32, 33, 100}) {
    for (const int dim : {1, 2, 39}) {
      const MatrixF centroids = noise(size, dim, 2);
      const Codebook book(centroids);
      const MatrixF frames = noise(200, dim, 3);
      const std::vector<std::int32_t> symbols = book.quantise(frames);
      for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        const int expected = nearest(centroids, frames.row(t));
        EXPECT_EQ(symbols[static_cast<std::size_t>(t)], expected)
            << size << " codewords, frame " << t;
        EXPECT_EQ(book.quantise(row_span(frames, t)), expected);
      }
    }
  }
}

TEST(Codebook, TakesTheLowerOfTwoCodewordsAsNear) {
  MatrixF centroids = MatrixF::Zero(70, 1);
  centroids(0, 0) = 5;
  EXPECT_EQ(Codebook(centroids).quantise(std::vector<float>{1.0F}), 1);
}

TEST(Codebook, FallsInDistortionAsItGrows) {
  const MatrixF rows = noise(500, 4, 4);
  double before = Codebook::train_lbg(rows, with_size(1)).distortion(rows);
  for (const int size : {2, 3, 5, 8, 24, 64}) {
    const Codebook book = Codebook::train_lbg(rows, with_size(size));
    EXPECT_EQ(book.size(), size);
    EXPECT_LT(book.distortion(rows), before);
    before = book.distortion(rows);
  }
}

TEST(Codebook, HasNoEmptyCells) {
  MatrixF rows(60, 1);  // three different rows, one of them rare
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    rows(r, 0) = r == 0 ? 100.0F : static_cast<float>(r % 2);
  const Codebook book = Codebook::train_lbg(rows, with_size(16));
  EXPECT_EQ(book.size(), 3);
  EXPECT_EQ(book.distortion(rows), 0.0);
  const std::vector<std::int32_t> symbols = book.quantise(rows);
  EXPECT_EQ(std::set<std::int32_t>(symbols.begin(), symbols.end()).size(), 3U);
}

TEST(Codebook, RepairsEmptyCellsOfGivenCentroids) {
  const LabelledRows data = blobs(3, 40, 20.0, 5);
  MatrixF centroids = MatrixF::Constant(3, 3, 1000.0F);  // the second and third win no row
  centroids.row(0).setZero();
  centroids.row(2).setConstant(2000.0F);
  const Codebook book = Codebook::train_kmeans(data.rows, centroids, {});
  EXPECT_EQ(book.size(), 3);
  EXPECT_LT(book.distortion(data.rows), 4.0);
}

TEST(Codebook, RepairsCellsOfDuplicateCentroids) {
  const LabelledRows data = blobs(4, 50, 30.0, 11);
  const Codebook book = Codebook::train_kmeans(data.rows, data.rows.row(0).replicate(4, 1), {});
  EXPECT_EQ(book.size(), 4);
  EXPECT_LT(book.distortion(data.rows), 4.0);  // three columns of variance 1: one codeword a blob
}

TEST(Codebook, DropsCentroidsThatFewerDifferentRowsLeaveOver) {
  MatrixF rows(30, 2);
  for (Eigen::Index r = 0; r < 30; ++r) rows.row(r).setConstant(static_cast<float>(r % 3));
  MatrixF centroids = noise(6, 2, 12);
  centroids.row(5).setConstant(1e30F);  // its squared distance overflows
  const Codebook book = Codebook::train_kmeans(rows, centroids, {});
  EXPECT_EQ(book.size(), 3);
  EXPECT_EQ(book.distortion(rows), 0.0);
}

TEST(Codebook, KeepsOneCodewordForRowsAllAlike) {
  const Codebook book = Codebook::train_lbg(MatrixF::Constant(5, 2, 3.0F), with_size(8));
  EXPECT_EQ(book.size(), 1);
  EXPECT_EQ(book.centroids(), MatrixF::Constant(1, 2, 3.0F));
  EXPECT_EQ(Codebook::train_lbg(MatrixF::Constant(1, 2, 3.0F), with_size(8)).size(), 1);
}

TEST(Codebook, RefusesBadInputByName) {
  MatrixF rows = noise(6, 2, 6);
  EXPECT_THROW(Codebook::train_lbg(MatrixF(0, 2), {}), InvalidArgument);
  EXPECT_THROW(Codebook::train_lbg(rows, with_size(0)), InvalidArgument);
  EXPECT_THROW(Codebook::train_kmeans(rows, MatrixF::Zero(2, 3), {}), InvalidArgument);
  const auto option = [&](const auto& change) {
    CodebookOptions options;
    change(&options);
    return message_of<InvalidArgument>([&] { Codebook::train_lbg(rows, options); });
  };
  for (const int bad : {0, 65537}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "CodebookOptions.num_codewords must lie in ",
                        option([&](CodebookOptions* o) { o->num_codewords = bad; }));
  }
  for (const int bad : {0, 100001}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "CodebookOptions.max_iterations must lie in ",
                        option([&](CodebookOptions* o) { o->max_iterations = bad; }));
  }
  for (const double bad : {-1e-9, static_cast<double>(kNan)}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "CodebookOptions.tolerance must lie in ",
                        option([&](CodebookOptions* o) { o->tolerance = bad; }));
  }
  for (const double bad : {0.0, kInfinity, static_cast<double>(kNan)}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "CodebookOptions.split_epsilon must lie in ",
                        option([&](CodebookOptions* o) { o->split_epsilon = bad; }));
  }
  EXPECT_THROW(Codebook(MatrixF(0, 2)), InvalidArgument);
  const Codebook book = Codebook::train_lbg(rows, with_size(2));
  EXPECT_THROW(static_cast<void>(book.distortion(MatrixF(0, 2))), InvalidArgument);
  rows(3, 1) = kNan;
  const auto refused = [](const auto& action) { return message_of<InvalidArgument>(action); };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 1",
                      refused([&] { return book.quantise(rows); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 1",
                      refused([&] { return book.distortion(rows); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 1",
                      refused([&] { return Codebook::train_lbg(rows, {}); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row[1]", refused([&] {
                        return book.quantise(std::vector<float>{0, kNan});
                      }));
}

TEST(Codebook, QuantisesNoFramesToNoSymbols) {
  EXPECT_TRUE(Codebook(MatrixF::Zero(2, 3)).quantise(MatrixF(0, 3)).empty());
}

TEST(Codebook, StopsWhenAskedInAnyIteration) {
  const MatrixF rows = noise(50, 2, 7);
  for (const bool lbg : {true, false}) {
    CodebookOptions options = with_size(8);
    options.tolerance = 0;
    int polls = 0;
    int stop_at = 0;
    options.should_stop = [&] { return ++polls == stop_at; };
    const auto train = [&] {
      polls = 0;
      return lbg ? Codebook::train_lbg(rows, options)
                 : Codebook::train_kmeans(rows, rows.topRows(8), options);
    };
    train();
    const int all = polls;
    ASSERT_GT(all, 3);
    for (stop_at = 1; stop_at <= all; ++stop_at) {
      EXPECT_THROW(train(), Interrupted);
      EXPECT_EQ(polls, stop_at);
    }
  }
}

TEST(Codebook, ReportsADistortionThatNeverRisesWithinOneSize) {
  for (const double offset : {0.0, 1000.0}) {
    const MatrixF rows = noise(700, 6, 9, offset);
    CodebookReport report;
    report.sizes = {99};  // of an earlier training
    const Codebook book = Codebook::train_lbg(rows, with_size(24), &report);
    ASSERT_EQ(report.sizes.size(), report.distortions.size());
    EXPECT_EQ(std::set<int>(report.sizes.begin(), report.sizes.end()),
              (std::set<int>{2, 4, 8, 16, 24}));
    EXPECT_TRUE(report.converged);
    for (std::size_t i = 1; i < report.sizes.size(); ++i) {
      ASSERT_GE(report.sizes[i], report.sizes[i - 1]);
      if (report.sizes[i] == report.sizes[i - 1]) {
        EXPECT_LE(report.distortions[i], report.distortions[i - 1] * (1 + 1e-6)) << i;
      }
    }
    EXPECT_LE(book.distortion(rows), report.distortions.back() * (1 + 1e-6));
  }
}

TEST(Codebook, ReportsTheIterationLimitAsNotConverged) {
  const MatrixF rows = noise(300, 4, 10);
  CodebookOptions options;
  options.max_iterations = 3;
  options.tolerance = 0;
  CodebookReport report;
  Codebook::train_kmeans(rows, rows.topRows(10), options, &report);
  EXPECT_EQ(report.sizes, std::vector<int>(3, 10));
  EXPECT_FALSE(report.converged);
  options.max_iterations = 1000;
  const Codebook book = Codebook::train_kmeans(rows, rows.topRows(10), options, &report);
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(report.distortions.back(), book.distortion(rows), 1e-9);
}

TEST(Codebook, QuantisesTheSameAfterLoading) {
  const MatrixF rows = noise(300, 5, 8);
  const Codebook book = Codebook::train_lbg(rows, with_size(20));
  ModelFile file;
  book.write(file, "vq.");
  const Codebook loaded = Codebook::read(through_bytes(file), "vq.");
  EXPECT_EQ(loaded.centroids(), book.centroids());
  EXPECT_EQ(loaded.quantise(rows), book.quantise(rows));
  EXPECT_THROW(Codebook::read(file, "other."), FormatError);
}

}  // namespace
}  // namespace hri
