// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/knn.hpp"

#include <gtest/gtest.h>

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
