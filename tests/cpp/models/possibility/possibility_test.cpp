// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibility.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

// Thesis table 4.1, first row: crude oil, natural gas, coal, nuclear. The largest is 0.9, so
// necessity may exceed possibility there; the property is tested on a distribution with maximum 1.
const std::vector<double> kCell{0.9, 0.7, 0.8, 0.3};
const std::vector<double> kDistribution{1.0, 0.8, 0.7, 0.3};

TEST(Possibility, IsTheMaximumOverTheEvent) {
  EXPECT_EQ(possibility_of(kCell, {0, 2}), 0.9);  // eq. 4.3
  EXPECT_EQ(possibility_of(kDistribution, {1, 2}), 0.8);
  EXPECT_EQ(possibility_of(kDistribution, {}), 0.0);
  EXPECT_EQ(possibility_of(kDistribution, {0, 1, 2, 3}), 1.0);
}

TEST(Necessity, LooksAtTheComplement) {
  EXPECT_NEAR(necessity_of(kCell, {0, 2}), 0.3, 1e-15);  // eq. 4.4, which prints 0.2
  EXPECT_NEAR(necessity_of(kDistribution, {0, 1, 2}), 0.7, 1e-15);
  EXPECT_NEAR(necessity_of(kDistribution, {0}), 0.2, 1e-15);
  EXPECT_EQ(necessity_of(kDistribution, {1, 2}), 0.0);
  EXPECT_EQ(necessity_of(kDistribution, {0, 1, 2, 3}), 1.0);
}

TEST(Necessity, NeverExceedsPossibility) {
  for (int bits = 0; bits < 16; ++bits) {
    std::vector<int> event;
    for (int i = 0; i < 4; ++i) {
      if ((bits >> i & 1) != 0) event.push_back(i);
    }
    EXPECT_LE(necessity_of(kDistribution, event), possibility_of(kDistribution, event));
  }
}

TEST(Possibility, RefusesWhatIsNoDistributionOrEvent) {
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "distribution[1]", message_of<InvalidArgument>([] {
                        possibility_of(std::vector<double>{1, 1.5}, {0});
                      }));
  EXPECT_THROW(possibility_of(std::vector<double>{std::nan("")}, {0}), InvalidArgument);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "outcome 4",
                      message_of<InvalidArgument>([] { necessity_of(kDistribution, {4}); }));
}

TEST(Possibilities, DivideByTheLargestDensity) {
  VectorF log_densities(3);
  log_densities << -1000.0F, -1000.0F + std::log(0.25F), -2000.0F;
  const Possibilities p = possibilities(log_densities);
  EXPECT_FLOAT_EQ(p.possibility[0], 1.0F);
  EXPECT_NEAR(p.possibility[1], 0.25F, 1e-4);
  EXPECT_EQ(p.possibility[2], 0.0F);
  EXPECT_NEAR(p.necessity[0], 0.75F, 1e-4);
  EXPECT_EQ(p.necessity[1], 0.0F);
}

TEST(Possibilities, KnowNothingWhereAllDensitiesVanish) {
  const Possibilities p =
      possibilities(VectorF::Constant(3, -std::numeric_limits<float>::infinity()));
  EXPECT_EQ(p.possibility, VectorF::Ones(3));
  EXPECT_EQ(p.necessity, VectorF::Zero(3));
}

TEST(Possibilities, RefuseNan) {
  VectorF log_densities(2);
  log_densities << 0.0F, kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "log_densities[1]",
                      message_of<InvalidArgument>([&] { possibilities(log_densities); }));
  EXPECT_THROW(possibilities(VectorF()), InvalidArgument);
}

}  // namespace
}  // namespace hri
