// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/network/conv_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "models/network/conv_kernels.hpp"
#include "models/network/random_layers.hpp"

namespace hri {
namespace {

using testing_data::random_frames;
using testing_data::random_layer;

// The definition, one value after the other. Maps: [frame][band * channels + channel].
MatrixF naive(const MatrixF& frames, const std::vector<ConvLayer>& layers) {
  MatrixF map = frames;
  for (const ConvLayer& l : layers) {
    const int bands = static_cast<int>(map.cols()) / l.in_channels;
    const int out_frames = static_cast<int>(map.rows()) - l.kernel_frames + 1;
    const int out_bands = bands + 2 * l.pad_bands - l.kernel_bands + 1;
    MatrixF conv(out_frames, out_bands * l.out_channels);
    for (int t = 0; t < out_frames; ++t) {
      for (int b = 0; b < out_bands; ++b) {
        for (int o = 0; o < l.out_channels; ++o) {
          double sum = static_cast<double>(l.bias[static_cast<std::size_t>(o)]);
          for (int kt = 0; kt < l.kernel_frames; ++kt) {
            for (int kb = 0; kb < l.kernel_bands; ++kb) {
              const int band = b + kb - l.pad_bands;
              if (band < 0 || band >= bands) continue;
              for (int i = 0; i < l.in_channels; ++i) {
                const int w = ((kt * l.kernel_bands + kb) * l.in_channels + i) * l.out_channels + o;
                sum += static_cast<double>(map(t + kt, band * l.in_channels + i)) *
                       static_cast<double>(l.weights[static_cast<std::size_t>(w)]);
              }
            }
          }
          const auto x = static_cast<float>(sum);
          conv(t, b * l.out_channels + o) = std::max(x > 0 ? x : l.slope * x, l.floor);
        }
      }
    }
    map.resize(out_frames / l.pool_frames, (out_bands / l.pool_bands) * l.out_channels);
    for (Eigen::Index t = 0; t < map.rows(); ++t) {
      for (Eigen::Index b = 0; b < out_bands / l.pool_bands; ++b) {
        for (int o = 0; o < l.out_channels; ++o) {
          float largest = -std::numeric_limits<float>::infinity();
          for (int i = 0; i < l.pool_frames; ++i) {
            for (int j = 0; j < l.pool_bands; ++j) {
              largest = std::max(largest, conv(t * l.pool_frames + i,
                                               (b * l.pool_bands + j) * l.out_channels + o));
            }
          }
          map(t, b * l.out_channels + o) = largest;
        }
      }
    }
  }
  return map;
}

// Channels in and beside whole panels, padded bands, pools of either direction.
std::vector<ConvLayer> some_layers() {
  std::vector<ConvLayer> layers{random_layer(3, 3, 1, 24), random_layer(1, 3, 24, 31),
                                random_layer(3, 1, 31, 50), random_layer(2, 2, 50, 5)};
  layers[0].pad_bands = layers[1].pad_bands = 1;
  layers[1].pool_frames = 2;
  layers[1].pool_bands = 2;
  layers[2].pool_bands = 2;
  layers[3].slope = 1;
  layers[3].floor = -std::numeric_limits<float>::infinity();
  return layers;
}

TEST(ConvNetwork, IsItsDefinition) {
  const std::vector<ConvLayer> layers = some_layers();
  const ConvNetwork network(13, layers);
  const MatrixF frames = random_frames(40, 13);
  const MatrixF expected = naive(frames, layers);
  const MatrixF result = network.compute(frames);
  ASSERT_EQ(result.rows(), expected.rows());
  ASSERT_EQ(result.cols(), expected.cols());
  EXPECT_EQ(network.num_outputs(), expected.cols());
  EXPECT_EQ(network.num_rows(40), expected.rows());
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-4F * expected.cwiseAbs().maxCoeff());
}

TEST(ConvNetwork, GivesAWindowWhatItGivesTheWhole) {
  const ConvNetwork network(13, some_layers());
  EXPECT_EQ(network.step_frames(), 2);
  EXPECT_EQ(network.window_frames(), 10);
  EXPECT_EQ(network.num_rows(9), 0);
  const MatrixF frames = random_frames(331, 13);
  const MatrixF whole = network.compute(frames);
  ASSERT_EQ(whole.rows(), 161);  // more than are computed at once
  for (int row = 0; row < whole.rows(); ++row) {
    const MatrixF alone = network.compute(frames.middleRows(2 * row, 10));
    EXPECT_EQ(alone, whole.row(row)) << row;
  }
  EXPECT_EQ(network.compute(frames.topRows(9)).rows(), 0);
}

// Pools of 1, 2, 1, 2, 2 frames: a step of 8, which windows share in part or not at all.
TEST(ConvNetwork, GivesWindowsBetweenStepsWhatTheyGiveAlone) {
  std::vector<ConvLayer> layers{random_layer(3, 3, 1, 24), random_layer(2, 1, 24, 26),
                                random_layer(3, 3, 26, 5), random_layer(1, 1, 5, 7),
                                random_layer(2, 3, 7, 4)};
  for (const std::size_t i : {1, 3, 4}) layers[i].pool_frames = 2;
  const ConvNetwork network(13, layers);
  ASSERT_EQ(network.step_frames(), 8);
  const int window = network.window_frames();
  for (const int rows_per_step : {1, 2, 4, 8}) {
    const int shift = 8 / rows_per_step;
    for (const int rows : {1, 2, 3, 64 * rows_per_step + 1}) {
      const MatrixF frames = random_frames(window + (rows - 1) * shift + shift - 1, 13);
      const MatrixF whole = network.compute(frames, rows_per_step);
      ASSERT_EQ(whole.rows(), rows) << rows_per_step;
      for (int row = 0; row < rows; ++row) {
        const MatrixF alone = network.compute(frames.middleRows(row * shift, window));
        EXPECT_EQ(alone, whole.row(row)) << rows_per_step << " " << row;
      }
    }
    EXPECT_EQ(network.compute(random_frames(window - 1, 13), rows_per_step).rows(), 0);
  }
  for (const int rows_per_step : {-1, 0, 3, 16})
    EXPECT_THROW((void)network.compute(random_frames(99, 13), rows_per_step), InvalidArgument);
}

TEST(ConvNetwork, IsTheSameOnEveryInstructionSet) {
  std::vector<float> in(4000), weights(3 * 7 * detail::kPanel), bias(detail::kPanel);
  const MatrixF numbers = random_frames(1, 6000);
  std::copy_n(numbers.data(), in.size(), in.begin());
  std::copy_n(numbers.data() + 500, weights.size(), weights.begin());
  std::copy_n(numbers.data() + 5000, bias.size(), bias.begin());
  const std::vector<std::ptrdiff_t> places{0, 7, 14, 100, 700, 711, 2}, taps{0, 70, 140};
  const detail::ConvPanel panel{places, taps, 7, weights.data(), bias.data(), 0.2F, -0.4F};
  std::vector<std::vector<float>> found;
  for (const detail::ConvKernels* kernels : detail::all_conv_kernels()) {
    std::vector<float> out(places.size() * 30, 9.0F);
    kernels->convolve(panel, in.data(), 30, out.data());
    found.push_back(out);
    EXPECT_EQ(found.back(), found.front());
    EXPECT_EQ(out[24], 9.0F);
    EXPECT_GE(*std::min_element(out.begin(), out.end()), -0.4F);
  }
}

void expect_refused(const std::vector<ConvLayer>& layers, const std::string& what, int bands = 13) {
  try {
    const ConvNetwork network(bands, layers);
    FAIL() << what;
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
  }
}

TEST(ConvNetwork, RefusesSizesThatDoNotFit) {
  expect_refused({}, "at least one layer");
  expect_refused(some_layers(), "num_bands", 0);
  expect_refused(some_layers(), "layer 3: no band is left of 1", 5);
  const auto changed = [](auto change) {
    std::vector<ConvLayer> layers = some_layers();
    change(&layers[1]);
    return layers;
  };
  expect_refused(changed([](ConvLayer* l) { l->in_channels = 23; }), "layer 1: in_channels is 23");
  expect_refused(changed([](ConvLayer* l) { l->weights.pop_back(); }), "layer 1: has 2231 weights");
  expect_refused(changed([](ConvLayer* l) { l->weights[3] = NAN; }), "layer 1: a weight");
  expect_refused(changed([](ConvLayer* l) { l->slope = -1; }), "activation");
  expect_refused(changed([](ConvLayer* l) { l->pool_frames = 0; }), "layer 1: pool_frames is 0");
  expect_refused(changed([](ConvLayer* l) { l->pad_bands = -1; }), "layer 1: pad_bands is -1");
  EXPECT_THROW((void)ConvNetwork(13, some_layers()).compute(random_frames(20, 12)),
               InvalidArgument);
}

}  // namespace
}  // namespace hri
