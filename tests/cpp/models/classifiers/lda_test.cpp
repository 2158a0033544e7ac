// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/lda.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

// Two classes that differ in column 1 only, which varies less than column 0 does.
MatrixF two_classes(std::vector<int>* classes) {
  MatrixF rows = noise(400, 3, 1);
  rows.col(0) *= 10.0F;
  classes->resize(400);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    (*classes)[static_cast<std::size_t>(r)] = static_cast<int>(r % 2);
    rows(r, 1) += r % 2 == 0 ? 2.0F : -2.0F;
  }
  return rows;
}

TEST(Lda, FindsWhatTellsClassesApartNotWhatVariesMost) {
  std::vector<int> classes;
  const MatrixF rows = two_classes(&classes);
  const Lda lda = Lda::train(rows, classes, 2, {});
  EXPECT_EQ(lda.num_components(), 1);
  EXPECT_EQ(lda.dim(), 3);
  EXPECT_GT(lda.components()(0, 1), 0.9F);  // positive by the sign rule
  EXPECT_LT(std::abs(lda.components()(0, 0)), 0.05F);
  const MatrixF projected = lda.transform(rows);
  int wrong = 0;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) wrong += (projected(r, 0) > 0) != (r % 2 == 0);
  EXPECT_LT(wrong, 30);
}

TEST(Lda, TransformsTheSameAfterLoading) {
  std::vector<int> classes;
  const MatrixF rows = two_classes(&classes);
  const Lda lda = Lda::train(rows, classes, 2, {});
  ModelFile file;
  lda.write(file, "lda.");
  EXPECT_EQ(Lda::read(through_bytes(file), "lda.").transform(rows), lda.transform(rows));
  file.set_vector("lda.mean", VectorF(VectorF::Zero(4)));
  EXPECT_THROW(Lda::read(file, "lda."), FormatError);
}

TEST(Lda, RefusesBadInputByName) {
  std::vector<int> classes;
  const MatrixF rows = two_classes(&classes);
  LdaOptions options;
  options.num_components = 2;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_components",
                      message_of<InvalidArgument>([&] { Lda::train(rows, classes, 2, options); }));
  EXPECT_THROW(Lda::train(rows.topRows(2), Span<const int>(classes).subspan(0, 2), 2, {}),
               InvalidArgument);
  EXPECT_THROW(Lda::train(MatrixF::Ones(4, 2), std::vector<int>{0, 1, 0, 1}, 2, {}),
               InvalidArgument);
}

}  // namespace
}  // namespace hri
