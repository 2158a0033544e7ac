// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The decoder of connected words and its possibilities allocate nothing a frame.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "hri/language/word_emissions.hpp"
#include "language/decoding_testing.hpp"
#include "models/model_testing.hpp"

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

TEST(CodedPossibilities, AllocateNothingTheSecondTime) {
  const MatrixF frames = testing_data::noise(200, 3, 1);
  const GaussianEmissions models({GaussianMixtureHmm::train({frames}, {})});
  CodebookOptions options;
  options.num_codewords = 8;
  const std::vector<int> widths{1, 1, 1};
  const CodedPossibilities possibilities(models,
                                         MultiStreamCodebook::train_lbg(frames, widths, options));
  MatrixF scores(frames.rows(), possibilities.num_states());
  possibilities.compute(frames, scores);
  EXPECT_EQ(allocations_of([&] { possibilities.compute(frames, scores); }), 0);
}

}  // namespace
}  // namespace hri
