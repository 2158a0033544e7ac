// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kSmallestDeviation = 1e-6;  // below, a column counts as constant
constexpr int kMostWindow = 10;              // of deltas

}  // namespace

namespace detail {

void write_delta(const float* const* rows, int window, int width, float* delta) {
  double norm = 0;
  for (int k = 1; k <= window; ++k) norm += 2.0 * k * k;
  for (int c = 0; c < width; ++c) delta[c] = 0;
  for (int k = 1; k <= window; ++k) {
    const auto weight = static_cast<float>(k / norm);
    const float* after = rows[window + k];
    const float* before = rows[window - k];
    for (int c = 0; c < width; ++c) delta[c] += weight * (after[c] - before[c]);
  }
}

}  // namespace detail

void append_deltas(MatrixRefF frames, int first_column, int width, int window) {
  require(window >= 1 && window <= kMostWindow, "window must lie in 1..10");
  require(
      first_column >= 0 && width >= 0 && first_column <= frames.cols() - 2 * Eigen::Index{width},
      "deltas do not fit into the columns of frames");
  std::array<const float*, 2 * kMostWindow + 1> around{};
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    for (Eigen::Index k = 0; k <= 2 * Eigen::Index{window}; ++k) {
      const Eigen::Index at = std::clamp<Eigen::Index>(t + k - window, 0, frames.rows() - 1);
      around[static_cast<std::size_t>(k)] =
          frames.data() + at * frames.outerStride() + first_column;
    }
    float* row = frames.data() + t * frames.outerStride() + first_column;
    detail::write_delta(around.data(), window, width, row + width);
  }
}

void normalise(MatrixRefF frames, int width, Normalisation kind, int c0_column) {
  require(!is_running(kind), "normalisation of a whole utterance must not be a running one");
  require(width >= 0 && width <= frames.cols() && c0_column < frames.cols(),
          "frames have fewer columns than are to be normalised");
  if (kind == Normalisation::none || (kind == Normalisation::level && c0_column < 0)) return;
  const int begin = kind == Normalisation::level ? c0_column : 0;
  const int end = kind == Normalisation::level ? c0_column + 1 : width;
  for (int c = begin; c < end; ++c) {
    const auto mean = static_cast<float>(frames.col(c).cast<double>().mean());
    frames.col(c).array() -= mean;
    if (kind != Normalisation::mean_variance) continue;
    const double deviation =
        std::sqrt(frames.col(c).cast<double>().squaredNorm() / static_cast<double>(frames.rows()));
    if (deviation > kSmallestDeviation) {
      frames.col(c) *= static_cast<float>(1.0 / deviation);
    } else {
      frames.col(c).setZero();
    }
  }
}

void RunningNormaliser::start(int width, Normalisation kind, double num_frames) {
  require(is_running(kind), "normalisation must be a running one");
  require(num_frames >= 1 && std::isfinite(num_frames), "num_frames must be at least 1");
  divide_ = kind == Normalisation::running_mean_variance;
  num_frames_ = num_frames;
  seen_ = 0;
  means_.assign(static_cast<std::size_t>(width), 0);
  variances_.assign(static_cast<std::size_t>(width), 0);
}

void RunningNormaliser::apply(Span<float> frame) {
  require(frame.size() >= means_.size(), "frame is shorter than the width given at the start");
  seen_ = std::min(seen_ + 1, num_frames_);
  const double share = 1 / seen_;
  for (std::size_t c = 0; c < means_.size(); ++c) {
    const double step = static_cast<double>(frame[c]) - means_[c];
    means_[c] += share * step;
    double value = (1 - share) * step;
    if (divide_) {
      variances_[c] = (1 - share) * (variances_[c] + share * step * step);
      const double deviation = std::sqrt(variances_[c]);
      value = deviation > kSmallestDeviation ? value / deviation : 0;
    }
    frame[c] = static_cast<float>(value);
  }
}

void RastaFilter::start(int width, double pole) {
  require(pole >= 0 && pole < 1, "rasta_pole must lie in 0..1, 1 excluded");
  pole_ = pole;
  started_ = false;
  past_.resize(4 * static_cast<std::size_t>(width));
  output_.assign(static_cast<std::size_t>(width), 0);
}

void RastaFilter::apply(Span<float> frame) {
  require(frame.size() >= output_.size(), "frame is shorter than the width given at the start");
  if (!started_) {
    for (std::size_t i = 0; i < past_.size(); ++i) past_[i] = static_cast<double>(frame[i / 4]);
    started_ = true;
  }
  for (std::size_t c = 0; c < output_.size(); ++c) {
    const auto here = static_cast<double>(frame[c]);
    double* past = past_.data() + 4 * c;
    output_[c] = pole_ * output_[c] + 0.1 * (2 * (here - past[0]) + (past[3] - past[1]));
    std::copy(past + 1, past + 4, past);
    past[3] = here;
    frame[c] = static_cast<float>(output_[c]);
  }
}

}  // namespace hri
