// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/silhouette_cepstrum.hpp"

#include <cmath>

#include "hri/core/error.hpp"
#include "hri/features/hand/contour.hpp"
#include "hri/features/hand/hand_crop.hpp"
#include "hri/signal/dwt2.hpp"

namespace hri {
namespace {

// The contour has no sampling rate of its own: a point every "millisecond" lets the speech front
// end be used as it is.
constexpr int kPointsPerSecond = 1000;

CepstraOptions cepstra_options(const SilhouetteCepstrumOptions& o) {
  CepstraOptions c;
  c.sample_rate_hz = kPointsPerSecond;
  c.frame_length_ms = o.num_points / 2.0 > 1000 ? 1000 : o.num_points / 2.0;
  c.frame_shift_ms = c.frame_length_ms / 2;
  c.pre_emphasis = 0;
  c.num_filters = o.num_filters;
  c.low_hz = 0;
  c.num_cepstra = o.num_cepstra;
  c.lifter = 0;
  c.normalisation = Normalisation::none;
  c.delta_orders = 0;
  return c;
}

}  // namespace

const char* SilhouetteCepstrumOptions::conflict() const {
  return num_cepstra < num_filters ? nullptr : "num_cepstra must be less than num_filters";
}

SilhouetteCepstrumComputer::SilhouetteCepstrumComputer(const SilhouetteCepstrumOptions& options)
    : options_(validated(options)), cepstra_(cepstra_options(options)) {}

std::vector<float> SilhouetteCepstrumComputer::contour_signal(ImageView mask) const {
  const HandBox box = hand_box(mask);
  require(box.side_px > 0, "mask is empty");
  MatrixF square(options_.mask_px, options_.mask_px);
  crop(mask, box, square);
  const Wavelet& w = wavelet(options_.wavelet);
  float gain = 1;
  for (int level = 0; level < options_.num_levels; ++level) {
    square = dwt2<float>(square, w, Border::zero).approx;
    gain *= 2;  // of a constant image, a level
  }
  std::vector<ContourPoint> contour;
  trace_contour(square, 0.5F * gain, &contour);
  std::vector<float> signal(static_cast<std::size_t>(options_.num_points), 1.0F);
  if (contour.size() < 3) return signal;
  double mean_x = 0;
  double mean_y = 0;
  for (const ContourPoint& p : contour) {
    mean_x += p.x_px;
    mean_y += p.y_px;
  }
  const auto count = static_cast<double>(contour.size());
  std::vector<double> radius;
  double mean_radius = 0;
  for (const ContourPoint& p : contour) {
    radius.push_back(std::hypot(p.x_px - mean_x / count, p.y_px - mean_y / count));
    mean_radius += radius.back() / count;
  }
  if (!(mean_radius > 0)) return signal;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double position = static_cast<double>(i) * count / static_cast<double>(signal.size());
    const auto before = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(before);
    const double value =
        radius[before] * (1 - share) + radius[(before + 1) % radius.size()] * share;
    signal[i] = static_cast<float>(value / mean_radius);
  }
  return signal;
}

void SilhouetteCepstrumComputer::compute(ImageView mask, Span<float> out) const {
  require(out.size() == static_cast<std::size_t>(num_features()),
          "out must have num_features() values");
  const MatrixF frames = cepstra_.compute(contour_signal(mask));
  for (Eigen::Index c = 0; c < frames.cols(); ++c)
    out[static_cast<std::size_t>(c)] = frames.col(c).mean();
}

}  // namespace hri
