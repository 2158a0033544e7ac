// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

std::vector<float> streamed_noise(std::size_t count) {
  Random random(7);
  std::vector<float> x(count);
  for (float& v : x) v = static_cast<float>(0.1 * random.normal());
  return x;
}

TEST(CepstraStream, GivesTheBitsOfTheWholeWhateverTheBlocks) {
  const std::vector<float> x = streamed_noise(9000);
  for (const int delta_orders : {0, 1, 2}) {
    CepstraOptions options;
    options.normalisation = Normalisation::running_mean;
    options.delta_orders = delta_orders;
    options.rasta_pole = 0.94;
    const MatrixF expected = CepstraComputer(options).compute(x);
    CepstraStream stream(options);
    for (const std::size_t block : {3U, 160U, 1111U, 9000U}) {
      MatrixF found(expected.rows(), expected.cols());
      Eigen::Index count = 0;
      MatrixF out(stream.max_frames(block), stream.num_features());
      const auto keep = [&](int frames) {
        found.middleRows(count, frames) = out.topRows(frames);
        count += frames;
      };
      for (std::size_t n = 0; n < x.size(); n += block)
        keep(stream.push(Span<const float>(x).subspan(n, std::min(block, x.size() - n)), out));
      keep(stream.finish(out));
      EXPECT_EQ(count, expected.rows());
      EXPECT_EQ(found, expected) << block << ", " << delta_orders;
    }
  }
}

TEST(CepstraStream, RefusesBuffersThatMayNotDo) {
  CepstraOptions options;
  options.normalisation = Normalisation::none;
  CepstraStream stream(options);
  MatrixF small(1, 39);
  EXPECT_THROW(stream.push(streamed_noise(8000), small), InvalidArgument);
  EXPECT_THROW(stream.finish(small), InvalidArgument);
  options.normalisation = Normalisation::level;
  EXPECT_THROW(CepstraStream{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
