// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/log_mel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"

namespace hri {
namespace {

CepstraOptions checked_for_log_mel(const CepstraOptions& options) {
  validate(options);
  require(options.kind == CepstraKind::filter_bank && options.padding == FramePadding::none &&
              options.pre_emphasis == 0 && !options.remove_dc,
          "log mel energies take no padding, pre_emphasis, remove_dc or linear_prediction");
  return options;
}

int fft_size(const CepstraOptions& options) {
  if (options.fft_size > 0) return options.fft_size;
  int size = 2;
  while (size < options.samples_of(options.frame_length_ms)) size *= 2;
  return size;
}

}  // namespace

LogMel::LogMel(const CepstraOptions& options)
    : options_(checked_for_log_mel(options)),
      frame_length_(options.samples_of(options.frame_length_ms)),
      frame_shift_(options.samples_of(options.frame_shift_ms)),
      fft_(fft_size(options)),
      bank_(options.filter_bank_options(), options.sample_rate_hz, fft_.size()),
      window_(make_window(options.window, frame_length_)) {
  for (float& w : window_) w *= static_cast<float>(options.sample_scale);
}

CepstraOptions LogMel::speech_embedding() {
  CepstraOptions o;
  o.sample_rate_hz = 16000;
  o.sample_scale = 32768;
  o.pre_emphasis = 0;
  o.window = WindowKind::hann_periodic;
  o.fft_size = 512;
  o.num_filters = 32;
  o.low_hz = 60;
  o.high_hz = 3800;
  o.mel_scale = MelScale::slaney;
  o.unit_area = true;
  o.decibels = true;
  o.top_db = 80;
  return o;
}

int LogMel::num_frames(std::size_t num_samples) const {
  return hri::num_frames(num_samples, frame_length_, frame_shift_);
}

MatrixF LogMel::compute(Span<const float> audio) const {
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size())
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  const int rows = num_frames(audio.size());
  MatrixF result(rows, bank_.num_filters());
  std::vector<float> frame(static_cast<std::size_t>(fft_.size()), 0.0F);
  std::vector<float> power(static_cast<std::size_t>(fft_.num_bins()));
  for (int t = 0; t < rows; ++t) {
    const float* from =
        audio.data() + static_cast<std::size_t>(t) * static_cast<std::size_t>(frame_shift_);
    for (std::size_t n = 0; n < window_.size(); ++n) frame[n] = from[n] * window_[n];
    fft_.power_spectrum(frame, power);
    if (!options_.use_power) {
      for (float& p : power) p = std::sqrt(p);
    }
    bank_.apply(power, {result.row(t).data(), static_cast<std::size_t>(result.cols())});
  }
  const auto floor = static_cast<float>(options_.energy_floor);
  for (float& x : result.reshaped()) {
    x = std::max(x, floor);
    x = options_.decibels ? 10.0F * std::log10(x) : std::log(x);
  }
  if (options_.top_db > 0 && result.size() > 0) {
    const auto range = static_cast<float>(
        options_.decibels ? options_.top_db : options_.top_db / 10 * std::log(10.0));
    result = result.cwiseMax(result.maxCoeff() - range).eval();
  }
  return result;
}

}  // namespace hri
