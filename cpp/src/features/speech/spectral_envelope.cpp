// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/spectral_envelope.hpp"

#include <cmath>

namespace hri {

void spectral_envelope(Span<const float> cepstra, Span<float> out) {
  constexpr double kPi = 3.14159265358979323846;
  for (std::size_t t = 0; t < out.size(); ++t) {
    const double w = kPi * static_cast<double>(t + 1) / static_cast<double>(out.size());
    double sum = 0;
    for (std::size_t i = 0; i < cepstra.size(); ++i)
      sum += static_cast<double>(cepstra[i]) * std::cos(static_cast<double>(i + 1) * w);
    out[t] = static_cast<float>(std::exp(sum));
  }
}

}  // namespace hri
