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

std::vector<float> hamming_window(int size) {
  require(size >= 1, "window size must be at least 1");
  constexpr double kTwoPi = 6.283185307179586476925;
  std::vector<float> window(static_cast<std::size_t>(size), 1.0F);
  for (int n = 0; size > 1 && n < size; ++n) {
    window[static_cast<std::size_t>(n)] =
        static_cast<float>(0.54 - 0.46 * std::cos(kTwoPi * n / (size - 1)));
  }
  return window;
}

}  // namespace hri
