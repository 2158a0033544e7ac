// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/silhouette_cepstrum.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/features/hand/contour.hpp"
#include "hri/features/hand/hand_crop.hpp"
#include "hri/signal/dwt.hpp"
#include "hri/signal/dwt2.hpp"

namespace hri {
namespace {

// Neither signal has a sampling rate of its own, and the mel scale needs one. For a contour it is a
// point every "millisecond": bands of nearly equal width. For a picture it is that of the speech
// front end, from which the thesis takes all other steps.
constexpr int kContourRateHz = 1000;
constexpr int kPictureRateHz = 16000;
constexpr int kMinFrameLength = 32;  // half of it is 1 ms of a picture
constexpr int kMaxFrameLength = 65536;

int signal_length(const SilhouetteCepstrumOptions& o) {
  if (o.signal == SilhouetteSignal::contour) return o.num_points;
  auto side = static_cast<std::size_t>(o.mask_px);
  const std::size_t num_taps = wavelet(o.wavelet).dec_lo.size();
  for (int level = 0; level < o.num_levels; ++level)
    side = dwt_length(side, num_taps, Border::zero);
  return static_cast<int>(side * side);
}

// Frames overlap by half of so many samples.
int frame_length(const SilhouetteCepstrumOptions& o) {
  return 2 * (signal_length(o) / (o.num_frames + 1));
}

CepstraOptions cepstra_options(const SilhouetteCepstrumOptions& o) {
  const bool of_contour = o.signal == SilhouetteSignal::contour;
  const int length = frame_length(o);
  CepstraOptions c;
  // No frame may be longer than a second.
  c.sample_rate_hz = std::max(of_contour ? kContourRateHz : kPictureRateHz, length);
  c.frame_length_ms = 1000.0 * length / c.sample_rate_hz;
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
  if (num_cepstra >= num_filters) return "num_cepstra must be less than num_filters";
  const bool of_contour = signal == SilhouetteSignal::contour;
  const int length = frame_length(*this);
  if (length < kMinFrameLength) {
    return of_contour ? "num_points is too few for num_frames"
                      : "mask_px after num_levels is too small for num_frames";
  }
  return length <= kMaxFrameLength ? nullptr
                                   : "mask_px after num_levels is too large for num_frames";
}

SilhouetteCepstrumComputer::SilhouetteCepstrumComputer(const SilhouetteCepstrumOptions& options)
    : options_(validated(options)), cepstra_(cepstra_options(options)) {}

int SilhouetteCepstrumComputer::num_features() const {
  return (options_.num_cepstra + 1) * (options_.average_frames ? 1 : options_.num_frames);
}

MatrixF SilhouetteCepstrumComputer::approximation(ImageView mask) const {
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
  return square / gain;
}

std::vector<float> SilhouetteCepstrumComputer::picture_signal(ImageView mask) const {
  const MatrixF picture = approximation(mask);
  std::vector<float> signal;
  signal.reserve(static_cast<std::size_t>(picture.size()));
  for (Eigen::Index x = 0; x < picture.cols(); ++x) {
    for (Eigen::Index y = 0; y < picture.rows(); ++y) signal.push_back(picture(y, x));
  }
  return signal;
}

std::vector<float> SilhouetteCepstrumComputer::contour_signal(ImageView mask) const {
  std::vector<ContourPoint> contour;
  trace_contour(approximation(mask), 0.5F, &contour);
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
  // Samples that remain behind the last frame may make another one.
  const MatrixF frames =
      cepstra_
          .compute(options_.signal == SilhouetteSignal::contour ? contour_signal(mask)
                                                                : picture_signal(mask))
          .topRows(options_.num_frames);
  const Eigen::Index width = frames.cols();
  if (options_.average_frames) {
    for (Eigen::Index c = 0; c < width; ++c)
      out[static_cast<std::size_t>(c)] = frames.col(c).mean();
    return;
  }
  for (Eigen::Index frame = 0; frame < options_.num_frames; ++frame) {
    for (Eigen::Index c = 0; c < width; ++c)
      out[static_cast<std::size_t>(frame * width + c)] = frames(frame, c);
  }
}

}  // namespace hri
