// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Writes ONNX files of such networks as onnx_network.hpp reads, and of some that it refuses.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "hri/models/network/conv_network.hpp"

namespace hri::testing_data {

class OnnxWriter {
 public:
  bool raw = true;  ///< numbers as bytes
  int stride = 1;
  bool chained = true;
  bool shared = false;  ///< every layer names the weights of the first one
  std::string activation = "LeakyRelu";

  std::string model(int bands, const std::vector<ConvLayer>& layers) {
    std::string graph;
    std::string value = "input";
    add_node("Reshape", {value, "shape"}, &graph);
    value = last_;
    for (const ConvLayer& l : layers) {
      const std::string number = std::to_string(count_);
      if (!shared || weights_.empty()) {
        weights_ = "w" + number;
        graph += tensor(weights_, {l.out_channels, l.in_channels, l.kernel_frames, l.kernel_bands},
                        transposed(l));
      }
      graph += tensor("b" + number, {l.out_channels}, l.bias);
      graph += tensor("m" + number, {1, 1, 1, 1}, {l.floor});
      add_node("Conv", {value, weights_, "b" + number}, &graph,
               integers("pads", {0, l.pad_bands, 0, l.pad_bands}) +
                   integers("strides", {stride, stride}));
      add_node(activation, {chained ? last_ : "elsewhere"}, &graph, real("alpha", l.slope));
      add_node("Max", {last_, "m" + number}, &graph);
      const std::vector<int> pool{l.pool_frames, l.pool_bands};
      add_node("MaxPool", {last_}, &graph,
               integers("kernel_shape", pool) + integers("strides", pool));
      value = last_;
    }
    const std::string shape = bytes(1, varint(1, 1)) + bytes(1, varint(1, 30)) +
                              bytes(1, varint(1, static_cast<std::uint64_t>(bands))) +
                              bytes(1, varint(1, 1));
    graph += bytes(11, bytes(1, "input") + bytes(2, bytes(1, varint(1, 1) + bytes(2, shape))));
    return varint(1, 8) + bytes(7, graph);
  }

 private:
  static std::string digits(std::uint64_t value) {
    std::string result;
    for (; value >= 0x80U; value >>= 7U) result += static_cast<char>((value & 0x7FU) | 0x80U);
    return result + static_cast<char>(value);
  }
  static std::string varint(std::uint64_t field, std::uint64_t value) {
    return digits(field << 3U) + digits(value);
  }
  static std::string bytes(std::uint64_t field, const std::string& content) {
    return digits((field << 3U) | 2U) + digits(content.size()) + content;
  }
  static std::string as_bytes(const std::vector<float>& values) {
    std::string result(values.size() * sizeof(float), '\0');
    std::memcpy(result.data(), values.data(), result.size());
    return result;
  }

  [[nodiscard]] std::string tensor(const std::string& name, const std::vector<int>& dims,
                                   const std::vector<float>& values) const {
    std::string content;
    for (const int d : dims) content += varint(1, static_cast<std::uint64_t>(d));
    content += varint(2, 1) + bytes(8, name) + bytes(raw ? 9 : 4, as_bytes(values));
    return bytes(5, content);
  }

  static std::string integers(const std::string& name, const std::vector<int>& values) {
    std::string content = bytes(1, name);
    for (const int v : values) content += varint(8, static_cast<std::uint64_t>(v));
    return bytes(5, content);
  }
  static std::string real(const std::string& name, float value) {
    return bytes(5, bytes(1, name) + digits((2U << 3U) | 5U) + as_bytes({value}));
  }

  void add_node(const std::string& kind, const std::vector<std::string>& inputs, std::string* graph,
                const std::string& attributes = "") {
    std::string content;
    for (const std::string& input : inputs) content += bytes(1, input);
    last_ = "v" + std::to_string(count_++);
    content += bytes(2, last_) + bytes(4, kind) + attributes;
    *graph += bytes(1, content);
  }

  // (frames, bands, in, out) as (out, in, frames, bands).
  static std::vector<float> transposed(const ConvLayer& l) {
    std::vector<float> result;
    const int taps = l.kernel_frames * l.kernel_bands;
    for (int o = 0; o < l.out_channels; ++o) {
      for (int i = 0; i < l.in_channels; ++i) {
        for (int k = 0; k < taps; ++k)
          result.push_back(
              l.weights[static_cast<std::size_t>((k * l.in_channels + i) * l.out_channels + o)]);
      }
    }
    return result;
  }

  int count_ = 0;
  std::string last_;
  std::string weights_;
};

}  // namespace hri::testing_data
