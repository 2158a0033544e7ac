// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The decoder of connected words allocates nothing a frame.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "language/decoding_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(ConnectedDecoder, AllocatesNothingAFrame) {
  const std::vector<WordChain> chains{random_chain(3, 1), random_chain(3, 2),
                                      random_chain(1, 3, 1, true)};
  ConnectedDecoder decoder(chains, WordNetwork::loop(2, 2));
  const MatrixF scores = random_scores(2000, 7, 1);
  EXPECT_EQ(allocations_of([&] {
              for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
            }),
            0);
  EXPECT_GT(decoder.finish().words.size(), 100U);
}

}  // namespace
}  // namespace hri
