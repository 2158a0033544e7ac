// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/framing.hpp"

#include <cmath>

#include "hri/core/error.hpp"

namespace hri {

int num_frames(std::size_t num_samples, int frame_length, int frame_shift) {
  require(frame_length >= 1 && frame_shift >= 1,
          "frame length and shift must be at least one sample");
  const auto length = static_cast<std::size_t>(frame_length);
  if (num_samples < length) return 0;
  return 1 + static_cast<int>((num_samples - length) / static_cast<std::size_t>(frame_shift));
}

std::vector<float> make_window(WindowKind kind, int size) {
  require(size >= 1, "window size must be at least 1");
  constexpr double kTwoPi = 6.283185307179586476925;
  std::vector<float> window(static_cast<std::size_t>(size), 1.0F);
  if (kind == WindowKind::rectangular || size == 1) return window;
  const double period = kind == WindowKind::hann_periodic ? size : size - 1;
  const double share = kind == WindowKind::hamming ? 0.46 : 0.5;
  for (std::size_t n = 0; n < window.size(); ++n) {
    const double value = (1 - share) - share * std::cos(kTwoPi * static_cast<double>(n) / period);
    window[n] = static_cast<float>(kind == WindowKind::povey ? std::pow(value, 0.85) : value);
  }
  return window;
}

}  // namespace hri
