// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/rbf_classifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(RbfClassifier, FindsTheKnownSolutionOfTwoPoints) {
  // Rows 0 and 2: squared distances 0, 4, 4, 0, of mean 2; the kernel is 2 on the diagonal and
  // 1 + exp(-4 s / 2) off it. By symmetry the weights are -a and a, and what the rows get is
  // a (2 - 1 - exp(-2 s)) = 1 - a / C.
  MatrixF rows(2, 1);
  rows << 0, 2;
  RbfClassifierOptions options;
  options.cost = 4;
  options.sharpness = 0.5;
  const RbfClassifier model = RbfClassifier::train(rows, std::vector<int>{0, 1}, 2, options);
  const double apart = 1 - std::exp(-1.0);
  const double a = 1 / (apart + 0.25);
  const std::vector<float> row{2.0F};
  EXPECT_NEAR(model.decision_values(row)[1], a * apart, 1e-6);
  EXPECT_NEAR(model.decision_values(row)[0], -a * apart, 1e-6);
  EXPECT_NEAR(model.nearness(row, 1), 0.0, 1e-6);
  EXPECT_NEAR(model.nearness(row, 5), 1.0, 1e-6);
}

TEST(RbfClassifier, SeparatesWhatNoPlaneDoes) {
  // A ring around a blob.
  const LabelledRows ring = blobs(24, 4, 8.0, 1, 2);
  std::vector<int> classes(static_cast<std::size_t>(ring.rows.rows()), 1);
  const LabelledRows middle = blobs(2, 20, 0.0, 2, 2);
  MatrixF rows(ring.rows.rows() + middle.rows.rows(), 2);
  rows << ring.rows, middle.rows;
  classes.resize(static_cast<std::size_t>(rows.rows()), 0);
  RbfClassifierOptions options;
  options.sharpness = 4;
  const RbfClassifier model = RbfClassifier::train(rows, classes, 2, options);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const VectorF values = model.decision_values({rows.row(r).data(), 2});
    EXPECT_EQ(values[1] > values[0], classes[static_cast<std::size_t>(r)] == 1) << r;
  }
}

TEST(RbfClassifier, SaysWhatIsFarFromAllItHasSeen) {
  const LabelledRows data = blobs(3, 20, 5.0, 1);
  const RbfClassifier model = RbfClassifier::train(data.rows, data.classes, 3, {});
  const std::vector<float> far{40, 40, 40};
  EXPECT_GT(model.nearness(far, 3), 10 * model.nearness({data.rows.row(0).data(), 3}, 3));
}

TEST(RbfClassifier, LoadsWhatItSavedToTheBit) {
  const LabelledRows data = blobs(3, 20, 3.0, 1);
  const RbfClassifier model = RbfClassifier::train(data.rows, data.classes, 3, {});
  ModelFile file;
  model.write(file, "m.");
  const RbfClassifier again = RbfClassifier::read(file, "m.");
  const Span<const float> row{data.rows.row(4).data(), 3};
  EXPECT_EQ(again.decision_values(row), model.decision_values(row));
  file.set_matrix("m.weights", MatrixF::Ones(3, 2));
  EXPECT_THROW(RbfClassifier::read(file, "m."), FormatError);
}

TEST(RbfClassifier, StopsWhenAskedAndRefusesOptionsOutOfRange) {
  const LabelledRows data = blobs(2, 10, 2.0, 1);
  RbfClassifierOptions options;
  options.should_stop = [] { return true; };
  EXPECT_THROW(RbfClassifier::train(data.rows, data.classes, 2, options), Interrupted);
  for (double RbfClassifierOptions::*field :
       {&RbfClassifierOptions::cost, &RbfClassifierOptions::sharpness}) {
    RbfClassifierOptions bad;
    bad.*field = 0;
    EXPECT_THROW(RbfClassifier::train(data.rows, data.classes, 2, bad), InvalidArgument);
  }
}

}  // namespace
}  // namespace hri
