// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra_options.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace hri {
namespace {

// Static features as other programs make them, with nothing done along time.
CepstraOptions plain(int sample_rate_hz) {
  CepstraOptions o;
  o.sample_rate_hz = sample_rate_hz;
  o.low_hz = 0;
  o.normalisation = Normalisation::none;
  o.delta_orders = 0;
  return o;
}

}  // namespace

CepstraOptions CepstraOptions::htk(int sample_rate_hz) {
  CepstraOptions o = plain(sample_rate_hz);
  o.sample_scale = 32768;
  o.frame_pre_emphasis = true;
  o.filter_axis = FilterAxis::mel;
  o.use_power = false;
  o.energy_floor = 1;
  o.htk_c0 = true;
  return o;
}

CepstraOptions CepstraOptions::kaldi(int sample_rate_hz) {
  CepstraOptions o = plain(sample_rate_hz);
  o.sample_scale = 32768;
  o.remove_dc = true;
  o.frame_pre_emphasis = true;
  o.window = WindowKind::povey;
  o.num_filters = 23;
  o.low_hz = 20;
  o.filter_axis = FilterAxis::mel;
  o.energy_floor = static_cast<double>(FLT_EPSILON);
  o.use_energy = true;
  return o;
}

CepstraOptions CepstraOptions::librosa(int sample_rate_hz) {
  CepstraOptions o = plain(sample_rate_hz);
  o.frame_length_ms = 1000.0 * 2048 / sample_rate_hz;
  o.frame_shift_ms = 1000.0 * 512 / sample_rate_hz;
  o.padding = FramePadding::centred;
  o.pre_emphasis = 0;
  o.window = WindowKind::hann_periodic;
  o.num_filters = 128;
  o.mel_scale = MelScale::slaney;
  o.unit_area = true;
  o.decibels = true;
  o.top_db = 80;
  o.num_cepstra = 19;
  o.lifter = 0;
  return o;
}

int CepstraOptions::samples_of(double ms) const {
  return std::max(1, static_cast<int>(std::lround(ms * sample_rate_hz / 1000.0)));
}

FilterBankOptions CepstraOptions::filter_bank_options() const {
  FilterBankOptions bank;
  bank.kind = filter_bank;
  bank.num_filters = num_filters;
  bank.low_hz = low_hz;
  bank.high_hz = high_hz;
  bank.erb_factor = erb_factor;
  bank.warp = warp;
  bank.warp_low_hz = warp_low_hz;
  bank.warp_high_hz = warp_high_hz;
  bank.mel_scale = mel_scale;
  bank.axis = filter_axis;
  bank.unit_area = unit_area;
  return bank;
}

const char* CepstraOptions::conflict() const {
  if (kind == CepstraKind::filter_bank) {
    if (num_cepstra >= num_filters) return "num_cepstra must be less than num_filters";
  } else {
    if (num_cepstra > 64) return "num_cepstra of linear prediction must lie in 1..64";
    if (top_db != 0) return "top_db needs a filter bank";
  }
  if (use_energy && !use_c0) return "use_energy needs use_c0";
  const FilterBankOptions bank = filter_bank_options();
  if (sample_rate_hz == 0) return bank.conflict();
  // As fft_size: the weights of all filters would take half a gigabyte.
  if (samples_of(frame_length_ms) > 65536) return "a frame must not have more than 65536 samples";
  if (fft_size != 0 && fft_size < samples_of(frame_length_ms))
    return "fft_size must not be less than the samples of a frame";
  return bank.conflict_at(sample_rate_hz);
}

}  // namespace hri
