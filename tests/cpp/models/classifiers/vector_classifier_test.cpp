// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What every classifier of rows must do.
#include <gtest/gtest.h>

#include <thread>

#include "hri/core/error.hpp"
#include "hri/models/classifiers/distance_classifier.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/classifiers/knn.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/possibility_classifier.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

template <class Model, class Options>
struct Case {
  static Model train(ConstMatrixRefF rows, Span<const int> classes, int num_classes) {
    return Model::train(rows, classes, num_classes, Options{});
  }
  static Model read(const ModelFile& file) { return Model::read(file, "m."); }
};

struct BayesFull : Case<GaussianBayes, GaussianBayesOptions> {
  static GaussianBayes train(ConstMatrixRefF rows, Span<const int> classes, int num_classes) {
    return GaussianBayes::train(rows, classes, num_classes, {CovarianceKind::full, 0.1});
  }
};
struct BayesDiagonal : Case<GaussianBayes, GaussianBayesOptions> {
  static GaussianBayes train(ConstMatrixRefF rows, Span<const int> classes, int num_classes) {
    return GaussianBayes::train(rows, classes, num_classes, {CovarianceKind::diagonal, 0.0});
  }
};
template <ClassDistance metric>
struct Nearest : Case<DistanceClassifier, DistanceClassifierOptions> {
  static DistanceClassifier train(ConstMatrixRefF rows, Span<const int> classes, int num_classes) {
    return DistanceClassifier::train(rows, classes, num_classes, {metric, 0.1});
  }
};

template <class T>
class VectorClassifier : public ::testing::Test {};

using Classifiers =
    ::testing::Types<Case<LinearSvm, LinearSvmOptions>, Case<GaussianBayes, GaussianBayesOptions>,
                     BayesFull, BayesDiagonal, Case<Knn, KnnOptions>,
                     Nearest<ClassDistance::euclidean>, Nearest<ClassDistance::manhattan>,
                     Nearest<ClassDistance::mahalanobis>, Nearest<ClassDistance::bhattacharyya>,
                     Case<PossibilityClassifier, GaussianBayesOptions>>;
TYPED_TEST_SUITE(VectorClassifier, Classifiers);

TYPED_TEST(VectorClassifier, TellsSeparateClassesApart) {
  const LabelledRows train = blobs(4, 40, 8.0, 1);
  const LabelledRows test = blobs(4, 25, 8.0, 2);
  const auto model = TypeParam::train(train.rows, train.classes, 4);
  EXPECT_EQ(model.num_classes(), 4);
  EXPECT_EQ(model.dim(), 3);
  for (Eigen::Index r = 0; r < test.rows.rows(); ++r) {
    EXPECT_EQ(argmax(model.decision_values(row_span(test.rows, r))),
              test.classes[static_cast<std::size_t>(r)]);
  }
}

TYPED_TEST(VectorClassifier, LivesOnOneRowPerClass) {
  MatrixF rows(3, 2);
  rows << 0, 0, 10, 0, 0, 10;
  const auto model = TypeParam::train(rows, std::vector<int>{0, 1, 2}, 3);
  for (int c = 0; c < 3; ++c) {
    const VectorF values = model.decision_values(row_span(rows, c));
    EXPECT_TRUE(values.allFinite());
    EXPECT_EQ(argmax(values), c);
  }
}

TYPED_TEST(VectorClassifier, LivesOnConstantRows) {
  const MatrixF rows = MatrixF::Constant(6, 3, 2.5F);
  const auto model = TypeParam::train(rows, std::vector<int>{0, 1, 0, 1, 0, 1}, 2);
  EXPECT_TRUE(model.decision_values(row_span(rows, 0)).allFinite());
}

TYPED_TEST(VectorClassifier, RefusesBadTrainingDataByName) {
  LabelledRows data = blobs(3, 4, 8.0, 3);
  const auto train = [&](int num_classes) {
    return message_of<InvalidArgument>(
        [&] { TypeParam::train(data.rows, data.classes, num_classes); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "class 3 has no row", train(4));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 2: class 2", train(2));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_classes", train(1));
  data.rows(5, 1) = kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 5, column 1", train(3));
  data.classes.pop_back();
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "12 rows and 11 classes", train(3));
  EXPECT_THROW(TypeParam::train(MatrixF(0, 3), std::vector<int>{}, 2), InvalidArgument);
}

TYPED_TEST(VectorClassifier, RefusesBadRowsByIndex) {
  const LabelledRows data = blobs(2, 5, 8.0, 4);
  const auto model = TypeParam::train(data.rows, data.classes, 2);
  const auto score = [&](const std::vector<float>& row) {
    return message_of<InvalidArgument>([&] { return model.decision_values(row); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row[2]", score({0, 0, kNan}));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "2 values, the model has 3", score({0, 0}));
}

TYPED_TEST(VectorClassifier, ScoresTheSameAfterLoading) {
  const LabelledRows data = blobs(3, 10, 3.0, 5);
  const auto model = TypeParam::train(data.rows, data.classes, 3);
  ModelFile file;
  model.write(file, "m.");
  const auto loaded = TypeParam::read(through_bytes(file));
  for (Eigen::Index r = 0; r < data.rows.rows(); ++r) {
    EXPECT_EQ(model.decision_values(row_span(data.rows, r)),
              loaded.decision_values(row_span(data.rows, r)));
  }
  EXPECT_THROW(TypeParam::read(ModelFile()), FormatError);
}

TYPED_TEST(VectorClassifier, ScoresTheSameFromManyThreads) {
  const LabelledRows data = blobs(3, 20, 3.0, 6);
  const auto model = TypeParam::train(data.rows, data.classes, 3);
  std::vector<MatrixF> scores(4, MatrixF(data.rows.rows(), 3));
  std::vector<std::thread> threads;
  threads.reserve(scores.size());
  for (MatrixF& s : scores) {
    threads.emplace_back([&model, &data, &s] {
      for (Eigen::Index r = 0; r < s.rows(); ++r)
        s.row(r) = model.decision_values(row_span(data.rows, r)).transpose();
    });
  }
  for (std::thread& t : threads) t.join();
  for (const MatrixF& s : scores) EXPECT_EQ(s, scores.front());
}

template <class Model>
class ManyRows : public ::testing::Test {};
using TakeManyRows =
    ::testing::Types<Case<LinearSvm, LinearSvmOptions>, Case<GaussianBayes, GaussianBayesOptions>,
                     BayesFull, BayesDiagonal, Case<Knn, KnnOptions>>;
TYPED_TEST_SUITE(ManyRows, TakeManyRows);

TYPED_TEST(ManyRows, ScoresDoNotDependOnTheRowsBeside) {
  for (const int dim : {2, 16, 39}) {
    for (const double offset : {0.0, 1e4}) {
      LabelledRows data = blobs(5, 60, 2.0, 7, dim);
      data.rows.array() += static_cast<float>(offset);
      const auto model = TypeParam::train(data.rows, data.classes, 5);
      const MatrixF all = model.decision_values(data.rows);
      for (Eigen::Index r = 0; r < data.rows.rows(); ++r) {
        const VectorF alone = model.decision_values(row_span(data.rows, r));
        ASSERT_EQ(alone.transpose(), all.row(r)) << dim << " columns, row " << r;
      }
      const MatrixF some = model.decision_values(data.rows.middleRows(3, 70));
      EXPECT_EQ(some, all.middleRows(3, 70));
      // Rows that lie apart: the left part of wider ones.
      MatrixF wide = MatrixF::Constant(data.rows.rows(), dim + 3, kNan);
      wide.leftCols(dim) = data.rows;
      EXPECT_EQ(MatrixF(model.decision_values(wide.leftCols(dim))), all);
    }
  }
}

TYPED_TEST(ManyRows, TakesNoRows) {
  const LabelledRows data = blobs(3, 5, 2.0, 8);
  const auto model = TypeParam::train(data.rows, data.classes, 3);
  const MatrixF values = model.decision_values(MatrixF(0, 3));
  EXPECT_EQ(values.rows(), 0);
  EXPECT_EQ(values.cols(), 3);
}

TYPED_TEST(ManyRows, RefusesBadRowsByPlace) {
  LabelledRows data = blobs(3, 5, 2.0, 9);
  const auto model = TypeParam::train(data.rows, data.classes, 3);
  const auto score = [&](const MatrixF& rows) {
    return message_of<InvalidArgument>([&] { return model.decision_values(rows); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "2 columns, the model has 3", score(MatrixF(4, 2)));
  data.rows(7, 1) = kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 7, column 1", score(data.rows));
}

}  // namespace
}  // namespace hri
