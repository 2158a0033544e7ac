// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/knn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

Knn three_on_a_line(int k) {
  MatrixF rows(5, 1);
  rows << 0, 1, 4, 5, 6;
  return Knn::train(rows, std::vector<int>{0, 0, 1, 1, 1}, 2, {k});
}

TEST(Knn, VotesByTheNearestRows) {
  const VectorF votes = three_on_a_line(3).decision_values(std::vector<float>{0.9F});
  EXPECT_NEAR(votes[0], 2.0 / 3.0, 2e-3);
  EXPECT_NEAR(votes[1], 1.0 / 3.0, 2e-3);
  EXPECT_FLOAT_EQ(three_on_a_line(3).nearest_distance(std::vector<float>{2.0F}), 1.0F);
}

TEST(Knn, BreaksTiesByTheNearerRow) {
  EXPECT_EQ(argmax(three_on_a_line(2).decision_values(std::vector<float>{2.6F})), 1);
  EXPECT_EQ(argmax(three_on_a_line(2).decision_values(std::vector<float>{2.4F})), 0);
}

TEST(Knn, LetsAllRowsVoteWhereThereAreFewerThanK) {
  EXPECT_EQ(argmax(three_on_a_line(100).decision_values(std::vector<float>{0.0F})), 1);
}

// Ranks all rows by distances in double.
VectorF votes_by_ranking(const LabelledRows& data, const float* x, int k, int num_classes) {
  const Eigen::Index dim = data.rows.cols();
  std::vector<double> distances;
  for (Eigen::Index r = 0; r < data.rows.rows(); ++r) {
    const Eigen::Map<const Eigen::RowVectorXf> row(x, dim);
    distances.push_back((data.rows.row(r).cast<double>() - row.cast<double>()).squaredNorm());
  }
  std::vector<std::size_t> order(distances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  VectorF votes = VectorF::Zero(num_classes);
  for (int i = 0; i < k; ++i)
    votes[data.classes[order[static_cast<std::size_t>(i)]]] += 1.0F / static_cast<float>(k);
  return votes;
}

TEST(Knn, FindsTheNearestOfManyRows) {
  // More rows than are measured at a time. With an offset |x|^2 - 2 x.y + |y|^2 would leave nothing
  // of the distances: 1e10 has steps of 1024 in float.
  for (const float offset : {0.0F, 1e5F}) {
    LabelledRows data = blobs(4, 150, 1.0, 1, 9);
    LabelledRows test = blobs(4, 20, 1.0, 2, 9);
    for (MatrixF* rows : {&data.rows, &test.rows}) rows->array() += offset;
    for (const int k : {1, 5, 300, 600}) {
      const Knn model = Knn::train(data.rows, data.classes, 4, {k});
      const MatrixF votes = model.decision_values(test.rows);
      for (Eigen::Index r = 0; r < test.rows.rows(); ++r) {
        const VectorF expected = votes_by_ranking(data, test.rows.row(r).data(), k, 4);
        // Nearer rows add up to 2e-3; near enough to a tie, float and double may rank otherwise.
        EXPECT_LT((votes.row(r).transpose() - expected).cwiseAbs().maxCoeff(), 2.5e-3)
            << "offset " << offset << ", k " << k << ", row " << r;
      }
    }
  }
}

TEST(Knn, PrefersTheFirstOfRowsAsFarAway) {
  // Two of three neighbours are class 1 only if the first ones of the rows that tie are taken.
  MatrixF rows = MatrixF::Constant(600, 2, 1.0F);
  rows.row(599).setZero();
  std::vector<int> classes(600, 0);
  classes[0] = classes[1] = 1;
  const Knn model = Knn::train(rows, classes, 2, {3});
  EXPECT_EQ(argmax(model.decision_values(std::vector<float>{0.0F, 0.0F})), 1);
}

TEST(Knn, RefusesNeighboursOutOfRange) {
  EXPECT_THROW(three_on_a_line(0), InvalidArgument);
  EXPECT_THROW(three_on_a_line(1001), InvalidArgument);
}

TEST(Knn, RefusesFilesWithClassesOutOfRange) {
  ModelFile file;
  three_on_a_line(1).write(file, "");
  file.set_vector("classes", VectorF(VectorF::Constant(5, 2.0F)));
  EXPECT_THROW(Knn::read(file, ""), FormatError);
  file.set_vector("classes", VectorF(VectorF::Constant(5, 0.5F)));
  EXPECT_THROW(Knn::read(file, ""), FormatError);
}

}  // namespace
}  // namespace hri
