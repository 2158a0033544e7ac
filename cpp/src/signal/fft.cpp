// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/fft.hpp"

#include <unsupported/Eigen/FFT>

#include "hri/core/error.hpp"
#include "hri/signal/lanes.hpp"
#include "signal/lane_kernels.hpp"

namespace hri {
namespace {

// Plans and work space of one thread; Eigen keeps a plan for every size it has met.
struct Workspace {
  Eigen::FFT<float> fft;
  std::vector<std::complex<float>> bins;
  std::vector<float> signal;
  std::vector<float> power;
  Workspace() { fft.SetFlag(Eigen::FFT<float>::HalfSpectrum); }
};

Workspace& workspace() {
  thread_local Workspace w;
  return w;
}

}  // namespace

RealFft::RealFft(int size) : size_(size) {
  require(size >= 2 && size <= (1 << 24) && size % 2 == 0, "FFT size must be even, 2..2^24");
  if ((size & (size - 1)) == 0) plan_ = std::make_shared<const detail::LaneFftPlan>(size);
}

void RealFft::forward(Span<const float> in, Span<std::complex<float>> out) const {
  require(in.size() == static_cast<std::size_t>(size_) &&
              out.size() == static_cast<std::size_t>(num_bins()),
          "FFT input must have size() values, output num_bins()");
  workspace().fft.fwd(out.data(), in.data(), size_);
}

void RealFft::power_spectrum(Span<const float> in, Span<float> out) const {
  auto& bins = workspace().bins;
  bins.resize(static_cast<std::size_t>(num_bins()));
  forward(in, {bins.data(), bins.size()});
  require(out.size() == bins.size(), "power spectrum output must have num_bins() values");
  for (std::size_t k = 0; k < bins.size(); ++k) out[k] = std::norm(bins[k]);
}

void RealFft::power_spectra(Span<float> signals, Span<float> out) const {
  const auto lanes = static_cast<std::size_t>(num_lanes());
  const auto length = static_cast<std::size_t>(size_);
  const auto bins = static_cast<std::size_t>(num_bins());
  require(signals.size() == length * lanes && out.size() == bins * lanes,
          "FFT input must have size() * num_lanes() values, output num_bins() * num_lanes()");
  if (plan_) {
    const detail::LaneFftTables tables{plan_->half, plan_->twiddles.data(), plan_->split.data(),
                                       plan_->order.data()};
    detail::lane_kernels().power_spectra(tables, signals.data(), out.data());
    return;
  }
  auto& signal = workspace().signal;
  auto& power = workspace().power;
  signal.resize(length);
  power.resize(bins);
  for (std::size_t l = 0; l < lanes; ++l) {
    for (std::size_t n = 0; n < length; ++n) signal[n] = signals[n * lanes + l];
    power_spectrum(signal, power);
    for (std::size_t k = 0; k < bins; ++k) out[k * lanes + l] = power[k];
  }
}

}  // namespace hri
