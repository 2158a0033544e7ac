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

constexpr int kStepsAtOnce = 64;

// A feature map: frames of bands of channels, which are `stride` values apart.
struct MapShape {
  int frames = 0;
  int bands = 0;
  int stride = 0;

  [[nodiscard]] std::size_t row_size() const {
    return static_cast<std::size_t>(bands) * static_cast<std::size_t>(stride);
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(frames) * row_size(); }
};

// What a call works in; kept by the thread for the next one.
struct Workspace {
  std::vector<float> padded;
  std::vector<float> map;
  std::vector<float> shared;
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
void pool_and_pad(const float* from, const MapShape& shape, const ConvLayer& pool, int pad,
                  const MapShape& to, std::vector<float>* padded) {
  const int channels = pool.out_channels;
  padded->assign(to.size(), 0.0F);
  const auto stride = static_cast<std::size_t>(shape.stride);
  for (int t = 0; t < to.frames; ++t) {
    for (int b = 0; b < to.bands - 2 * pad; ++b) {
      float* out = padded->data() + static_cast<std::size_t>(t * to.bands + b + pad) *
                                        static_cast<std::size_t>(to.stride);
      for (int i = 0; i < pool.pool_frames; ++i) {
        for (int j = 0; j < pool.pool_bands; ++j) {
          const float* in =
              from + stride * static_cast<std::size_t>((t * pool.pool_frames + i) * shape.bands +
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

// A map, and the layer that it comes from, which has not pooled it yet.
struct Layered {
  MapShape shape;
  const ConvLayer* before;
};

// The convolution of a layer, of the map `from`, into work->map.
Layered next_layer(const PackedLayer& layer, const Layered& last, const float* from,
                   Workspace* work) {
  const int pad = layer.sizes.pad_bands;
  const MapShape padded{last.shape.frames / last.before->pool_frames, layer.in_bands + 2 * pad,
                        layer.sizes.in_channels};
  pool_and_pad(from, last.shape, *last.before, pad, padded, &work->padded);
  return {convolve(layer, padded, work), &layer.sizes};
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

MatrixF ConvNetwork::compute(ConstMatrixRefF frames, int rows_per_step) const {
  if (frames.cols() != num_bands_) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " values, the network takes " +
                                          std::to_string(num_bands_));
  }
  require(rows_per_step >= 1 && step_frames_ % rows_per_step == 0,
          "rows_per_step must divide the frames from one row to the next");
  const int shift = step_frames_ / rows_per_step;
  const int beyond = static_cast<int>(frames.rows()) - window_frames_;
  const int rows = beyond < 0 ? 0 : beyond / shift + 1;
  MatrixF result(rows, num_outputs_);
  // Maps of an hour would take gigabytes.
  const int at_once = kStepsAtOnce * rows_per_step;
  for (int first = 0; first < rows; first += at_once) {
    const int count = std::min(at_once, rows - first);
    compute_rows(frames.middleRows(static_cast<Eigen::Index>(first) * shift,
                                   window_frames_ + (count - 1) * shift),
                 rows_per_step, result.middleRows(first, count));
  }
  return result;
}

// Windows that begin `shift` frames apart read the same map as long as its frames divide `shift`.
// From the pool on that no longer leaves them there each phase of rows has maps of its own.
void ConvNetwork::compute_rows(ConstMatrixRefF frames, int rows_per_step, MatrixRefF out) const {
  Workspace& work = workspace();
  const int shift = step_frames_ / rows_per_step;
  work.map.resize(static_cast<std::size_t>(frames.size()));
  Eigen::Map<MatrixF>(work.map.data(), frames.rows(), num_bands_) = frames;
  ConvLayer no_pool;
  Layered at{{static_cast<int>(frames.rows()), num_bands_, 1}, &no_pool};
  std::size_t shared = 0;
  int stride = 1;
  while (shared < layers_.size() && shift % (stride * at.before->pool_frames) == 0) {
    stride *= at.before->pool_frames;
    at = next_layer(*layers_[shared++], at, work.map.data(), &work);
  }
  const int num_phases = shift % (stride * at.before->pool_frames) == 0 ? 1 : rows_per_step;
  std::swap(work.map, work.shared);
  for (int phase = 0; phase < std::min<int>(num_phases, static_cast<int>(out.rows())); ++phase) {
    const int skipped = phase * shift / stride;
    Layered rest = at;
    rest.shape.frames -= skipped;
    const float* from =
        work.shared.data() + static_cast<std::size_t>(skipped) * at.shape.row_size();
    for (std::size_t i = shared; i < layers_.size(); ++i) {
      rest = next_layer(*layers_[i], rest, from, &work);
      from = work.map.data();
    }
    const ConvLayer& pool = *rest.before;
    const MapShape last{rest.shape.frames / pool.pool_frames, rest.shape.bands / pool.pool_bands,
                        pool.out_channels};
    pool_and_pad(from, rest.shape, pool, 0, last, &work.padded);
    for (Eigen::Index row = phase, at_row = 0; row < out.rows(); row += num_phases, ++at_row) {
      out.row(row) =
          Eigen::Map<const MatrixF>(work.padded.data() + at_row * num_outputs_, 1, num_outputs_);
    }
  }
}

}  // namespace hri
