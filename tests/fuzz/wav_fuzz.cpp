// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a WAV file.
#include "fuzzing.hpp"
#include "hri/io/wav.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    const hri::Wav wav = hri::parse_wav({data, size}, "input");
    if (wav.samples.empty() || wav.sample_rate_hz <= 0) std::abort();
    for (const float v : wav.samples) {
      if (!std::isfinite(v)) std::abort();
    }
  });
  return 0;
}
