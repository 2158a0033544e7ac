// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Real FFT behind one small interface; the library behind it is Eigen's (kissfft backend).
#pragma once

#include <complex>
#include <vector>

#include "hri/core/types.hpp"

namespace hri {

/// Real-input FFT of one fixed size. Const calls are safe from several threads (the plan is kept
/// per thread).
class RealFft {
 public:
  /// `size` even, 2..2^24. Throws InvalidArgument otherwise.
  explicit RealFft(int size);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int num_bins() const { return size_ / 2 + 1; }

  /// `in` (size) to `out` (num_bins).
  void forward(Span<const float> in, Span<std::complex<float>> out) const;
  /// |X_k|^2 of `in` (size) into `out` (num_bins).
  void power_spectrum(Span<const float> in, Span<float> out) const;

 private:
  int size_;
};

}  // namespace hri
