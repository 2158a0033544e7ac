// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/fft.hpp"

#include <unsupported/Eigen/FFT>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// Plans and work space of one thread; Eigen keeps a plan for every size it has met.
struct Workspace {
  Eigen::FFT<float> fft;
  std::vector<std::complex<float>> bins;
  Workspace() { fft.SetFlag(Eigen::FFT<float>::HalfSpectrum); }
};

Workspace& workspace() {
  thread_local Workspace w;
  return w;
}

}  // namespace

RealFft::RealFft(int size) : size_(size) {
  require(size >= 2 && size <= (1 << 24) && size % 2 == 0, "FFT size must be even, 2..2^24");
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

}  // namespace hri
