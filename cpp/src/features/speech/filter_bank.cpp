// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/filter_bank.hpp"

#include <algorithm>
#include <cmath>

#include "features/speech/cepstra_kernels.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"

namespace hri {
namespace {

// ERB polynomial of Moore and Glasberg in Hz: E (a f^2 + b f + c).
constexpr double kErbA = 6.23e-6;
constexpr double kErbB = 93.39e-3;
constexpr double kErbC = 28.52;
constexpr double kCorner = 700;  // of the mel scale

// Slaney's mel scale.
constexpr double kSlaneyHzPerMel = 200.0 / 3;
constexpr double kSlaneyCornerHz = 1000;
constexpr double kSlaneyCornerMel = kSlaneyCornerHz / kSlaneyHzPerMel;
constexpr double kSlaneyLogStep = 0.06875177742094912;  // ln(6.4) / 27

// The centre between low and high in mel satisfies (700 + fc)^2 = (700 + low)(700 + high); with one
// edge given and high - low = 2 ERB(fc) that is a quadratic in fc. `sign` is +1 when `edge_hz` is
// the low edge, -1 when the high one.
double centre_at_edge(double edge_hz, double erb_factor, double sign) {
  const double side = kCorner + edge_hz;
  const double twice = 2.0 * sign * side * erb_factor;
  const double a = 1.0 - twice * kErbA;
  const double b = 2.0 * kCorner - twice * kErbB;
  const double c = kCorner * kCorner - side * side - twice * kErbC;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

std::vector<double> equally_spaced_in_mel(double from_hz, double to_hz, int count, MelScale scale) {
  const double from = hz_to_mel(from_hz, scale);
  const double to = hz_to_mel(to_hz, scale);
  std::vector<double> result;
  for (int i = 0; i < count; ++i) {
    const double share = count == 1 ? 0.0 : static_cast<double>(i) / (count - 1);
    result.push_back(mel_to_hz(from + share * (to - from), scale));
  }
  return result;
}

// Where the warp takes a frequency (see FilterBankOptions).
double warped(double hz, const FilterBankOptions& o, double high_hz) {
  if (o.warp_low_hz == 0 && o.warp_high_hz == 0) return o.warp * hz;
  const double bend_low = o.warp_low_hz * std::max(1.0, 1 / o.warp);
  const double bend_high = o.warp_high_hz * std::min(1.0, 1 / o.warp);
  if (hz < o.low_hz || hz > high_hz) return hz;
  if (hz < bend_low) {
    const double slope = (o.warp * bend_low - o.low_hz) / (bend_low - o.low_hz);
    return o.low_hz + slope * (hz - o.low_hz);
  }
  if (hz < bend_high) return o.warp * hz;
  const double slope = (high_hz - o.warp * bend_high) / (high_hz - bend_high);
  return high_hz + slope * (hz - high_hz);
}

// The weight of a triangle at a frequency, negative outside.
double side(double hz, double low, double centre, double high) {
  return hz <= centre ? (hz - low) / (centre - low) : (high - hz) / (high - centre);
}

}  // namespace

double hz_to_mel(double hz, MelScale scale) {
  if (scale == MelScale::htk) return 2595.0 * std::log10(1.0 + hz / kCorner);
  if (hz < kSlaneyCornerHz) return hz / kSlaneyHzPerMel;
  return kSlaneyCornerMel + std::log(hz / kSlaneyCornerHz) / kSlaneyLogStep;
}

double mel_to_hz(double mel, MelScale scale) {
  if (scale == MelScale::htk) return kCorner * (std::pow(10.0, mel / 2595.0) - 1.0);
  if (mel < kSlaneyCornerMel) return mel * kSlaneyHzPerMel;
  return kSlaneyCornerHz * std::exp((mel - kSlaneyCornerMel) * kSlaneyLogStep);
}

const char* FilterBankOptions::conflict() const {
  return conflict_at(high_hz > 0 ? 2 * high_hz : 384000);
}

const char* FilterBankOptions::conflict_at(double sample_rate_hz) const {
  const double high = high_hz > 0 ? high_hz : sample_rate_hz / 2;
  if (low_hz >= high) return "low_hz must be less than high_hz, or half the sample rate";
  if (high > sample_rate_hz / 2) return "high_hz must not exceed half the sample rate";
  if (warp_low_hz == 0 && warp_high_hz == 0) return nullptr;
  if (warp_low_hz <= low_hz || warp_low_hz >= high)
    return "warp_low_hz must lie between low_hz and high_hz, or both bends be 0";
  if (warp_high_hz <= warp_low_hz || warp_high_hz >= high)
    return "warp_high_hz must lie between warp_low_hz and high_hz, or both bends be 0";
  if (warp_low_hz * std::max(1.0, 1 / warp) >= warp_high_hz * std::min(1.0, 1 / warp))
    return "warp_low_hz and warp_high_hz lie too close for this warp";
  return nullptr;
}

double equivalent_rectangular_bandwidth(double centre_hz, double erb_factor) {
  return erb_factor * (kErbA * centre_hz * centre_hz + kErbB * centre_hz + kErbC);
}

std::vector<FilterTriangle> filter_triangles(const FilterBankOptions& options, int sample_rate_hz) {
  require(sample_rate_hz >= 1000 && sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  validate(options);
  const char* conflict = options.conflict_at(sample_rate_hz);
  require(conflict == nullptr, conflict);
  const double high = options.high_hz > 0 ? options.high_hz : sample_rate_hz / 2.0;
  std::vector<FilterTriangle> triangles;
  if (options.kind == FilterBankKind::mel) {
    const std::vector<double> edges =
        equally_spaced_in_mel(options.low_hz, high, options.num_filters + 2, options.mel_scale);
    for (std::size_t i = 1; i + 1 < edges.size(); ++i)
      triangles.push_back({edges[i - 1], edges[i], edges[i + 1]});
  } else {
    const double first = centre_at_edge(options.low_hz, options.erb_factor, 1.0);
    const double last = centre_at_edge(high, options.erb_factor, -1.0);
    if (!(first > 0) || !(last > first)) {
      fail(ErrorKind::invalid_argument, "erb_factor " + std::to_string(options.erb_factor) +
                                            ": HFCC filters do not fit between low_hz and high_hz");
    }
    for (const double centre :
         equally_spaced_in_mel(first, last, options.num_filters, MelScale::htk)) {
      const double erb = equivalent_rectangular_bandwidth(centre, options.erb_factor);
      const double corner = kCorner + centre;
      const double low = -(kCorner + erb) + std::sqrt(erb * erb + corner * corner);
      triangles.push_back({low, centre, low + 2 * erb});
    }
  }
  for (FilterTriangle& t : triangles) {
    for (double* hz : {&t.low_hz, &t.centre_hz, &t.high_hz}) *hz = warped(*hz, options, high);
  }
  return triangles;
}

FilterBank::FilterBank(const FilterBankOptions& options, int sample_rate_hz, int fft_size) {
  require(fft_size >= 2 && fft_size % 2 == 0, "fft_size must be even and positive");
  const std::vector<FilterTriangle> triangles = filter_triangles(options, sample_rate_hz);
  const MelScale scale = options.kind == FilterBankKind::mel ? options.mel_scale : MelScale::htk;
  const int bins = fft_size / 2 + 1;
  weights_ = MatrixF::Zero(static_cast<Eigen::Index>(triangles.size()), bins);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const FilterTriangle& t = triangles[i];
    int begin = bins;
    int end = 0;
    for (int k = 0; k < bins; ++k) {
      const double f = static_cast<double>(k) * sample_rate_hz / fft_size;
      double w = options.axis == FilterAxis::hz
                     ? side(f, t.low_hz, t.centre_hz, t.high_hz)
                     : side(hz_to_mel(f, scale), hz_to_mel(t.low_hz, scale),
                            hz_to_mel(t.centre_hz, scale), hz_to_mel(t.high_hz, scale));
      if (!(w > 0)) continue;
      if (options.unit_area) w *= 2 / (t.high_hz - t.low_hz);
      weights_(static_cast<Eigen::Index>(i), k) = static_cast<float>(w);
      begin = std::min(begin, k);
      end = k + 1;
    }
    supports_.insert(supports_.end(), {begin, end});
  }
}

detail::FilterTable FilterBank::table() const {
  return {num_filters(), num_bins(), weights_.data(), supports_.data()};
}

void FilterBank::apply(Span<const float> power, Span<float> out) const {
  require(power.size() == static_cast<std::size_t>(num_bins()) &&
              out.size() == static_cast<std::size_t>(num_filters()),
          "filter bank input must have num_bins() values, output num_filters()");
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int begin = supports_[2 * i];
    const int end = supports_[2 * i + 1];
    const float* w = weights_.data() + static_cast<Eigen::Index>(i) * weights_.cols();
    out[i] = end > begin ? dot(power.data() + begin, w + begin, end - begin) : 0.0F;
  }
}

}  // namespace hri
