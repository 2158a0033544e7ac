// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/network_part.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hri::detail {
namespace {

constexpr int kDim = 5;
constexpr int kNumClasses = 3;

SequenceNetworkOptions small_options(double dropout) {
  SequenceNetworkOptions options;
  options.num_channels = 8;
  options.num_blocks = 2;
  options.dropout = dropout;
  return options;
}

MatrixF random_frames(int frames, Random* random) {
  MatrixF result(frames, kDim);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result.data()[i] = static_cast<float>(random->normal());
  return result;
}

void fill(NetworkPart* part) {
  Random random(7);
  part->clear();
  for (int i = 0; i < 6; ++i) part->add(random_frames(9 + 2 * (i % 3), &random), i % kNumClasses);
}

class NetworkSlopes : public testing::TestWithParam<double> {};

// Central differences of the loss, along random directions within each slot of values.
TEST_P(NetworkSlopes, AreThoseOfTheLoss) {
  const SequenceNetworkOptions options = small_options(GetParam());
  const NetworkLayout layout(kDim, kNumClasses, options);
  VectorF values = layout.initial(3);
  Random random(11);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] += static_cast<float>(0.1 * random.normal());
  NetworkPart part(layout);
  const auto loss_at = [&](const VectorF& at) {
    fill(&part);
    Random dropout(5);
    part.run(at, options, &dropout);
    return part.loss();
  };
  loss_at(values);
  const VectorF slopes = part.slopes();
  std::vector<Slot> slots{layout.head_weights(), layout.head_bias()};
  for (const UnitSlots& unit : layout.units())
    slots.insert(slots.end(), {unit.kernel, unit.weights, unit.scale, unit.shift});
  for (const Slot& slot : slots) {
    VectorF direction = VectorF::Zero(values.size());
    for (Eigen::Index i = 0; i < slot.size(); ++i)
      direction[slot.first + i] = static_cast<float>(random.normal());
    direction /= direction.norm();
    const float step = 1e-4F;  // small, so that few values cross the corner of relu
    const double difference =
        (loss_at(values + step * direction) - loss_at(values - step * direction)) / (2.0 * step);
    const auto slope = static_cast<double>(slopes.dot(direction));
    EXPECT_NEAR(slope, difference, 0.03 * std::abs(difference) + 0.03)
        << "slot at " << slot.first << " of shape " << slot.rows << " x " << slot.cols;
  }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutDropout, NetworkSlopes, testing::Values(0.0, 0.2));

TEST(NetworkPart, NormalisesByTheStatisticsOfItsExamples) {
  const SequenceNetworkOptions options = small_options(0);
  const NetworkLayout layout(kDim, kNumClasses, options);
  NetworkPart part(layout);
  fill(&part);
  part.measure(layout.initial(3));
  EXPECT_EQ(part.means().size(), layout.num_statistics());
  EXPECT_GT(part.variances().minCoeff(), 0);
  // Of other values, other statistics; of the same, the same again.
  const VectorF before = part.variances();
  part.measure(layout.initial(4));
  EXPECT_NE(part.variances(), before);
  part.measure(layout.initial(3));
  EXPECT_EQ(part.variances(), before);
}

}  // namespace
}  // namespace hri::detail
