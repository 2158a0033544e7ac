// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/flat_start.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

ModelSet prototype() {
  ModelSet set;
  set.parse(
      "~o <VECSIZE> 2 <USER>\n~s \"s\" <MEAN> 2 7 8 <VARIANCE> 2 1 1\n~h proto <BEGINHMM> "
      "<NUMSTATES> 4 <STATE> 2 ~s \"s\" <STATE> 3 <NUMMIXES> 2 <MIXTURE> 1 0.3 <MEAN> 2 0 0 "
      "<VARIANCE> 2 1 1 <MIXTURE> 2 0.7 <MEAN> 2 1 1 <VARIANCE> 2 1 1 <TRANSP> 4 0 1 0 0 0 0.5 0.5 "
      "0 0 0 0.5 0.5 0 0 0 0 <ENDHMM>\n",
      "proto");
  return set;
}

FlatStart filled(const MatrixF& frames) {
  FlatStart start;
  start.add(frames.topRows(3));
  start.add(frames.topRows(0));
  start.add(frames.bottomRows(frames.rows() - 3));
  return start;
}

TEST(FlatStart, HasTheMomentsOfAllFrames) {
  // Far from 0, where sums of squares would lose the variance.
  const MatrixF frames = (MatrixF::Random(50, 2).array() + 1e4F);
  const FlatStart start = filled(frames);
  const MatrixD exact = frames.cast<double>();
  const VectorD mean = exact.colwise().mean();
  const VectorD variance =
      (exact.rowwise() - mean.transpose()).array().square().colwise().mean().transpose();
  EXPECT_EQ(start.num_frames(), 50);
  EXPECT_LT((start.mean() - mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((start.variance() - variance).cwiseQuotient(variance).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FlatStart, SetsEveryGaussianAndNothingElse) {
  const FlatStart start = filled(MatrixF::Random(50, 2));
  const ModelSet kept = start.apply(prototype(), false);
  const ModelSet moved = start.apply(prototype(), true);
  const ModelSet given = prototype();
  const HmmDefinition& before = given.find('h', "proto")->hmm;
  for (std::size_t s = 0; s < 2; ++s) {
    const auto& old = before.states[s].components;
    for (std::size_t c = 0; c < old.size(); ++c) {
      const auto& a = kept.find('h', "proto")->hmm.states[s].components[c];
      const auto& b = moved.find('h', "proto")->hmm.states[s].components[c];
      EXPECT_EQ(a.component.mean.values, old[c].component.mean.values);
      EXPECT_EQ(a.component.variance.values, start.variance());
      EXPECT_EQ(b.component.mean.values, start.mean());
      EXPECT_EQ(b.component.variance.values, start.variance());
      EXPECT_EQ(b.weight, old[c].weight);
    }
  }
  EXPECT_EQ(moved.find('s', "s")->state.components[0].component.mean.values, start.mean());
  EXPECT_EQ(moved.find('h', "proto")->hmm.transitions.values, before.transitions.values);
  EXPECT_NE(moved.to_text().find("~s \"s\"\n<STATE> 3"), std::string::npos);
}

TEST(FlatStart, WritesFloorsAsAShareOfTheVariance) {
  const FlatStart start = filled(MatrixF::Random(50, 2));
  const ModelSet floors = start.variance_floors(0.25);
  EXPECT_EQ(floors.find('v', "varFloor1")->vector.values, 0.25 * start.variance());
  EXPECT_EQ(floors.to_text().rfind("~v \"varFloor1\"\n<VARIANCE> 2\n", 0), 0U);
  EXPECT_EQ(start.apply(prototype(), true, 9)
                .find('s', "s")
                ->state.components[0]
                .component.variance.values,
            VectorD::Constant(2, 9));
}

TEST(FlatStart, RefusesBadInput) {
  EXPECT_THROW((void)FlatStart().mean(), InvalidArgument);
  EXPECT_THROW((void)FlatStart().apply(prototype(), true), InvalidArgument);
  MatrixF frames = MatrixF::Random(9, 2);
  FlatStart start = filled(frames);
  EXPECT_THROW(start.add(MatrixF::Random(9, 3)), InvalidArgument);
  EXPECT_THROW((void)start.apply(prototype(), true, -1), InvalidArgument);
  EXPECT_THROW((void)start.variance_floors(0), InvalidArgument);
  EXPECT_THROW((void)start.apply(ModelSet(), true), InvalidArgument);
  frames(2, 1) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(start.add(frames), InvalidArgument);
  EXPECT_EQ(start.num_frames(), 9);
  FlatStart constant;
  constant.add(MatrixF::Ones(5, 2));
  EXPECT_THROW((void)constant.apply(prototype(), true), InvalidArgument);
  EXPECT_NO_THROW((void)constant.apply(prototype(), true, 0.1));
  EXPECT_THROW((void)constant.variance_floors(0.1), InvalidArgument);
}

}  // namespace
}  // namespace hri::htk
