// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How cepstra of speech are made, and the settings under which they are those of other programs.
#pragma once

#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/features/speech/dynamics.hpp"
#include "hri/features/speech/filter_bank.hpp"
#include "hri/signal/framing.hpp"

namespace hri {

enum class CepstraKind : std::uint8_t {
  filter_bank,        ///< MFCC and HFCC: DCT of the log energies of filters
  linear_prediction,  ///< LPCC: cepstrum of the all-pole spectrum
};

enum class FramePadding : std::uint8_t {
  none,     ///< whole frames only
  centred,  ///< zeros around the audio: frame t has sample t * shift in its middle
};

struct HRI_API CepstraOptions {
  // Frames.
  int sample_rate_hz = 16000;
  double frame_length_ms = 25;  ///< 1..1000
  double frame_shift_ms = 10;   ///< 1..1000
  FramePadding padding = FramePadding::none;
  double sample_scale = 1;          ///< 32768: as if samples were 16-bit integers; > 0
  bool remove_dc = false;           ///< subtract the mean of every frame
  double pre_emphasis = 0.97;       ///< 0 (off) .. 1
  bool frame_pre_emphasis = false;  ///< every frame begins anew, as in HTK and Kaldi
  WindowKind window = WindowKind::hamming;
  int fft_size = 0;  ///< even, at least the frame's samples; 0: the next power of two

  // Spectrum.
  CepstraKind kind = CepstraKind::filter_bank;
  int lpc_order = 12;  ///< of linear prediction, 1..64
  FilterBankKind filter_bank = FilterBankKind::mel;
  int num_filters = 26;     ///< 1..512
  double low_hz = 100;      ///< lower edge of the first filter
  double high_hz = 0;       ///< upper edge of the last filter; 0 means the Nyquist rate
  double erb_factor = 1;    ///< bandwidth factor E of HFCC-E
  double warp = 1;          ///< vocal-tract-length factor on the filter frequencies, 0.5..2
  double warp_low_hz = 0;   ///< where the warp bends back to low_hz and high_hz (see
  double warp_high_hz = 0;  ///< FilterBankOptions); 0: it does not
  MelScale mel_scale = MelScale::htk;
  FilterAxis filter_axis = FilterAxis::hz;
  bool unit_area = false;       ///< filters of equal area, not of equal height
  bool use_power = true;        ///< false: filters over the magnitude
  double energy_floor = 1e-10;  ///< keeps the log of digital silence finite, 1e-30..1e30
  bool decibels = false;        ///< 10 log10 in place of ln
  double top_db = 0;  ///< filters this far below the loudest of the utterance are raised to that; 0
                      ///< turns it off

  // Cepstra.
  int num_cepstra = 12;     ///< c1 .. c_num, 1..num_filters - 1 (of linear prediction: 1..64)
  bool use_c0 = true;       ///< put c0 (log energy of all filters) in front
  bool use_energy = false;  ///< in the place of c0 the log energy of the frame before pre-emphasis
  bool htk_c0 = false;      ///< c0 (or the energy) behind the others, and c0 sqrt(2) times as large
  double lifter = 22;       ///< HTK's sine lifter, not negative; 0 turns it off

  // Along time.
  double rasta_pole = 0;  ///< of the RASTA filter, below 1 (0.94 or 0.98 are usual); 0 turns it off
  Normalisation normalisation = Normalisation::mean;
  double running_s = 2;  ///< memory of the running normalisations, greater than 0
  int delta_orders = 2;  ///< 0 static only, 1 deltas, 2 and accelerations
  int delta_window = 2;  ///< frames on each side of the regression, 1..10

  /// HTK's MFCC_0 by the configuration of the HTK book (section 3.1.5): c1 .. c12, c0.
  static CepstraOptions htk(int sample_rate_hz = 16000);
  /// Kaldi's compute-mfcc-feats by its defaults, without dither: log energy, c1 .. c12.
  static CepstraOptions kaldi(int sample_rate_hz = 16000);
  /// librosa.feature.mfcc by its defaults: 20 cepstra of 128 Slaney filters, frames of 2048
  /// samples.
  static CepstraOptions librosa(int sample_rate_hz = 22050);
};

/// Throws InvalidArgument naming the field that is out of range (of the filters: see FilterBank).
HRI_API void validate(const CepstraOptions& options);

}  // namespace hri
