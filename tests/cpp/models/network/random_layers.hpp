// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Networks of random weights.
#pragma once

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"
#include "hri/models/network/conv_network.hpp"

namespace hri::testing_data {

inline ConvLayer random_layer(int frames, int bands, int in, int out) {
  Random random(static_cast<std::uint64_t>(out));
  ConvLayer layer;
  layer.kernel_frames = frames;
  layer.kernel_bands = bands;
  layer.in_channels = in;
  layer.out_channels = out;
  layer.slope = 0.2F;
  layer.floor = -0.4F;
  layer.weights.resize(static_cast<std::size_t>(frames * bands * in * out));
  for (float& w : layer.weights) w = static_cast<float>(0.3 * random.normal());
  layer.bias.resize(static_cast<std::size_t>(out));
  for (float& b : layer.bias) b = static_cast<float>(0.1 * random.normal());
  return layer;
}

inline MatrixF random_frames(int rows, int columns) {
  Random random(7);
  MatrixF frames(rows, columns);
  for (float& x : frames.reshaped()) x = static_cast<float>(random.normal());
  return frames;
}

}  // namespace hri::testing_data
