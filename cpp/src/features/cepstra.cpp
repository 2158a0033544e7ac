// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/cepstra.hpp"

#include <algorithm>
#include <cmath>

#include "cepstra_kernels.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/framing.hpp"
#include "hri/signal/lanes.hpp"

namespace hri {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kEnergyFloor = 1e-10F;  // keeps the log of digital silence finite

int samples_of(double ms, int rate_hz, const char* field) {
  if (!(ms >= 1 && ms <= 1000)) {
    fail(ErrorKind::invalid_argument,
         std::string(field) + " must lie in 1..1000 ms, got " + std::to_string(ms));
  }
  return std::max(1, static_cast<int>(std::lround(ms * rate_hz / 1000.0)));
}

const CepstraOptions& checked(const CepstraOptions& o) {
  require(o.sample_rate_hz >= 1000 && o.sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  require(o.pre_emphasis >= 0 && o.pre_emphasis <= 1, "pre_emphasis must lie in 0..1");
  require(o.num_filters >= 1 && o.num_filters <= 512, "num_filters must lie in 1..512");
  require(o.num_cepstra >= 1 && o.num_cepstra < o.num_filters,
          "num_cepstra must lie in 1..num_filters - 1");
  require(std::isfinite(o.lifter) && o.lifter >= 0, "lifter must be finite and not negative");
  require(o.delta_orders >= 0 && o.delta_orders <= 2, "delta_orders must lie in 0..2");
  require(o.delta_window >= 1 && o.delta_window <= 10, "delta_window must lie in 1..10");
  return o;
}

int fft_size_of(int frame_length) {
  int size = 2;
  while (size < frame_length) size *= 2;
  return size;
}

FilterBankOptions bank_options(const CepstraOptions& o) {
  return {o.filter_bank, o.num_filters, o.low_hz, o.high_hz, o.erb_factor, o.warp};
}

// Orthonormal DCT-II rows for c0 (if wanted) and c1.., each scaled by HTK's lifter 1 + L/2 sin(pi n
// / L).
MatrixF lifted_dct(const CepstraOptions& o) {
  const int first = o.use_c0 ? 0 : 1;
  MatrixF dct(o.num_cepstra + 1 - first, o.num_filters);
  for (int n = first; n <= o.num_cepstra; ++n) {
    const double scale = std::sqrt((n == 0 ? 1.0 : 2.0) / o.num_filters);
    const double lift =
        o.lifter > 0 && n > 0 ? 1.0 + 0.5 * o.lifter * std::sin(kPi * n / o.lifter) : 1.0;
    for (int m = 0; m < o.num_filters; ++m) {
      dct(n - first, m) =
          static_cast<float>(lift * scale * std::cos(kPi * n * (m + 0.5) / o.num_filters));
    }
  }
  return dct;
}

// What a thread needs while it computes; it grows to the largest it has met.
struct Workspace {
  std::vector<float> first_frame;
  std::vector<const float*> frames;
  LaneBuffer samples;
  LaneBuffer spectrum;
  LaneBuffer power;
  LaneBuffer logs;
  LaneBuffer cepstra;
};

Workspace& workspace() {
  thread_local Workspace w;
  return w;
}

}  // namespace

CepstraComputer::CepstraComputer(const CepstraOptions& options)
    : options_(checked(options)),
      frame_length_(samples_of(options.frame_length_ms, options.sample_rate_hz, "frame_length_ms")),
      frame_shift_(samples_of(options.frame_shift_ms, options.sample_rate_hz, "frame_shift_ms")),
      fft_(fft_size_of(frame_length_)),
      bank_(bank_options(options), options.sample_rate_hz, fft_.size()),
      window_(hamming_window(frame_length_)),
      dct_(lifted_dct(options)) {}

int CepstraComputer::num_frames(std::size_t num_samples) const {
  return hri::num_frames(num_samples, frame_length_, frame_shift_);
}

MatrixF CepstraComputer::compute(Span<const float> audio) const {
  MatrixF out(num_frames(audio.size()), num_features());
  compute(audio, out);
  return out;
}

void CepstraComputer::compute(Span<const float> audio, MatrixRefF out) const {
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size()) {
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  }
  if (num_frames(audio.size()) == 0) {
    fail(ErrorKind::invalid_argument, "audio is too short: " + std::to_string(audio.size()) +
                                          " samples, one frame takes " +
                                          std::to_string(frame_length_));
  }
  require(out.rows() == num_frames(audio.size()) && out.cols() == num_features(),
          "out must have shape (num_frames, num_features)");
  compute_static(audio, out);
  normalise(out, num_static(), options_.normalisation, options_.use_c0 ? 0 : -1);
  for (int order = 0; order < options_.delta_orders; ++order) {
    append_deltas(out, order * num_static(), num_static(), options_.delta_window);
  }
}

// Frames side by side: several at a time go through every step together.
void CepstraComputer::compute_static(Span<const float> audio, MatrixRefF out) const {
  const detail::CepstraKernels& kernels = detail::cepstra_kernels();
  const auto lanes = static_cast<std::size_t>(kernels.num_lanes);
  const detail::FrameTable frame_table{frame_length_, fft_.size(), window_.data(),
                                       static_cast<float>(options_.pre_emphasis)};
  Workspace& work = workspace();
  work.first_frame.resize(static_cast<std::size_t>(frame_length_) + 1);
  work.frames.resize(lanes);
  work.samples.resize((static_cast<std::size_t>(frame_length_) + 1) * lanes);
  work.spectrum.resize(static_cast<std::size_t>(fft_.size()) * lanes);
  work.power.resize(static_cast<std::size_t>(fft_.num_bins()) * lanes);
  work.logs.resize(static_cast<std::size_t>(bank_.num_filters()) * lanes);
  work.cepstra.resize(static_cast<std::size_t>(num_static()) * lanes);
  // Nothing comes before the first sample: it stands for that itself.
  const auto length = static_cast<std::size_t>(frame_length_);
  std::copy_n(audio.data(), length, work.first_frame.begin() + 1);
  work.first_frame[0] = audio[0];
  for (Eigen::Index first = 0; first < out.rows(); first += kernels.num_lanes) {
    const auto count = std::min<Eigen::Index>(kernels.num_lanes, out.rows() - first);
    for (std::size_t l = 0; l < lanes; ++l) {
      // Lanes beyond the last frame repeat it.
      const Eigen::Index t = first + std::min(static_cast<Eigen::Index>(l), count - 1);
      work.frames[l] = t == 0 ? work.first_frame.data() : audio.data() + t * frame_shift_ - 1;
    }
    interleave({work.frames.data(), lanes}, length + 1, work.samples);
    kernels.condition(frame_table, work.samples.data(), work.spectrum.data());
    fft_.power_spectra(work.spectrum, work.power);
    kernels.log_energies(bank_.table(), kEnergyFloor, work.power.data(), work.logs.data());
    kernels.project(dct_.data(), num_static(), bank_.num_filters(), work.logs.data(),
                    work.cepstra.data());
    for (Eigen::Index l = 0; l < count; ++l) {
      for (Eigen::Index c = 0; c < num_static(); ++c)
        out(first + l, c) = work.cepstra[static_cast<std::size_t>(c * kernels.num_lanes + l)];
    }
  }
}

void append_deltas(MatrixRefF frames, int first_column, int width, int window) {
  const Eigen::Index last = frames.rows() - 1;
  double norm = 0;
  for (int k = 1; k <= window; ++k) norm += 2.0 * k * k;
  const auto scale = static_cast<float>(1.0 / norm);
  for (Eigen::Index t = 0; t <= last; ++t) {
    auto delta = frames.row(t).segment(first_column + width, width);
    delta.setZero();
    for (int k = 1; k <= window; ++k) {
      const auto after =
          frames.row(std::min<Eigen::Index>(t + k, last)).segment(first_column, width);
      const auto before = frames.row(std::max<Eigen::Index>(t - k, 0)).segment(first_column, width);
      delta += static_cast<float>(k) * scale * (after - before);
    }
  }
}

void normalise(MatrixRefF frames, int width, Normalisation kind, int c0_column) {
  if (kind == Normalisation::none || (kind == Normalisation::level && c0_column < 0)) return;
  const int begin = kind == Normalisation::level ? c0_column : 0;
  const int end = kind == Normalisation::level ? c0_column + 1 : width;
  for (int c = begin; c < end; ++c) {
    const auto mean = static_cast<float>(frames.col(c).cast<double>().mean());
    frames.col(c).array() -= mean;
    if (kind != Normalisation::mean_variance) continue;
    const double deviation =
        std::sqrt(frames.col(c).cast<double>().squaredNorm() / static_cast<double>(frames.rows()));
    if (deviation > 1e-6) {
      frames.col(c) *= static_cast<float>(1.0 / deviation);
    } else {
      frames.col(c).setZero();
    }
  }
}

}  // namespace hri
