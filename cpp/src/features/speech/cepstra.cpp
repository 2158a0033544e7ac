// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "features/speech/cepstra_workspace.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"

namespace hri {
namespace {

using detail::kDecibelsPerNeper;
using detail::kPi;

CepstraOptions checked(const CepstraOptions& options) {
  validate(options);
  require(options.sample_rate_hz > 0, "CepstraOptions.sample_rate_hz must be set");
  return options;
}

int fft_size_of(const CepstraOptions& o, int frame_length) {
  if (o.fft_size == 0) {
    int size = 2;
    while (size < frame_length) size *= 2;
    return size;
  }
  return o.fft_size;
}

std::vector<float> scaled_window(const CepstraOptions& o, int frame_length) {
  std::vector<float> window = make_window(o.window, frame_length);
  for (float& w : window) w *= static_cast<float>(o.sample_scale);
  return window;
}

// HTK's lifter 1 + L/2 sin(pi n / L), which leaves c0 as it is.
std::vector<double> lifts(const CepstraOptions& o) {
  std::vector<double> result(static_cast<std::size_t>(o.num_cepstra) + 1,
                             o.decibels ? kDecibelsPerNeper : 1.0);
  for (std::size_t n = 1; n < result.size() && o.lifter > 0; ++n) {
    result[n] *= 1.0 + 0.5 * o.lifter * std::sin(kPi * static_cast<double>(n) / o.lifter);
  }
  return result;
}

}  // namespace

CepstraComputer::CepstraComputer(const CepstraOptions& options)
    : options_(checked(options)),
      frame_length_(options.samples_of(options.frame_length_ms)),
      frame_shift_(options.samples_of(options.frame_shift_ms)),
      c0_column_(options.use_c0 ? (options.htk_c0 ? options.num_cepstra : 0) : -1),
      fft_(fft_size_of(options, frame_length_)),
      bank_(options.filter_bank_options(), options.sample_rate_hz, fft_.size()),
      window_(scaled_window(options, frame_length_)),
      lifts_(lifts(options)) {
  if (options.kind == CepstraKind::filter_bank) set_dct();
}

// Orthonormal DCT-II, but for HTK's c0.
void CepstraComputer::set_dct() {
  const double num_filters = options_.num_filters;
  dct_.resize(num_static(), options_.num_filters);
  for (int n = options_.use_c0 ? 0 : 1; n <= options_.num_cepstra; ++n) {
    const double scale = std::sqrt((n == 0 && !options_.htk_c0 ? 1.0 : 2.0) / num_filters) *
                         lifts_[static_cast<std::size_t>(n)];
    for (int m = 0; m < options_.num_filters; ++m)
      dct_(column_of(n), m) =
          static_cast<float>(scale * std::cos(kPi * n * (m + 0.5) / num_filters));
  }
}

int CepstraComputer::num_frames(std::size_t num_samples) const {
  if (options_.padding == FramePadding::centred && num_samples > 0)
    num_samples += 2 * static_cast<std::size_t>(frame_length_ / 2);
  return hri::num_frames(num_samples, frame_length_, frame_shift_);
}

double CepstraComputer::running_frames() const {
  return std::max(1.0, options_.running_s * options_.sample_rate_hz / frame_shift_);
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
  compute_static(audio, out.leftCols(num_static()));
  Workspace& work = workspace();
  const auto row = [&](Eigen::Index t) {
    return Span<float>(out.data() + t * out.outerStride(), static_cast<std::size_t>(num_static()));
  };
  if (options_.rasta_pole > 0) {
    work.rasta.start(num_static(), options_.rasta_pole);
    for (Eigen::Index t = 0; t < out.rows(); ++t) work.rasta.apply(row(t));
  }
  if (is_running(options_.normalisation)) {
    work.normaliser.start(num_static(), options_.normalisation, running_frames());
    for (Eigen::Index t = 0; t < out.rows(); ++t) work.normaliser.apply(row(t));
  } else {
    normalise(out, num_static(), options_.normalisation, c0_column_);
  }
  for (int order = 0; order < options_.delta_orders; ++order) {
    append_deltas(out, order * num_static(), num_static(), options_.delta_window);
  }
}

}  // namespace hri
