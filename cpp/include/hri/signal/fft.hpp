// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Real FFT behind one small interface. One signal at a time goes through the library behind it
// (Eigen's kissfft backend); signals side by side (signal/lanes.hpp) of a power of two through our
// own radix-4 transform, several times as fast.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

namespace detail {
struct LaneFftPlan;
}

/// Real-input FFT of one fixed size. Const calls are safe from several threads (the library's plan
/// is kept per thread).
class HRI_API RealFft {
 public:
  /// `size` even, 2..2^24. Throws InvalidArgument otherwise.
  explicit RealFft(int size);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int num_bins() const { return size_ / 2 + 1; }

  /// `in` (size) to `out` (num_bins).
  void forward(Span<const float> in, Span<std::complex<float>> out) const;
  /// |X_k|^2 of `in` (size) into `out` (num_bins).
  void power_spectrum(Span<const float> in, Span<float> out) const;
  /// The same for num_lanes() signals side by side: `signals` (size * num_lanes()) is used as work
  /// space, `out` takes num_bins * num_lanes().
  void power_spectra(Span<float> signals, Span<float> out) const;

 private:
  int size_;
  std::shared_ptr<const detail::LaneFftPlan> plan_;  // none where size is not a power of two
};

}  // namespace hri
