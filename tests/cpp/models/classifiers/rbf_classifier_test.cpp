// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/rbf_classifier.hpp"

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
  // One row a class: what is usual is the mean squared distance of all rows.
  EXPECT_NEAR(model.place(row, 1).nearest, 0.0, 1e-6);
  EXPECT_NEAR(model.place(row, 0).nearest, 2.0, 1e-6);
  EXPECT_NEAR(model.place(row, 0).centre, 2.0, 1e-6);
}

TEST(RbfClassifier, PlacesARowAmongThoseOfAClass) {
  // Class 0: 0, 1, 3, 7. Mean squares of the three nearest of each: (1 + 9 + 49) / 3,
  // (1 + 4 + 36) / 3, (4 + 9 + 16) / 3, (16 + 36 + 49) / 3; the upper median is 59 / 3.
  MatrixF rows(6, 1);
  rows << 0, 20, 1, 3, 21, 7;
  const RbfClassifier model = RbfClassifier::train(rows, std::vector<int>{0, 1, 0, 0, 1, 0}, 2, {});
  const std::vector<float> row{2.0F};
  EXPECT_NEAR(model.place(row, 0).nearest, (1 + 1 + 4) / 59.0, 1e-5);
  const float centre = 11.0F / 4;
  double spread = 0;
  for (Eigen::Index a = 0; a < 6; ++a) {
    for (Eigen::Index b = 0; b < 6; ++b)
      spread += static_cast<double>((rows(a, 0) - rows(b, 0)) * (rows(a, 0) - rows(b, 0))) / 36;
  }
  EXPECT_NEAR(model.place(row, 0).centre, (2 - centre) * (2 - centre) / spread, 1e-5);
  EXPECT_NEAR(model.place(row, 1).centre, 18.5 * 18.5 / spread, 1e-4);
  EXPECT_THROW(static_cast<void>(model.place(row, 2)), InvalidArgument);
}

TEST(RbfClassifier, CountsTheClassAmongTheNearestRows) {
  // Class 0: 1 to 30; class 1: -1 to -5.
  MatrixF rows(35, 1);
  std::vector<int> classes;
  for (int i = 0; i < 35; ++i) {
    rows(i, 0) = static_cast<float>(i < 30 ? i + 1 : 29 - i);
    classes.push_back(i < 30 ? 0 : 1);
  }
  const RbfClassifier model = RbfClassifier::train(rows, classes, 2, {});
  const std::vector<float> row{0.1F};
  // Of twenty, all five of class 1; of as many as class 1 has: 1, -1, 2, -2, 3.
  EXPECT_FLOAT_EQ(model.place(row, 0).agreement, 15.0F / 20);
  EXPECT_FLOAT_EQ(model.place(row, 1).agreement, 2.0F / 5);
  const std::vector<float> inside{25.0F};
  EXPECT_EQ(model.place(inside, 0).agreement, 1);
  EXPECT_EQ(model.place(inside, 1).agreement, 0);
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
  const Span<const float> near{data.rows.row(0).data(), 3};
  EXPECT_GT(model.place(far, 0).nearest, 10 * model.place(near, data.classes[0]).nearest);
}

TEST(RbfClassifier, LoadsWhatItSavedToTheBit) {
  const LabelledRows data = blobs(3, 20, 3.0, 1);
  const RbfClassifier model = RbfClassifier::train(data.rows, data.classes, 3, {});
  ModelFile file;
  model.write(file, "m.");
  const RbfClassifier again = RbfClassifier::read(file, "m.");
  const Span<const float> row{data.rows.row(4).data(), 3};
  EXPECT_EQ(again.decision_values(row), model.decision_values(row));
  EXPECT_EQ(again.place(row, 1).nearest, model.place(row, 1).nearest);
  EXPECT_EQ(again.place(row, 1).centre, model.place(row, 1).centre);
  for (const char* field : {"m.classes", "m.usual", "m.variances"}) {
    ModelFile broken = file;
    broken.set_vector(field, VectorF(VectorF::Constant(2, 7)));
    EXPECT_THROW(RbfClassifier::read(broken, "m."), FormatError) << field;
  }
  ModelFile between = file;
  between.set_vector("m.classes", VectorF(VectorF::Constant(model.num_rows(), 0.5F)));
  EXPECT_THROW(RbfClassifier::read(between, "m."), FormatError);
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

TEST(RbfClassifier, IsAsGoodFarFromZero) {
  const LabelledRows train = blobs(3, 30, 4.0, 1, 8);
  const LabelledRows test = blobs(3, 30, 4.0, 2, 8);
  const auto share_right = [&](float offset) {
    const MatrixF moved = train.rows.array() + offset;
    const RbfClassifier made = RbfClassifier::train(moved, train.classes, 3, {});
    ModelFile file;
    made.write(file, "x.");
    const RbfClassifier model = RbfClassifier::read(file, "x.");
    int right = 0;
    for (Eigen::Index r = 0; r < test.rows.rows(); ++r) {
      const MatrixF row = test.rows.row(r).array() + offset;
      const Span<const float> span(row.data(), static_cast<std::size_t>(row.size()));
      EXPECT_EQ(model.decision_values(span), made.decision_values(span));
      if (argmax(model.decision_values(span)) == test.classes[static_cast<std::size_t>(r)]) ++right;
    }
    return static_cast<double>(right) / static_cast<double>(test.rows.rows());
  };
  const double near = share_right(0);
  EXPECT_GT(near, 0.9);
  for (const float offset : {100.0F, 1000.0F, 10000.0F})
    EXPECT_NEAR(share_right(offset), near, 0.03);
}

}  // namespace
}  // namespace hri
