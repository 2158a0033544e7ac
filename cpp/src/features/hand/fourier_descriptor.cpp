// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/fourier_descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hri/core/error.hpp"

namespace hri {
namespace {

using Complex = std::complex<float>;

}  // namespace

const char* FourierDescriptorOptions::conflict() const {
  return num_harmonics < num_points / 2 ? nullptr
                                        : "num_harmonics must be less than num_points / 2";
}

FourierDescriptorComputer::FourierDescriptorComputer(const FourierDescriptorOptions& options)
    : options_(validated(options)), fft_(options.num_points) {}

void FourierDescriptorComputer::compute(Span<const ContourPoint> contour, Span<float> out) const {
  require(out.size() == static_cast<std::size_t>(num_features()),
          "out must have num_features() values");
  struct Work {
    std::vector<float> x, y;
    std::vector<Complex> x_bins, y_bins;
  };
  thread_local Work work;
  const auto count = static_cast<std::size_t>(options_.num_points);
  const auto num_bins = static_cast<std::size_t>(fft_.num_bins());
  work.x.resize(count);
  work.y.resize(count);
  work.x_bins.resize(num_bins);
  work.y_bins.resize(num_bins);
  resample_contour(contour, work.x, work.y);
  double squares = 0;
  for (std::vector<float>* axis : {&work.x, &work.y}) {
    double mean = 0;
    for (const float v : *axis) mean += v;
    mean /= static_cast<double>(count);
    for (float& v : *axis) {
      v -= static_cast<float>(mean);
      squares += static_cast<double>(v) * v;
    }
  }
  std::fill(out.begin(), out.end(), 0.0F);
  // Less than that is the rounding of what should be a single place.
  if (!(squares > 1e-6 * static_cast<double>(count))) return;
  fft_.forward(work.x, {work.x_bins.data(), num_bins});
  fft_.forward(work.y, {work.y_bins.data(), num_bins});
  // Parseval: the squares of all harmonics come to `count` times those of the points.
  const auto scale = static_cast<float>(1.0 / std::sqrt(squares * static_cast<double>(count)));
  const Complex i{0, 1};
  const auto harmonic = [&](std::size_t k) {
    return scale * (work.x_bins[k] + i * work.y_bins[k]);
  };
  const float start = std::arg(harmonic(1));
  for (std::size_t k = 1; k <= static_cast<std::size_t>(options_.num_harmonics); ++k) {
    const Complex forward = harmonic(k);
    const Complex backward = scale * (std::conj(work.x_bins[k]) + i * std::conj(work.y_bins[k]));
    float* to = out.data() + (k - 1) * (options_.use_phase ? 4 : 2);
    if (!options_.use_phase) {
      to[0] = std::abs(forward);
      to[1] = std::abs(backward);
      continue;
    }
    const Complex shift = std::polar(1.0F, -start * static_cast<float>(k));
    const Complex a = forward * shift;
    const Complex b = backward * std::conj(shift);
    to[0] = a.real();
    to[1] = a.imag();
    to[2] = b.real();
    to[3] = b.imag();
  }
}

void FourierDescriptorComputer::compute(ImageView mask, Span<float> out) const {
  thread_local std::vector<ContourPoint> contour;
  trace_contour(mask, &contour);
  require(!contour.empty(), "mask is empty");
  compute(Span<const ContourPoint>(contour), out);
}

}  // namespace hri
