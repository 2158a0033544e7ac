// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cutting a signal into overlapping frames, and the window that is laid over each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"

namespace hri {

/// How many whole frames of `frame_length` fit, one every `frame_shift` samples; both at least 1.
HRI_API int num_frames(std::size_t num_samples, int frame_length, int frame_shift);

enum class WindowKind : std::uint8_t {
  hamming,        ///< 0.54 - 0.46 cos(2 pi n / (size - 1)), as HTK and the thesis use
  hann,           ///< 0.5 - 0.5 cos(2 pi n / (size - 1))
  hann_periodic,  ///< 0.5 - 0.5 cos(2 pi n / size), as librosa uses
  povey,          ///< hann to the power of 0.85, as Kaldi uses
  rectangular,
};
constexpr auto enum_names(WindowKind) {
  return std::array{"hamming", "hann", "hann_periodic", "povey", "rectangular"};
}

/// A window of `size` >= 1 samples.
HRI_API std::vector<float> make_window(WindowKind kind, int size);

}  // namespace hri
