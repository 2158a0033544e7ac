// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Triangular filter banks over a power spectrum: mel (thesis eq. 3.30-3.31) and HFCC with the
// bandwidth factor E (Skowronski and Harris, JASA 116(3), 2004).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

namespace detail {
struct FilterTable;
}

enum class FilterBankKind : std::uint8_t { mel, hfcc };
constexpr auto enum_names(FilterBankKind) { return std::array{"mel", "hfcc"}; }

enum class MelScale : std::uint8_t {
  htk,     ///< 2595 log10(1 + f / 700)
  slaney,  ///< linear up to 1 kHz, logarithmic above (Slaney's Auditory Toolbox, librosa)
};
constexpr auto enum_names(MelScale) { return std::array{"htk", "slaney"}; }

/// Along which axis the sides of a triangle are straight.
enum class FilterAxis : std::uint8_t {
  hz,
  mel,  ///< as in HTK and Kaldi
};
constexpr auto enum_names(FilterAxis) { return std::array{"hz", "mel"}; }

struct HRI_API FilterBankOptions {
  FilterBankKind kind = FilterBankKind::mel;
  int num_filters = 26;
  double low_hz = 100;
  double high_hz = 0;
  double erb_factor = 1;
  double warp = 1;
  /// Below warp_low_hz * max(1, 1 / warp) and above warp_high_hz * min(1, 1 / warp) the warp is a
  /// straight line that leaves low_hz and high_hz where they are (piecewise-linear, as in HTK and
  /// Kaldi, whose factor is 1 / warp).
  double warp_low_hz = 0;
  double warp_high_hz = 0;
  MelScale mel_scale = MelScale::htk;
  FilterAxis axis = FilterAxis::hz;
  bool unit_area = false;

  static constexpr const char* kName = "FilterBankOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("kind", o.kind, any_value, "shape of the filters");
    v("num_filters", o.num_filters, within(1, 512), "number of filters");
    v("low_hz", o.low_hz, within(0, 192000), "lower edge of the first filter");
    v("high_hz", o.high_hz, within(0, 192000),
      "upper edge of the last filter; 0: half the sample rate");
    v("erb_factor", o.erb_factor, within(0.1, 10),
      "E of HFCC-E: filters E times as wide as an ear's; mel ignores it");
    v("warp", o.warp, within(0.5, 2), "vocal-tract-length factor on all filter frequencies");
    v("warp_low_hz", o.warp_low_hz, within(0, 192000),
      "below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend");
    v("warp_high_hz", o.warp_high_hz, within(0, 192000), "above it the warp bends back to high_hz");
    v("mel_scale", o.mel_scale, any_value, "mel scale of the filters' spacing; HFCC uses HTK's");
    v("axis", o.axis, any_value, "axis on which the filters are triangles");
    v("unit_area", o.unit_area, any_value,
      "weights times 2 / (high - low), for filters of equal area");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
  /// The same for this sample rate, which bounds the edges.
  [[nodiscard]] const char* conflict_at(double sample_rate_hz) const;
};

/// Edges and centre of one triangle, Hz: 0 at low, 1 at centre, 0 at high.
struct FilterTriangle {
  double low_hz = 0;
  double centre_hz = 0;
  double high_hz = 0;
};

HRI_API double hz_to_mel(double hz, MelScale scale = MelScale::htk);
HRI_API double mel_to_hz(double mel, MelScale scale = MelScale::htk);
/// Equivalent rectangular bandwidth in Hz at `centre_hz` (thesis eq. 6.10 with its units put
/// right).
HRI_API double equivalent_rectangular_bandwidth(double centre_hz, double erb_factor);

/// The triangles before they are sampled. Throws InvalidArgument where they do not fit below the
/// Nyquist rate before the warp; what `warp` moves beyond it is cut off when they are sampled.
HRI_API std::vector<FilterTriangle> filter_triangles(const FilterBankOptions& options,
                                                     int sample_rate_hz);

/// Immutable; const calls are safe from several threads.
class HRI_API FilterBank {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  FilterBank(const FilterBankOptions& options, int sample_rate_hz, int fft_size);

  [[nodiscard]] int num_filters() const { return static_cast<int>(weights_.rows()); }
  [[nodiscard]] int num_bins() const { return static_cast<int>(weights_.cols()); }
  /// Weights, shape (num_filters, num_bins).
  [[nodiscard]] const MatrixF& weights() const { return weights_; }

  /// What the kernels for frames side by side need.
  [[nodiscard]] detail::FilterTable table() const;

  /// Energy of every filter: `power` (num_bins) to `out` (num_filters). Allocates nothing.
  void apply(Span<const float> power, Span<float> out) const;

 private:
  MatrixF weights_;
  std::vector<int> supports_;  // first bin where a filter is not zero, and the one past the last
};

}  // namespace hri
