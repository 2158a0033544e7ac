// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/vector_scorer.hpp"

#include <gtest/gtest.h>

#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kDim = 6;

// Vectors of one class by several speakers, each with an offset of its own.
std::vector<MatrixF> spoken(Eigen::Index at, int first_speaker, int num_speakers, Random* random) {
  std::vector<MatrixF> result;
  for (int speaker = first_speaker; speaker < first_speaker + num_speakers; ++speaker) {
    for (int take = 0; take < 4; ++take) {
      MatrixF vector(1, kDim);
      for (float& x : vector.reshaped()) x = static_cast<float>(0.3 * random->normal());
      vector(0, at) += 2.0F;
      vector(0, kDim - 1) += static_cast<float>(speaker);
      result.push_back(vector);
    }
  }
  return result;
}

ClassSequences classes(Random* random) {
  return {spoken(0, 0, 3, random), spoken(1, 0, 3, random)};
}

ClassSequences many_fillers(Random* random) {
  ClassSequences result;
  for (int i = 0; i < 60; ++i) {
    MatrixF vector(1, kDim);
    for (float& x : vector.reshaped()) x = static_cast<float>(1.5 * random->normal());
    result.push_back({vector});
  }
  return result;
}

TEST(VectorScorer, AddsAClassThatOtherSpeakersAreFoundBy) {
  Random random(5);
  const ClassSequences known = classes(&random);
  const VectorScorer scorer = VectorScorer::train(known, many_fillers(&random), {1.0, 0.5});
  const VectorScorer more = scorer.with_class(2, spoken(2, 0, 1, &random));
  for (const MatrixF& vector : spoken(2, 2, 1, &random)) {
    Eigen::Index best = 0;
    more.scores(vector).maxCoeff(&best);
    EXPECT_EQ(best, 2);
  }
  for (Eigen::Index c = 0; c < 2; ++c) {
    for (const MatrixF& vector : known[static_cast<std::size_t>(c)]) {
      Eigen::Index best = 0;
      more.scores(vector).maxCoeff(&best);
      EXPECT_EQ(best, c);
      EXPECT_EQ(more.scores(vector).head(2), scorer.scores(vector));
    }
  }
}

TEST(VectorScorer, FillersDoNotWeighOnAnAddedClass) {
  Random random(6);
  const ClassSequences known = classes(&random);
  const ClassSequences fillers = many_fillers(&random);
  const std::vector<MatrixF> added = spoken(3, 0, 1, &random);
  const VectorScorer with = VectorScorer::train(known, fillers, {1.0, 0.5}).with_class(2, added);
  const VectorScorer without = VectorScorer::train(known, {}, {1.0, 0.5}).with_class(2, added);
  for (const MatrixF& vector : spoken(3, 1, 2, &random))
    EXPECT_EQ(with.scores(vector), without.scores(vector));
  EXPECT_EQ(with.num_fillers(), 60);
}

}  // namespace
}  // namespace hri
