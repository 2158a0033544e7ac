// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WAV files (RIFF WAVE, PCM and IEEE float), so that C++ and Python read one recording to the same
// samples.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

struct Wav {
  std::vector<float> samples;  ///< mono, full scale is -1..1
  int sample_rate_hz = 0;
  int num_channels = 0;            ///< in the file; several are averaged
  std::vector<std::string> notes;  ///< what was converted, or is missing at the end
};

/// PCM of 8, 16, 24 or 32 bits and float of 32 or 64, plain or WAVE_FORMAT_EXTENSIBLE, 1..64
/// channels. Data shorter than the header says, and streams whose sizes were never filled in (0 or
/// 0xFFFFFFFF), are read as far as they go, with a note. Throws IoError; FormatError naming file
/// and field for anything else, for no samples, and for a sample that is not finite (names its
/// index). Memory is bounded by the real size of the file.
HRI_API Wav read_wav(const std::string& path);
HRI_API Wav parse_wav(Span<const std::uint8_t> bytes, const std::string& name);

/// Writes mono 16-bit PCM, clipping at full scale; an old file stays whole if this fails.
HRI_API void write_wav_pcm16(const std::string& path, Span<const float> samples,
                             int sample_rate_hz);

}  // namespace hri
