// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Adaptation of Gaussian-mixture HMMs to new data: each model for itself, and all together.
#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "hri/models/adaptation/linear_adaptation.hpp"
#include "hri/models/adaptation/map_adaptation.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using testing_data::noise;

// One state, one Gaussian: what adaptation gives can be worked out by hand.
GaussianMixtureHmm single(double mean, double variance, int dim = 2) {
  Topology topology;
  topology.num_states = 1;
  return {MarkovChain::initial(topology),
          MixtureBank(MatrixD::Ones(1, 1), MatrixD::Constant(1, dim, mean),
                      MatrixD::Constant(1, dim, variance))};
}

TEST(MapAdaptation, WeighsNewFramesAgainstThePrior) {
  MapAdaptationOptions options;
  options.prior_frames = 10;
  const MatrixF frames = MatrixF::Constant(30, 2, 4.0F);
  const GaussianMixtureHmm adapted = adapt_map(single(0, 1), {frames}, options);
  // Ten frames of mean 0 and variance 1 with thirty of mean 4 and variance 0.
  EXPECT_NEAR(adapted.bank().means()(0, 0), 3.0, 1e-12);
  EXPECT_NEAR(adapted.bank().variances()(0, 1), (10 * 1.0 + 30 * 16.0) / 40 - 9.0, 1e-12);
}

TEST(MapAdaptation, NeverMakesANeedle) {
  MapAdaptationOptions options;
  options.prior_frames = 1e-3;
  const GaussianMixtureHmm adapted =
      adapt_map(single(4, 1), {MatrixF::Constant(1000, 2, 4.0F)}, options);
  EXPECT_NEAR(adapted.bank().variances()(0, 0), 0.1, 1e-9);
}

TEST(MapAdaptation, WithoutDataIsTheModelItself) {
  const GaussianMixtureHmm model = single(1, 2);
  EXPECT_EQ(adapt_map(model, {}, {}).bank().means(), model.bank().means());
}

TEST(MapAdaptation, RaisesTheLikelihoodOfWhatItMet) {
  GaussianMixtureHmmOptions options;
  options.topology = {Topology::Kind::left_right, 3, 1};
  options.num_mixtures = 2;
  const auto model = GaussianMixtureHmm::train({noise(40, 3, 1), noise(40, 3, 2)}, options);
  const MatrixF heard = (noise(30, 3, 3).array() + 0.7F).matrix();
  EXPECT_GT(adapt_map(model, {heard}, {}).log_likelihood(heard), model.log_likelihood(heard));
}

TEST(MapAdaptation, RefusesBadInput) {
  MapAdaptationOptions options;
  options.prior_frames = 0;
  EXPECT_THROW(adapt_map(single(0, 1), {noise(5, 2, 1)}, options), InvalidArgument);
  EXPECT_THROW(adapt_map(single(0, 1), {noise(5, 3, 1)}, {}), InvalidArgument);
  MatrixF bad = noise(5, 2, 1);
  bad(3, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(adapt_map(single(0, 1), {bad}, {}), InvalidArgument);
}

TEST(LinearAdaptation, FindsTheChangeThatAllShare) {
  // Two words at 0 and 10; the new voice says them at 1 and 9, with nine times the variance.
  const std::vector<GaussianMixtureHmm> models{single(0, 1), single(10, 1)};
  const MatrixF low = (3.0F * noise(4000, 2, 1).array() + 1.0F).matrix();
  const MatrixF high = (3.0F * noise(4000, 2, 2).array() + 9.0F).matrix();
  const LinearAdaptation found = estimate_linear_adaptation(models, {{low}, {high}}, 1, {});
  EXPECT_NEAR(found.slope[0], 0.8, 0.02);
  EXPECT_NEAR(found.offset[1], 1.0, 0.1);
  EXPECT_NEAR(found.spread[0], 9.0, 0.4);
  const MixtureBank adapted = found.apply(models[1].bank());
  EXPECT_NEAR(adapted.means()(0, 0), 9.0, 0.15);
  EXPECT_NEAR(adapted.variances()(0, 0), 9.0, 0.4);
}

TEST(LinearAdaptation, MovesWordsThatWereNotHeard) {
  const std::vector<GaussianMixtureHmm> models{single(0, 1), single(10, 1)};
  const LinearAdaptation found =
      estimate_linear_adaptation(models, {{(noise(500, 2, 1).array() + 2.0F).matrix()}, {}}, 1, {});
  EXPECT_NEAR(found.apply(models[0].bank()).means()(0, 0), 2.0, 0.2);
  EXPECT_GT(found.apply(models[1].bank()).means()(0, 0), 8.0);
}

TEST(LinearAdaptation, StaysNearTheIdentityWithoutData) {
  const std::vector<GaussianMixtureHmm> models{single(0, 1), single(10, 4)};
  const LinearAdaptation found = estimate_linear_adaptation(models, {{}, {}}, 100, {});
  EXPECT_TRUE(found.slope.isOnes(1e-9));
  EXPECT_TRUE(found.offset.isZero(1e-9));
  EXPECT_TRUE(found.spread.isOnes(1e-9));
}

TEST(LinearAdaptation, RefusesListsThatDoNotFit) {
  EXPECT_THROW(estimate_linear_adaptation({}, {}, 1, {}), InvalidArgument);
  EXPECT_THROW(estimate_linear_adaptation({single(0, 1)}, {{}, {}}, 1, {}), InvalidArgument);
  EXPECT_THROW(estimate_linear_adaptation({single(0, 1)}, {{}}, 0, {}), InvalidArgument);
}

}  // namespace
}  // namespace hri
