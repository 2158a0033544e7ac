// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/network/onnx_network.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "models/network/onnx_writer.hpp"
#include "models/network/random_layers.hpp"

namespace hri {
namespace {

using testing_data::OnnxWriter;
using testing_data::random_frames;
using testing_data::random_layer;

ConvNetwork parsed(const std::string& bytes) {
  return parse_onnx_network({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                            "net.onnx");
}

std::vector<ConvLayer> layers() {
  std::vector<ConvLayer> result{random_layer(3, 3, 1, 6), random_layer(3, 1, 6, 4)};
  result[0].pad_bands = 1;
  result[0].pool_frames = result[0].pool_bands = 2;
  return result;
}

TEST(OnnxNetwork, IsTheNetworkThatWasWritten) {
  const ConvNetwork expected(8, layers());
  for (const bool raw : {true, false}) {
    OnnxWriter writer;
    writer.raw = raw;
    const ConvNetwork network = parsed(writer.model(8, layers()));
    const MatrixF frames = random_frames(20, 8);
    EXPECT_EQ(network.compute(frames), expected.compute(frames));
    EXPECT_EQ(network.window_frames(), expected.window_frames());
  }
}

TEST(OnnxNetwork, RefusesEveryCutFile) {
  const std::string whole = OnnxWriter().model(8, layers());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW((void)parsed(whole.substr(0, size)), FormatError) << size;
}

TEST(OnnxNetwork, SurvivesEveryFlippedByte) {
  const std::string whole = OnnxWriter().model(8, layers());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int mask : {0x01, 0x08, 0x80, 0xFF}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ mask);
      try {
        (void)parsed(bytes).compute(random_frames(20, 8));
      } catch (const FormatError&) {
      } catch (const InvalidArgument&) {  // other bands than the frames have
      }
    }
  }
}

void expect_refused(const std::string& bytes, const std::string& what) {
  try {
    (void)parsed(bytes);
    FAIL() << what;
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).rfind("net.onnx: ", 0), 0U) << error.what();
  }
}

TEST(OnnxNetwork, SaysWhatItCannotCompute) {
  expect_refused("", "no graph");
  expect_refused("not an ONNX file at all", "no ONNX");
  OnnxWriter other;
  other.activation = "Softmax";
  expect_refused(other.model(8, layers()), "node 2 (Softmax) is none of Conv");
  OnnxWriter strided;
  strided.stride = 2;
  expect_refused(strided.model(8, layers()), "node 1 (Conv) has strides");
  OnnxWriter loose;
  loose.chained = false;
  expect_refused(loose.model(8, layers()), "does not follow the one before it");
  expect_refused(OnnxWriter().model(1, {random_layer(1, 3, 1, 2)}), "layer 0: no band is left");
  EXPECT_THROW((void)read_onnx_network("/nowhere/net.onnx"), IoError);
}

TEST(OnnxNetwork, RefusesBiasesThatDoNotFit) {
  std::vector<ConvLayer> other_bias = layers();
  other_bias[1].bias.push_back(0.0F);
  expect_refused(OnnxWriter().model(8, other_bias), "(Conv) has other biases than channels");
}

// 200 layers would copy 200 times what the file holds.
TEST(OnnxNetwork, RefusesWeightsThatManyLayersShare) {
  OnnxWriter writer;
  writer.shared = true;
  const std::vector<ConvLayer> same(200, random_layer(4, 1, 1, 1));
  expect_refused(writer.model(8, same), "(Conv) has weights that layers before it have, too");
}

}  // namespace
}  // namespace hri
