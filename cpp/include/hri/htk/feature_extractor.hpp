// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Audio to HTK's parameters, by the settings and formulas of its HParm and HSigP (HTK Book, chapter
// 5).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/features/speech/filter_bank.hpp"
#include "hri/htk/parameter_file.hpp"
#include "hri/signal/fft.hpp"

namespace hri::htk {

/// Defaults are HTK's, but for the shift, which HTK has none of.
struct HtkFeatureOptions {
  double frame_shift_ms = 10;
  double frame_length_ms = 25.6;
  bool zero_mean = false;
  double pre_emphasis = 0.97;
  bool hamming = true;
  bool use_power = false;
  int num_filters = 20;
  double low_hz = 0;
  double high_hz = 0;
  double warp = 1;
  double warp_low_hz = 0;
  double warp_high_hz = 0;
  int lpc_order = 12;
  int num_cepstra = 12;
  double lifter = 22;
  bool raw_energy = true;
  bool normalise_energy = true;
  double energy_scale = 0.1;
  double silence_floor_db = 50;
  int delta_window = 2;
  int acceleration_window = 2;
  int third_window = 2;

  static constexpr const char* kName = "HtkFeatureOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("frame_shift_ms", o.frame_shift_ms, within(1, 1000), "TARGETRATE");
    v("frame_length_ms", o.frame_length_ms, within(1, 1000), "WINDOWSIZE");
    v("zero_mean", o.zero_mean, any_value, "ZMEANSOURCE: subtract the mean of every frame");
    v("pre_emphasis", o.pre_emphasis, within(0, 1), "PREEMCOEF");
    v("hamming", o.hamming, any_value, "USEHAMMING; False: no window");
    v("use_power", o.use_power, any_value, "USEPOWER: filters over the power, not the magnitude");
    v("num_filters", o.num_filters, within(2, 512), "NUMCHANS");
    v("low_hz", o.low_hz, within(0, 192000), "LOFREQ");
    v("high_hz", o.high_hz, within(0, 192000), "HIFREQ; 0: half the sample rate");
    v("warp", o.warp, within(0.5, 2), "WARPFREQ: frequencies are divided by it");
    v("warp_low_hz", o.warp_low_hz, within(0, 192000), "WARPLCUTOFF");
    v("warp_high_hz", o.warp_high_hz, within(0, 192000), "WARPUCUTOFF");
    v("lpc_order", o.lpc_order, within(1, 64), "LPCORDER");
    v("num_cepstra", o.num_cepstra, within(1, 511), "NUMCEPS");
    v("lifter", o.lifter, within(0, 1e6), "CEPLIFTER; 0: off");
    v("raw_energy", o.raw_energy, any_value,
      "RAWENERGY: the energy before pre-emphasis and window");
    v("normalise_energy", o.normalise_energy, any_value,
      "ENORMALISE: 1 - energy_scale times how far a frame's log energy is below the largest");
    v("energy_scale", o.energy_scale, above(0, 1e6), "ESCALE");
    v("silence_floor_db", o.silence_floor_db, within(0, 1000),
      "SILFLOOR: energies further below the largest are raised to that");
    v("delta_window", o.delta_window, within(1, 10), "DELTAWINDOW");
    v("acceleration_window", o.acceleration_window, within(1, 10), "ACCWINDOW");
    v("third_window", o.third_window, within(1, 10), "THIRDWINDOW");
  }
};

/// Immutable; const calls are safe from several threads. It computes MFCC, FBANK, MELSPEC, LPC,
/// LPREFC, IREFC and LPCEPSTRA with _E _0 _N _D _A _T _Z.
class HRI_API FeatureExtractor {
 public:
  /// Throws InvalidArgument naming the field that is out of range, and for kinds that are not
  /// computed.
  FeatureExtractor(ParameterKind kind, int sample_rate_hz, const HtkFeatureOptions& options = {});

  /// Of mono audio (full scale is -1..1), shape (num_frames, num_columns). Throws InvalidArgument
  /// for less than one frame and for a sample that is not finite (names it).
  [[nodiscard]] MatrixF compute(Span<const float> audio) const;

  [[nodiscard]] ParameterKind kind() const { return kind_; }
  [[nodiscard]] int num_columns() const;
  /// From frame to frame, in 100 ns.
  [[nodiscard]] std::int32_t sample_period() const;

 private:
  [[nodiscard]] int num_base() const;  // columns without c0 and energy
  [[nodiscard]] MatrixF base(Span<const float> audio) const;
  [[nodiscard]] MatrixF filter_energies(Span<const float> audio) const;
  [[nodiscard]] MatrixF linear_prediction(Span<const float> audio) const;
  [[nodiscard]] VectorD log_energies(Span<const float> audio) const;
  void condition(Span<const float> audio, Eigen::Index frame, bool raw, VectorD* out) const;

  ParameterKind kind_;
  HtkFeatureOptions options_;
  CepstraComputer computer_;
  RealFft fft_;
  FilterBank bank_;
  std::vector<float> window_;
};

/// `file` as another kind: differences are added from the static coefficients, or left out, and so
/// are _Z, _C and _K; _Z cannot be undone. FBANK and MELSPEC become MFCC, MELSPEC FBANK, and LPC,
/// LPREFC and IREFC one another and LPCEPSTRA, by `options`. Throws InvalidArgument for what the
/// file has not.
HRI_API ParameterFile convert(const ParameterFile& file, ParameterKind kind,
                              const HtkFeatureOptions& options = {});

/// How many frames on each side of it convert() reads for a frame of `to`: a part of a file with so
/// many more becomes what it is in the whole, to the bit. Nothing where it takes them all: for the
/// mean of _Z, and for another base, whose rounding depends on how many frames there are.
HRI_API std::optional<int> frames_beside(ParameterKind from, ParameterKind to,
                                         const HtkFeatureOptions& options = {});

/// Frames as models of this kind see them: as convert() has them, without the absolute energy where
/// the kind has _N.
HRI_API MatrixF observations(const ParameterFile& file, ParameterKind kind,
                             const HtkFeatureOptions& options = {});

}  // namespace hri::htk
