// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Descriptors of a hand's shape allocate nothing once the thread has computed some before.
#include "hri/features/hand/hand_features.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "features/hand_testing.hpp"
#include "hri/features/hand/hand_track.hpp"

namespace hri {
namespace {

using testing_data::allocations_of;

TEST(HandDescriptors, AllocateNothingTheSecondTime) {
  HandFeatureOptions options;
  options.use_cepstrum = false;
  options.use_wavelet = options.use_moments = options.use_fourier = options.use_chain_code = true;
  for (const auto source :
       {WaveletDescriptorSource::silhouette, WaveletDescriptorSource::contour}) {
    options.wavelet.source = source;
    const HandFeatureComputer computer(options);
    const GreyImage mask = hand_testing::hand(4);
    const GreyImage grey = hand_testing::grey(mask);
    std::vector<float> out(static_cast<std::size_t>(computer.num_features()));
    const auto compute = [&] { computer.compute(grey.view(), mask.view(), out); };
    compute();
    EXPECT_EQ(allocations_of(compute), 0);
  }
}

TEST(HandTracks, AllocateNothing) {
  const HandTrackComputer computer({});
  const GreyImage mask = hand_testing::hand(4);
  const std::vector<ImageView> masks(5, mask.view());
  MatrixF out(5, computer.num_features());
  EXPECT_EQ(allocations_of([&] { computer.compute(masks, out); }), 0);
}

}  // namespace
}  // namespace hri
