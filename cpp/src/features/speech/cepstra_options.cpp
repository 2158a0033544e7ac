// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra_options.hpp"

#include <cfloat>
#include <cmath>
#include <string>

#include "hri/core/error.hpp"

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

void check_ms(double ms, const char* field) {
  if (ms >= 1 && ms <= 1000) return;
  fail(ErrorKind::invalid_argument,
       std::string(field) + " must lie in 1..1000 ms, got " + std::to_string(ms));
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

void validate(const CepstraOptions& o) {
  require(o.sample_rate_hz >= 1000 && o.sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  check_ms(o.frame_length_ms, "frame_length_ms");
  check_ms(o.frame_shift_ms, "frame_shift_ms");
  require(o.sample_scale > 0 && o.sample_scale <= 1e6, "sample_scale must lie in 0..1e6, not 0");
  require(o.pre_emphasis >= 0 && o.pre_emphasis <= 1, "pre_emphasis must lie in 0..1");
  require(o.fft_size >= 0 && o.fft_size <= (1 << 20) && o.fft_size % 2 == 0,
          "fft_size must be even and at most 2^20");
  require(o.energy_floor >= 1e-30 && o.energy_floor <= 1e30,
          "energy_floor must lie in 1e-30..1e30");
  require(o.top_db >= 0 && std::isfinite(o.top_db), "top_db must be finite and not negative");
  require(std::isfinite(o.lifter) && o.lifter >= 0, "lifter must be finite and not negative");
  if (o.kind == CepstraKind::filter_bank) {
    require(o.num_filters >= 1 && o.num_filters <= 512, "num_filters must lie in 1..512");
    require(o.num_cepstra >= 1 && o.num_cepstra < o.num_filters,
            "num_cepstra must lie in 1..num_filters - 1");
  } else {
    require(o.lpc_order >= 1 && o.lpc_order <= 64, "lpc_order must lie in 1..64");
    require(o.num_cepstra >= 1 && o.num_cepstra <= 64, "num_cepstra must lie in 1..64");
    require(o.top_db == 0, "top_db needs a filter bank");
  }
  require(o.use_c0 || !o.use_energy, "use_energy needs use_c0");
  require(o.rasta_pole >= 0 && o.rasta_pole < 1, "rasta_pole must lie in 0..1, 1 excluded");
  require(o.running_s > 0 && std::isfinite(o.running_s), "running_s must be greater than 0");
  require(o.delta_orders >= 0 && o.delta_orders <= 2, "delta_orders must lie in 0..2");
  require(o.delta_window >= 1 && o.delta_window <= 10, "delta_window must lie in 1..10");
}

}  // namespace hri
