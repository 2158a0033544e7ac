// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Field numbers are those of onnx.proto3 (IR version 3 and later).
#include "hri/models/network/onnx_network.hpp"

#include <cstring>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "io/protobuf.hpp"

namespace hri {
namespace {

using detail::ProtobufField;
using detail::ProtobufReader;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 25U;
constexpr std::size_t kMaxNodes = 1000;

struct Tensor {
  std::vector<std::int64_t> dims;
  std::vector<float> floats;           // where it holds float32
  std::vector<std::int64_t> integers;  // where it holds int64
};

struct Attribute {
  float number = 0;
  std::int64_t integer = 0;
  std::string text;
  std::vector<std::int64_t> integers;
};

struct Node {
  std::string kind;
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  std::map<std::string, Attribute> attributes;
};

struct Graph {
  std::vector<Node> nodes;
  std::map<std::string, Tensor> tensors;
  std::vector<std::pair<std::string, std::vector<std::int64_t>>> inputs;  // names and shapes
};

float as_float(std::uint64_t bits) {
  const auto low = static_cast<std::uint32_t>(bits);
  float value = 0;
  std::memcpy(&value, &low, sizeof(value));
  return value;
}

class OnnxReader {
 public:
  explicit OnnxReader(const std::string& name) : name_(name) {}

  Graph model(Span<const std::uint8_t> bytes) {
    Graph graph;
    bool found = false;
    each(bytes, [&](const ProtobufField& f) {
      if (f.number != 7 || !f.has_bytes) return;
      found = true;
      each(f.bytes, [&](const ProtobufField& part) { add(part, &graph); });
    });
    if (!found) fail(ErrorKind::format, name_ + ": has no graph: is no ONNX file");
    return graph;
  }

 private:
  template <class Visit>
  void each(Span<const std::uint8_t> bytes, const Visit& visit) {
    ProtobufReader reader(bytes, name_);
    ProtobufField field;
    while (reader.next(&field)) visit(field);
  }

  void add(const ProtobufField& part, Graph* graph) {
    if (!part.has_bytes) return;
    if (part.number == 1) {
      if (graph->nodes.size() == kMaxNodes) fail(ErrorKind::format, name_ + ": too many nodes");
      graph->nodes.push_back(node(part.bytes));
    } else if (part.number == 5) {
      std::pair<std::string, Tensor> read = tensor(part.bytes);
      graph->tensors[read.first] = std::move(read.second);
    } else if (part.number == 11) {
      graph->inputs.push_back(value_info(part.bytes));
    }
  }

  Node node(Span<const std::uint8_t> bytes) {
    Node result;
    each(bytes, [&](const ProtobufField& f) {
      if (!f.has_bytes) return;
      if (f.number == 1) result.inputs.push_back(f.text());
      if (f.number == 2) result.outputs.push_back(f.text());
      if (f.number == 4) result.kind = f.text();
      if (f.number == 5) result.attributes.insert(attribute(f.bytes));
    });
    return result;
  }

  std::pair<std::string, Attribute> attribute(Span<const std::uint8_t> bytes) {
    std::pair<std::string, Attribute> result;
    each(bytes, [&](const ProtobufField& f) {
      Attribute& a = result.second;
      if (f.number == 1 && f.has_bytes) result.first = f.text();
      if (f.number == 2) a.number = as_float(f.value);
      if (f.number == 3) a.integer = static_cast<std::int64_t>(f.value);
      if (f.number == 4 && f.has_bytes) a.text = f.text();
      if (f.number == 8) add_integers(f, &a.integers);
    });
    return result;
  }

  std::pair<std::string, Tensor> tensor(Span<const std::uint8_t> bytes) {
    std::pair<std::string, Tensor> result;
    std::uint64_t kind = 0;
    Span<const std::uint8_t> raw;
    each(bytes, [&](const ProtobufField& f) {
      Tensor& t = result.second;
      if (f.number == 1) add_integers(f, &t.dims);
      if (f.number == 2) kind = f.value;
      if (f.number == 4) add_floats(f, &t.floats);
      if (f.number == 7) add_integers(f, &t.integers);
      if (f.number == 8 && f.has_bytes) result.first = f.text();
      if (f.number == 9) raw = f.bytes;
    });
    if (kind == 1) copy_raw(raw, &result.second.floats);
    if (kind == 7) copy_raw(raw, &result.second.integers);
    return result;
  }

  template <class T>
  static void copy_raw(Span<const std::uint8_t> raw, std::vector<T>* to) {
    const std::size_t count = raw.size() / sizeof(T);
    const std::size_t before = to->size();
    to->resize(before + count);
    if (count > 0) std::memcpy(to->data() + before, raw.data(), count * sizeof(T));
  }

  void add_integers(const ProtobufField& field, std::vector<std::int64_t>* to) {
    if (!field.has_bytes) {
      to->push_back(static_cast<std::int64_t>(field.value));
      return;
    }
    ProtobufReader packed(field.bytes, name_);
    std::uint64_t value = 0;
    while (packed.next_varint(&value)) to->push_back(static_cast<std::int64_t>(value));
  }

  static void add_floats(const ProtobufField& field, std::vector<float>* to) {
    if (field.has_bytes) {
      copy_raw(field.bytes, to);
    } else {
      to->push_back(as_float(field.value));
    }
  }

  // Of a tensor type: dimensions that are not known are 0.
  std::pair<std::string, std::vector<std::int64_t>> value_info(Span<const std::uint8_t> bytes) {
    std::pair<std::string, std::vector<std::int64_t>> result;
    each(bytes, [&](const ProtobufField& f) {
      if (f.number == 1 && f.has_bytes) result.first = f.text();
      if (f.number != 2 || !f.has_bytes) return;
      each(f.bytes, [&](const ProtobufField& type) {
        if (type.number != 1 || !type.has_bytes) return;
        each(type.bytes, [&](const ProtobufField& shape) {
          if (shape.number != 2 || !shape.has_bytes) return;
          each(shape.bytes, [&](const ProtobufField& dim) {
            std::int64_t size = 0;
            each(dim.bytes, [&](const ProtobufField& d) {
              if (d.number == 1) size = static_cast<std::int64_t>(d.value);
            });
            result.second.push_back(size);
          });
        });
      });
    });
    return result;
  }

  const std::string& name_;
};

// The chain of layers of a graph.
class LayerChain {
 public:
  LayerChain(const Graph& graph, const std::string& name) : graph_(graph), name_(name) {}

  ConvNetwork network() {
    const std::string* value = first_input();
    for (index_ = 0; index_ < graph_.nodes.size(); ++index_) {
      const Node& node = graph_.nodes[index_];
      if (node.inputs.empty() || node.outputs.size() != 1 || node.inputs.front() != *value)
        refuse("does not follow the one before it");
      add(node);
      value = &node.outputs.front();
    }
    if (layers_.empty()) fail(ErrorKind::format, name_ + ": has no convolution");
    return checked_network();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    fail(ErrorKind::format, name_ + ": node " + std::to_string(index_) + " (" +
                                graph_.nodes[index_].kind.substr(0, 40) + ") " + what);
  }

  // The one that is no weight, shape (batch, frames, bands, 1) or (batch, 1, frames, bands).
  const std::string* first_input() {
    for (const auto& [input, shape] : graph_.inputs) {
      if (graph_.tensors.count(input) != 0) continue;
      if (shape.size() != 4) break;
      bands_ = shape[3] == 1 ? shape[2] : shape[3];
      return &input;
    }
    fail(ErrorKind::format, name_ + ": has no input of four dimensions");
  }

  ConvNetwork checked_network() const {
    const int bands = bands_ >= 1 && bands_ <= ConvNetwork::kMaxSize ? static_cast<int>(bands_) : 0;
#if defined(__cpp_exceptions)
    try {
      return ConvNetwork(bands, layers_);
    } catch (const InvalidArgument& error) {
      fail(ErrorKind::format, name_ + ": " + error.what());
    }
#else
    return ConvNetwork(bands, layers_);
#endif
  }

  void add(const Node& node) {
    const bool at_an_end = index_ == 0 || index_ + 1 == graph_.nodes.size();
    if (node.kind == "Conv") {
      add_convolution(node);
    } else if (node.kind == "Reshape" && at_an_end) {
      return;  // batches of one channel, there and back
    } else if (layers_.empty()) {
      refuse("stands before the first convolution");
    } else if (node.kind == "LeakyRelu" || node.kind == "Relu") {
      add_slope(node);
    } else if (node.kind == "Max") {
      add_floor(node);
    } else if (node.kind == "MaxPool") {
      add_pooling(node);
    } else {
      refuse("is none of Conv, LeakyRelu, Relu, Max, MaxPool");
    }
  }

  [[nodiscard]] const Tensor& tensor(const Node& node, std::size_t input) const {
    const auto found =
        input < node.inputs.size() ? graph_.tensors.find(node.inputs[input]) : graph_.tensors.end();
    if (found == graph_.tensors.end()) refuse("lacks a tensor");
    return found->second;
  }

  [[nodiscard]] std::vector<int> integers(const Node& node, const char* attribute,
                                          std::vector<int> otherwise) const {
    const auto found = node.attributes.find(attribute);
    if (found == node.attributes.end()) return otherwise;
    if (found->second.integers.size() != otherwise.size())
      refuse(std::string("has other ") + attribute + " than two dimensions have");
    for (std::size_t i = 0; i < otherwise.size(); ++i)
      otherwise[i] = size(found->second.integers[i], attribute, 0);
    return otherwise;
  }

  [[nodiscard]] int size(std::int64_t value, const char* what, std::int64_t low = 1) const {
    if (value < low || value > ConvNetwork::kMaxSize)
      refuse(std::string(what) + " is " + std::to_string(value));
    return static_cast<int>(value);
  }

  void add_convolution(const Node& node) {
    const Tensor& weights = tensor(node, 1);
    if (weights.dims.size() != 4) refuse("has weights of other than four dimensions");
    ConvLayer layer;
    layer.out_channels = size(weights.dims[0], "channels");
    layer.in_channels = size(weights.dims[1], "channels");
    layer.kernel_frames = size(weights.dims[2], "kernel");
    layer.kernel_bands = size(weights.dims[3], "kernel");
    const auto pads = integers(node, "pads", {0, 0, 0, 0});
    if (integers(node, "strides", {1, 1}) != std::vector<int>{1, 1} ||
        integers(node, "dilations", {1, 1}) != std::vector<int>{1, 1} || pads[0] != 0 ||
        pads[2] != 0 || pads[1] != pads[3] || !is_plain(node)) {
      refuse("has strides, dilations, groups or padding along time");
    }
    layer.pad_bands = pads[1];
    const auto out = static_cast<std::size_t>(layer.out_channels);
    const std::size_t rows = static_cast<std::size_t>(layer.in_channels) *
                             static_cast<std::size_t>(layer.kernel_frames) *
                             static_cast<std::size_t>(layer.kernel_bands);
    if (weights.floats.size() != out * rows) refuse("has other weights than its shape says");
    // Nodes may share weights, of which each layer has a copy: no more of them than the file has.
    num_copied_ += weights.floats.size();
    if (num_copied_ > num_floats()) refuse("has weights that layers before it have, too");
    layer.weights = transposed(weights.floats, layer);
    layer.bias.assign(out, 0.0F);
    if (node.inputs.size() > 2 && !node.inputs[2].empty()) {
      const Tensor& bias = tensor(node, 2);
      if (bias.floats.size() != out) refuse("has other biases than channels");
      layer.bias = bias.floats;
    }
    layers_.push_back(std::move(layer));
    open_ = true;
  }

  [[nodiscard]] std::size_t num_floats() const {
    std::size_t total = 0;
    for (const auto& [name, tensor] : graph_.tensors) total += tensor.floats.size();
    return total;
  }

  [[nodiscard]] static bool is_plain(const Node& node) {
    const auto group = node.attributes.find("group");
    const auto pad = node.attributes.find("auto_pad");
    return (group == node.attributes.end() || group->second.integer == 1) &&
           (pad == node.attributes.end() || pad->second.text == "NOTSET");
  }

  // (out, in, frames, bands) as (frames, bands, in, out).
  static std::vector<float> transposed(const std::vector<float>& from, const ConvLayer& layer) {
    const auto out = static_cast<std::size_t>(layer.out_channels);
    const auto in = static_cast<std::size_t>(layer.in_channels);
    const auto taps = static_cast<std::size_t>(layer.kernel_frames) *
                      static_cast<std::size_t>(layer.kernel_bands);
    std::vector<float> to(from.size());
    for (std::size_t o = 0; o < out; ++o) {
      for (std::size_t i = 0; i < in; ++i) {
        for (std::size_t k = 0; k < taps; ++k)
          to[(k * in + i) * out + o] = from[(o * in + i) * taps + k];
      }
    }
    return to;
  }

  // What follows a convolution belongs to it, until it is pooled.
  ConvLayer& open_layer() {
    if (!open_) refuse("does not follow a convolution");
    return layers_.back();
  }

  void add_slope(const Node& node) {
    ConvLayer& layer = open_layer();
    if (layer.slope != 1 || layer.floor > -std::numeric_limits<float>::infinity())
      refuse("is a second activation");
    const auto alpha = node.attributes.find("alpha");
    if (node.kind == "LeakyRelu")
      layer.slope = alpha == node.attributes.end() ? 0.01F : alpha->second.number;
    else
      layer.slope = 0;
  }

  void add_floor(const Node& node) {
    ConvLayer& layer = open_layer();
    if (node.inputs.size() != 2 || tensor(node, 1).floats.size() != 1)
      refuse("is not one with a single constant");
    if (layer.floor > -std::numeric_limits<float>::infinity()) refuse("is a second one");
    layer.floor = tensor(node, 1).floats.front();
  }

  void add_pooling(const Node& node) {
    ConvLayer& layer = open_layer();
    const std::vector<int> kernel = integers(node, "kernel_shape", {0, 0});
    if (kernel[0] < 1 || kernel[1] < 1 || integers(node, "strides", {1, 1}) != kernel ||
        integers(node, "pads", {0, 0, 0, 0}) != std::vector<int>{0, 0, 0, 0} || !is_plain(node)) {
      refuse("overlaps, leaves gaps or pads");
    }
    layer.pool_frames = kernel[0];
    layer.pool_bands = kernel[1];
    open_ = false;
  }

  const Graph& graph_;
  const std::string& name_;
  std::int64_t bands_ = 0;
  std::size_t index_ = 0;
  bool open_ = false;
  std::size_t num_copied_ = 0;
  std::vector<ConvLayer> layers_;
};

}  // namespace

ConvNetwork parse_onnx_network(Span<const std::uint8_t> bytes, const std::string& name) {
  const Graph graph = OnnxReader(name).model(bytes);
  return LayerChain(graph, name).network();
}

ConvNetwork read_onnx_network(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path, kMaxBytes);
  return parse_onnx_network({bytes.data(), bytes.size()}, path);
}

}  // namespace hri
