// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/network/conv_network.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "models/network/conv_kernels.hpp"

namespace hri {
namespace {

constexpr int kRowsAtOnce = 64;

// A feature map: frames of bands of channels, which are `stride` values apart.
struct MapShape {
  int frames = 0;
  int bands = 0;
  int stride = 0;

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(frames) * static_cast<std::size_t>(bands) *
           static_cast<std::size_t>(stride);
  }
};

// What a call works in; kept by the thread for the next one.
struct Workspace {
  std::vector<float> padded;
  std::vector<float> map;
  std::vector<std::ptrdiff_t> places;
  std::vector<std::ptrdiff_t> taps;
};

Workspace& workspace() {
  thread_local Workspace work;
  return work;
}

[[noreturn]] void fail_at(std::size_t layer, const std::string& what) {
  fail(ErrorKind::invalid_argument, "layer " + std::to_string(layer) + ": " + what);
}

void require_size(std::size_t layer, const char* name, int value, int low = 1) {
  if (value >= low && value <= ConvNetwork::kMaxSize) return;
  fail_at(layer, std::string(name) + " is " + std::to_string(value) + ", must lie in " +
                     std::to_string(low) + ".." + std::to_string(ConvNetwork::kMaxSize));
}

void check(const ConvLayer& layer, std::size_t index, int in_channels) {
  require_size(index, "kernel_frames", layer.kernel_frames);
  require_size(index, "kernel_bands", layer.kernel_bands);
  require_size(index, "pad_bands", layer.pad_bands, 0);
  require_size(index, "out_channels", layer.out_channels);
  require_size(index, "pool_frames", layer.pool_frames);
  require_size(index, "pool_bands", layer.pool_bands);
  if (layer.in_channels != in_channels) {
    fail_at(index, "in_channels is " + std::to_string(layer.in_channels) +
                       ", the layer before has " + std::to_string(in_channels));
  }
  const auto taps =
      static_cast<std::size_t>(layer.kernel_frames) * static_cast<std::size_t>(layer.kernel_bands);
  const std::size_t weights =
      taps * static_cast<std::size_t>(in_channels) * static_cast<std::size_t>(layer.out_channels);
  if (layer.weights.size() != weights ||
      layer.bias.size() != static_cast<std::size_t>(layer.out_channels)) {
    fail_at(index, "has " + std::to_string(layer.weights.size()) + " weights and " +
                       std::to_string(layer.bias.size()) + " of the bias, expected " +
                       std::to_string(weights) + " and " + std::to_string(layer.out_channels));
  }
  if (first_not_finite(layer.weights.data(), weights) < weights ||
      first_not_finite(layer.bias.data(), layer.bias.size()) < layer.bias.size() ||
      !(layer.slope >= 0 && layer.slope <= 1) || std::isnan(layer.floor)) {
    fail_at(index, "a weight is not finite, or the activation is not one");
  }
}

}  // namespace

namespace detail {

struct PackedLayer {
  PackedLayer(const ConvLayer& layer, int bands)
      : sizes(layer), in_bands(bands), num_panels((layer.out_channels + kPanel - 1) / kPanel) {
    const int taps = layer.kernel_frames * layer.kernel_bands;
    const auto panel_size =
        static_cast<std::size_t>(taps) * static_cast<std::size_t>(layer.in_channels) * kPanel;
    weights.assign(panel_size * static_cast<std::size_t>(num_panels), 0.0F);
    bias.assign(static_cast<std::size_t>(num_panels) * kPanel, 0.0F);
    std::copy(layer.bias.begin(), layer.bias.end(), bias.begin());
    const int rows = taps * layer.in_channels;
    for (int row = 0; row < rows; ++row) {
      for (int c = 0; c < layer.out_channels; ++c) {
        weights[static_cast<std::size_t>(c / kPanel) * panel_size +
                static_cast<std::size_t>(row * kPanel + c % kPanel)] =
            layer.weights[static_cast<std::size_t>(row) *
                              static_cast<std::size_t>(layer.out_channels) +
                          static_cast<std::size_t>(c)];
      }
    }
    sizes.weights.clear();
    sizes.bias.clear();
  }

  [[nodiscard]] int conv_bands() const {
    return in_bands + 2 * sizes.pad_bands - sizes.kernel_bands + 1;
  }
  [[nodiscard]] int out_bands() const { return conv_bands() / sizes.pool_bands; }

  ConvLayer sizes;  // without its weights
  int in_bands;
  int num_panels;
  std::vector<float> weights;  // panel by panel
  std::vector<float> bias;
};

}  // namespace detail

namespace {

using detail::kPanel;
using detail::PackedLayer;

// The map that a layer reads: pooled by the layer before it (`pool`, of the map `from`), and with
// zeros beside its bands.
void pool_and_pad(const std::vector<float>& from, const MapShape& shape, const ConvLayer& pool,
                  int channels, int pad, const MapShape& to, std::vector<float>* padded) {
  padded->assign(to.size(), 0.0F);
  const auto stride = static_cast<std::size_t>(shape.stride);
  for (int t = 0; t < to.frames; ++t) {
    for (int b = 0; b < to.bands - 2 * pad; ++b) {
      float* out = padded->data() + static_cast<std::size_t>(t * to.bands + b + pad) *
                                        static_cast<std::size_t>(to.stride);
      for (int i = 0; i < pool.pool_frames; ++i) {
        for (int j = 0; j < pool.pool_bands; ++j) {
          const float* in = from.data() + stride * static_cast<std::size_t>(
                                                       (t * pool.pool_frames + i) * shape.bands +
                                                       b * pool.pool_bands + j);
          if (i == 0 && j == 0) {
            std::copy(in, in + channels, out);
          } else {
            for (int c = 0; c < channels; ++c) out[c] = std::max(out[c], in[c]);
          }
        }
      }
    }
  }
}

// Every layer's convolution, of work->padded (of `shape`) into work->map.
MapShape convolve(const PackedLayer& layer, const MapShape& shape, Workspace* work) {
  const ConvLayer& sizes = layer.sizes;
  const MapShape out{shape.frames - sizes.kernel_frames + 1, layer.conv_bands(),
                     layer.num_panels * kPanel};
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(shape.bands) * shape.stride;
  work->places.clear();
  for (int t = 0; t < out.frames; ++t) {
    for (int b = 0; b < out.bands; ++b)
      work->places.push_back(t * row + static_cast<std::ptrdiff_t>(b) * shape.stride);
  }
  work->taps.clear();
  for (int t = 0; t < sizes.kernel_frames; ++t) {
    for (int b = 0; b < sizes.kernel_bands; ++b)
      work->taps.push_back(t * row + static_cast<std::ptrdiff_t>(b) * shape.stride);
  }
  work->map.resize(out.size());
  const std::size_t panel_size =
      work->taps.size() * static_cast<std::size_t>(sizes.in_channels) * kPanel;
  for (int panel = 0; panel < layer.num_panels; ++panel) {
    const auto p = static_cast<std::size_t>(panel);
    detail::conv_kernels().convolve(
        {work->places, work->taps, sizes.in_channels, layer.weights.data() + p * panel_size,
         layer.bias.data() + p * kPanel, sizes.slope, sizes.floor},
        work->padded.data(), out.stride, work->map.data() + p * kPanel);
  }
  return out;
}

}  // namespace

ConvNetwork::ConvNetwork(int num_bands, const std::vector<ConvLayer>& layers)
    : num_bands_(num_bands) {
  require(num_bands >= 1 && num_bands <= kMaxSize, "num_bands must lie in 1..4096");
  require(!layers.empty(), "a network needs at least one layer");
  int bands = num_bands;
  int channels = 1;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    check(layers[i], i, channels);
    layers_.push_back(std::make_shared<const PackedLayer>(layers[i], bands));
    if (layers_.back()->conv_bands() < 1 || layers_.back()->out_bands() < 1)
      fail_at(i, "no band is left of " + std::to_string(bands));
    bands = layers_.back()->out_bands();
    channels = layers[i].out_channels;
  }
  num_outputs_ = bands * channels;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    window_frames_ = window_frames_ * layer->pool_frames + layer->kernel_frames - 1;
    step_frames_ *= layer->pool_frames;
    if (window_frames_ > 1000000 || step_frames_ > 1000000)
      fail(ErrorKind::invalid_argument, "a row of the output would need a million frames");
  }
}

ConvNetwork::~ConvNetwork() = default;

int ConvNetwork::num_rows(int num_frames) const {
  return num_frames < window_frames_ ? 0 : (num_frames - window_frames_) / step_frames_ + 1;
}

MatrixF ConvNetwork::compute(ConstMatrixRefF frames) const {
  if (frames.cols() != num_bands_) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " values, the network takes " +
                                          std::to_string(num_bands_));
  }
  const int rows = num_rows(static_cast<int>(frames.rows()));
  MatrixF result(rows, num_outputs_);
  // Maps of an hour would take gigabytes.
  for (int first = 0; first < rows; first += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, rows - first);
    compute_rows(frames.middleRows(static_cast<Eigen::Index>(first) * step_frames_,
                                   window_frames_ + (count - 1) * step_frames_),
                 result.middleRows(first, count));
  }
  return result;
}

void ConvNetwork::compute_rows(ConstMatrixRefF frames, MatrixRefF out) const {
  Workspace& work = workspace();
  MapShape shape{static_cast<int>(frames.rows()), num_bands_, 1};
  work.map.resize(shape.size());
  Eigen::Map<MatrixF>(work.map.data(), shape.frames, num_bands_) = frames;
  ConvLayer before;
  int channels = 1;
  for (const auto& layer : layers_) {
    const MapShape padded{shape.frames / before.pool_frames,
                          layer->in_bands + 2 * layer->sizes.pad_bands, channels};
    pool_and_pad(work.map, shape, before, channels, layer->sizes.pad_bands, padded, &work.padded);
    shape = convolve(*layer, padded, &work);
    before = layer->sizes;
    channels = before.out_channels;
  }
  const MapShape last{shape.frames / before.pool_frames, shape.bands / before.pool_bands, channels};
  pool_and_pad(work.map, shape, before, channels, 0, last, &work.padded);
  out = Eigen::Map<const MatrixF>(work.padded.data(), out.rows(), out.cols());
}

}  // namespace hri
