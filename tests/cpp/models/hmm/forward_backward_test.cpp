// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Forward and backward probabilities and state posteriors of discrete and Gaussian-mixture HMMs.
#include "hri/models/hmm/forward_backward.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

template <class T>
class BothWays : public ::testing::Test {};
using BothWaysCases = ::testing::Types<DiscreteCase, GaussianCase>;
TYPED_TEST_SUITE(BothWays, BothWaysCases);

// The recursions in plain probabilities over the whole matrix, for sequences without underflow.
struct PlainBothWays {
  MatrixD forward;
  MatrixD backward;
  PlainBothWays(const VectorD& start, const MatrixD& transition, const MatrixD& b)
      : forward(b.rows(), b.cols()), backward(MatrixD::Ones(b.rows(), b.cols())) {
    forward.row(0) = start.transpose().cwiseProduct(b.row(0));
    for (Eigen::Index t = 1; t < b.rows(); ++t)
      forward.row(t) = (forward.row(t - 1) * transition).cwiseProduct(b.row(t));
    for (Eigen::Index t = b.rows() - 1; t > 0; --t)
      backward.row(t - 1) =
          (transition * backward.row(t).cwiseProduct(b.row(t)).transpose()).transpose();
  }
};

TYPED_TEST(BothWays, AreTheRecursionsInPlainProbabilities) {
  for (const Topology& topology : kTopologies) {
    for (const int num_frames : {1, 2, 7, 40}) {
      const auto model = TypeParam::make(topology, 3);
      const auto s = TypeParam::sequence(num_frames, 4);
      const ForwardBackward found = model.forward_backward(s);
      const PlainBothWays expected(TypeParam::start(model), TypeParam::transition(model),
                                   TypeParam::densities(model, s));
      ASSERT_EQ(found.log_forward.rows(), num_frames);
      ASSERT_EQ(found.log_backward.cols(), topology.num_states);
      const auto close = [](const MatrixD& logs, const MatrixD& plain) {
        return ((logs.array().exp() - plain.array()).abs() <= 1e-11 * plain.array() + 1e-300).all();
      };
      EXPECT_TRUE(close(found.log_forward, expected.forward));
      EXPECT_TRUE(close(found.log_backward, expected.backward));
      EXPECT_NEAR(found.log_likelihood, std::log(expected.forward.row(num_frames - 1).sum()), 1e-9);
    }
  }
}

// Where both ways meet does not matter: every frame gives the likelihood and its posteriors.
TYPED_TEST(BothWays, MeetAtTheLikelihoodInEveryFrame) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 5);
    for (const int num_frames : {1, 3000}) {
      const auto s = TypeParam::sequence(num_frames, 6);
      const ForwardBackward found = model.forward_backward(s);
      const double tolerance = 1e-12 * std::max(1.0, std::abs(found.log_likelihood));
      EXPECT_NEAR(found.log_likelihood, model.log_likelihood_exact(s), tolerance);
      MatrixD posteriors;
      EXPECT_NEAR(model.state_posteriors(s, &posteriors), found.log_likelihood, tolerance);
      EXPECT_EQ(posteriors, model.posterior(s));
      const MatrixD met = (found.log_forward + found.log_backward).array() - found.log_likelihood;
      EXPECT_LT((met.array().exp() - posteriors.array()).abs().maxCoeff(), 1e-9);
      EXPECT_LT((posteriors.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
    }
  }
}

TEST(BothWaysOfSymbols, EndWhereTheSequenceIsImpossible) {
  MatrixD emission(2, 2);
  emission << 1, 0, 0, 1;
  const DiscreteHmm model(MarkovChain::initial({Kind::left_right, 2, 1}), emission);
  const SymbolSequence impossible{0, 1, 0, 1};
  const ForwardBackward found = model.forward_backward(impossible);
  EXPECT_EQ(found.log_likelihood, -kInfinity);
  EXPECT_GT(found.log_forward(1, 1), -kInfinity);
  EXPECT_EQ(found.log_forward.bottomRows(2).maxCoeff(), -kInfinity);
  EXPECT_EQ(found.log_backward.row(0).maxCoeff(), -kInfinity);
  EXPECT_GT(found.log_backward(1, 0), -kInfinity);  // were the chain still there
  EXPECT_FALSE(found.log_forward.array().isNaN().any() || found.log_backward.array().isNaN().any());
  MatrixD posteriors;
  EXPECT_EQ(model.state_posteriors(impossible, &posteriors), -kInfinity);
  EXPECT_EQ(posteriors, MatrixD::Zero(4, 2));
}

TYPED_TEST(BothWays, RefuseEmptyInput) {
  const auto model = TypeParam::make({Kind::left_right, 3, 1}, 1);
  const auto none = TypeParam::sequence(0, 1);
  MatrixD posteriors;
  EXPECT_THROW(static_cast<void>(model.forward_backward(none)), InvalidArgument);
  EXPECT_THROW(model.state_posteriors(none, &posteriors), InvalidArgument);
}

TEST(BothWaysOfSymbols, RefuseUnknownSymbols) {
  const DiscreteHmm model = DiscreteCase::make({Kind::ergodic, 3, 1}, 1);
  for (const std::int32_t unknown : {-1, DiscreteCase::kNumLetters}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "position 2", message_of<InvalidArgument>([&] {
                          return model.forward_backward(SymbolSequence{0, 1, unknown});
                        }));
  }
}

TEST(BothWaysOfFrames, RefuseWhatIsNotFiniteOrOfAnotherWidth) {
  const GaussianMixtureHmm model = GaussianCase::make({Kind::ergodic, 3, 1}, 1);
  for (const float bad : {std::nanf(""), HUGE_VALF}) {
    MatrixF frames = GaussianCase::sequence(5, 2);
    frames(3, 1) = bad;
    EXPECT_THROW(static_cast<void>(model.forward_backward(frames)), InvalidArgument);
    MatrixD posteriors;
    EXPECT_THROW(model.state_posteriors(frames, &posteriors), InvalidArgument);
  }
  EXPECT_THROW(static_cast<void>(model.forward_backward(MatrixF::Zero(5, 1))), InvalidArgument);
}

}  // namespace
}  // namespace hri
