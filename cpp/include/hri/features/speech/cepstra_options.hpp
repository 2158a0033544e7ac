// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How cepstra of speech are made, and the settings under which they are those of other programs.
#pragma once

#include <array>
#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/features/speech/dynamics.hpp"
#include "hri/features/speech/filter_bank.hpp"
#include "hri/signal/framing.hpp"

namespace hri {

enum class CepstraKind : std::uint8_t {
  filter_bank,        ///< MFCC and HFCC: DCT of the log energies of filters
  linear_prediction,  ///< LPCC: cepstrum of the all-pole spectrum
};
constexpr auto enum_names(CepstraKind) { return std::array{"filter_bank", "linear_prediction"}; }

enum class FramePadding : std::uint8_t {
  none,     ///< whole frames only
  centred,  ///< zeros around the audio: frame t has sample t * shift in its middle
};
constexpr auto enum_names(FramePadding) { return std::array{"none", "centred"}; }

struct HRI_API CepstraOptions {
  // Frames.
  int sample_rate_hz = 16000;
  double frame_length_ms = 25;
  double frame_shift_ms = 10;
  FramePadding padding = FramePadding::none;
  double sample_scale = 1;
  bool remove_dc = false;
  double pre_emphasis = 0.97;
  bool frame_pre_emphasis = false;
  WindowKind window = WindowKind::hamming;
  int fft_size = 0;

  // Spectrum.
  CepstraKind kind = CepstraKind::filter_bank;
  int lpc_order = 12;
  FilterBankKind filter_bank = FilterBankKind::mel;
  int num_filters = 26;
  double low_hz = 100;
  double high_hz = 0;
  double erb_factor = 1;
  double warp = 1;
  double warp_low_hz = 0;
  double warp_high_hz = 0;
  MelScale mel_scale = MelScale::htk;
  FilterAxis filter_axis = FilterAxis::hz;
  bool unit_area = false;
  bool use_power = true;
  double energy_floor = 1e-10;
  bool decibels = false;
  double top_db = 0;

  // Cepstra.
  int num_cepstra = 12;
  bool use_c0 = true;
  bool use_energy = false;
  bool htk_c0 = false;
  double lifter = 22;

  // Along time.
  double rasta_pole = 0;
  Normalisation normalisation = Normalisation::mean;
  double running_s = 2;
  int delta_orders = 2;
  int delta_window = 2;

  static constexpr const char* kName = "CepstraOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("sample_rate_hz", o.sample_rate_hz, within(1000, 384000).or_zero(),
      "sample rate of the audio; 0, in a recogniser only: the lowest of the training recordings, "
      "at most 16000");
    v("frame_length_ms", o.frame_length_ms, within(1, 1000), "length of a frame");
    v("frame_shift_ms", o.frame_shift_ms, within(1, 1000), "time from frame to frame");
    v("padding", o.padding, any_value, "whether zeros surround the audio");
    v("sample_scale", o.sample_scale, above(0, 1e6),
      "factor on the samples; 32768: as if they were 16-bit integers");
    v("remove_dc", o.remove_dc, any_value, "subtract the mean of every frame");
    v("pre_emphasis", o.pre_emphasis, within(0, 1), "coefficient of the pre-emphasis; 0: off");
    v("frame_pre_emphasis", o.frame_pre_emphasis, any_value,
      "pre-emphasis begins anew in every frame, as in HTK and Kaldi");
    v("window", o.window, any_value, "window of a frame");
    v("fft_size", o.fft_size, within(0, 65536).even(),
      "size of the FFT, at least the frame's samples; 0: the next power of two");
    v("kind", o.kind, any_value, "what the cepstra are taken of");
    v("lpc_order", o.lpc_order, within(1, 64), "order of linear prediction");
    v("filter_bank", o.filter_bank, any_value, "shape of the filters");
    v("num_filters", o.num_filters, within(1, 512), "number of filters");
    v("low_hz", o.low_hz, within(0, 192000), "lower edge of the first filter");
    v("high_hz", o.high_hz, within(0, 192000),
      "upper edge of the last filter; 0: half the sample rate");
    v("erb_factor", o.erb_factor, within(0.1, 10), "bandwidth factor E of HFCC-E");
    v("warp", o.warp, within(0.5, 2), "vocal-tract-length factor on the filter frequencies");
    v("warp_low_hz", o.warp_low_hz, within(0, 192000),
      "below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend");
    v("warp_high_hz", o.warp_high_hz, within(0, 192000), "above it the warp bends back to high_hz");
    v("mel_scale", o.mel_scale, any_value, "mel scale of the filters' spacing");
    v("filter_axis", o.filter_axis, any_value, "axis on which the filters are triangles");
    v("unit_area", o.unit_area, any_value, "filters of equal area, not of equal height");
    v("use_power", o.use_power, any_value, "filters over the power; False: over the magnitude");
    v("energy_floor", o.energy_floor, within(1e-30, 1e30),
      "least energy of a filter, which keeps the log of digital silence finite");
    v("decibels", o.decibels, any_value, "10 log10 in place of ln");
    v("top_db", o.top_db, within(0, 1000),
      "filters this far below the loudest of the utterance are raised to that; 0: off");
    v("num_cepstra", o.num_cepstra, within(1, 511),
      "c1 .. c_num, below num_filters (linear prediction: up to 64)");
    v("use_c0", o.use_c0, any_value, "c0, the log energy of all filters, in front");
    v("use_energy", o.use_energy, any_value,
      "in the place of c0 the log energy of the frame before pre-emphasis");
    v("htk_c0", o.htk_c0, any_value,
      "c0 (or the energy) behind the others, and c0 sqrt(2) times as large");
    v("lifter", o.lifter, within(0, 1e6), "HTK's sine lifter; 0: off");
    v("rasta_pole", o.rasta_pole, below(0, 1),
      "pole of the RASTA filter (0.94 or 0.98 are usual); 0: off");
    v("normalisation", o.normalisation, any_value, "what is normalised along time");
    v("running_s", o.running_s, above(0, 1e6), "memory of the running normalisations");
    v("delta_orders", o.delta_orders, within(0, 2),
      "0: static only, 1: with deltas, 2: and accelerations");
    v("delta_window", o.delta_window, within(1, 10), "frames on each side of the regression");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;

  /// Samples in so many milliseconds, at least one.
  [[nodiscard]] int samples_of(double ms) const;
  [[nodiscard]] FilterBankOptions filter_bank_options() const;

  /// HTK's MFCC_0 by the configuration of the HTK book (section 3.1.5): c1 .. c12, c0.
  static CepstraOptions htk(int sample_rate_hz = 16000);
  /// Kaldi's compute-mfcc-feats by its defaults, without dither: log energy, c1 .. c12.
  static CepstraOptions kaldi(int sample_rate_hz = 16000);
  /// librosa.feature.mfcc by its defaults: 20 cepstra of 128 Slaney filters, frames of 2048
  /// samples.
  static CepstraOptions librosa(int sample_rate_hz = 22050);
};

}  // namespace hri
