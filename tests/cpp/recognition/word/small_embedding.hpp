// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A speech embedding of random weights.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/recognition/word/speech_embedding.hpp"
#include "models/network/onnx_writer.hpp"
#include "models/network/random_layers.hpp"

namespace hri::testing_data {

/// Of four outputs, over windows of `window` and 7 frames.
inline SpeechEmbedding small_embedding(const SpeechEmbeddingOptions& options = {}, int bands = 32,
                                       int window = 9) {
  std::vector<ConvLayer> layers{random_layer(window, 3, 1, 8), random_layer(1, 1, 8, 4)};
  layers[0].pool_frames = 8;
  layers[0].pool_bands = layers[1].pool_bands = 5;
  const std::string bytes = OnnxWriter().model(bands, layers);
  return SpeechEmbedding::parse({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                                "small.onnx", options);
}

}  // namespace hri::testing_data
