// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/wav.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"

namespace hri {
namespace {

constexpr std::uint16_t kPcm = 1;
constexpr std::uint16_t kFloat = 3;
constexpr std::uint16_t kExtensible = 0xFFFE;
constexpr std::uint32_t kUnknownSize = 0xFFFFFFFF;

struct Format {
  std::uint16_t tag = 0;
  std::uint16_t num_channels = 0;
  std::uint32_t sample_rate_hz = 0;
  std::uint16_t bits = 0;
};

std::uint32_t whole_number(const std::uint8_t* p, unsigned num_bytes) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < num_bytes; ++i) value |= static_cast<std::uint32_t>(p[i]) << (8 * i);
  return value;
}

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  fail(ErrorKind::format, name + ": " + why);
}

Format parse_format(Span<const std::uint8_t> chunk, const std::string& name) {
  if (chunk.size() < 16)
    refuse(name, "field 'fmt ' has " + std::to_string(chunk.size()) + " bytes, needs 16");
  Format f;
  f.tag = static_cast<std::uint16_t>(whole_number(chunk.data(), 2));
  f.num_channels = static_cast<std::uint16_t>(whole_number(chunk.data() + 2, 2));
  f.sample_rate_hz = whole_number(chunk.data() + 4, 4);
  f.bits = static_cast<std::uint16_t>(whole_number(chunk.data() + 14, 2));
  const std::uint32_t frame_bytes = whole_number(chunk.data() + 12, 2);
  if (f.tag == kExtensible) {
    if (chunk.size() < 40)
      refuse(name, "field 'fmt ' is extensible but has " + std::to_string(chunk.size()) + " bytes");
    f.tag = static_cast<std::uint16_t>(whole_number(chunk.data() + 24, 2));
  }
  if (f.num_channels < 1 || f.num_channels > 64) {
    refuse(name, "field 'channels' must lie in 1..64, is " + std::to_string(f.num_channels));
  }
  if (f.sample_rate_hz < 1000 || f.sample_rate_hz > 384000) {
    refuse(name, "field 'sample rate' must lie in 1000..384000 Hz, is " +
                     std::to_string(f.sample_rate_hz));
  }
  const bool pcm = f.tag == kPcm && (f.bits == 8 || f.bits == 16 || f.bits == 24 || f.bits == 32);
  const bool floating = f.tag == kFloat && (f.bits == 32 || f.bits == 64);
  if (!pcm && !floating) {
    refuse(
        name,
        "codec " + std::to_string(f.tag) + " with " + std::to_string(f.bits) +
            " bits is not supported; PCM (1) with 8, 16, 24, 32 or float (3) with 32, 64 bits is");
  }
  const std::uint32_t expected = f.num_channels * (f.bits / 8U);
  if (frame_bytes != expected) {
    refuse(name, "field 'block align' is " + std::to_string(frame_bytes) + ", " +
                     std::to_string(f.num_channels) + " channels of " + std::to_string(f.bits) +
                     " bits take " + std::to_string(expected) + " bytes");
  }
  return f;
}

double decode(const std::uint8_t* p, const Format& f) {
  if (f.tag == kFloat && f.bits == 32) {
    float value = 0;
    std::memcpy(&value, p, sizeof value);
    return static_cast<double>(value);
  }
  if (f.tag == kFloat) {
    double value = 0;
    std::memcpy(&value, p, sizeof value);
    return value;
  }
  if (f.bits == 8) return (static_cast<double>(*p) - 128.0) / 128.0;  // the one unsigned format
  // Shifted to the top, the sign bit comes to stand where int32 has it.
  const std::uint32_t raw = whole_number(p, f.bits / 8U) << (32U - f.bits);
  return static_cast<double>(static_cast<std::int32_t>(raw)) / 2147483648.0;
}

// The bytes of the data chunk that are really there, with a note where that is not what the header
// says.
Span<const std::uint8_t> data_bytes(Span<const std::uint8_t> rest, std::uint32_t declared,
                                    bool is_finished, const Format& f,
                                    std::vector<std::string>* notes) {
  const std::size_t frame = static_cast<std::size_t>(f.num_channels) * (f.bits / 8U);
  std::size_t size = declared;
  if (declared == 0 && is_finished) return {};
  if (declared == 0 || declared == kUnknownSize) {
    size = rest.size();
    notes->push_back("data size was never filled in: read to the end of the file");
  } else if (declared > rest.size()) {
    size = rest.size();
    notes->push_back("file ends early: " + std::to_string(rest.size()) + " of " +
                     std::to_string(declared) + " bytes of sound are there");
  }
  if (size == declared && size % frame != 0)  // what ends early may end within a sample
    notes->push_back(std::to_string(size % frame) + " bytes at the end are no whole sample");
  return rest.subspan(0, size - size % frame);
}

std::vector<float> to_mono(Span<const std::uint8_t> data, const Format& f,
                           const std::string& name) {
  const std::size_t width = f.bits / 8U;
  const std::size_t frame = width * f.num_channels;
  std::vector<float> samples(data.size() / frame);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < f.num_channels; ++c)
      sum += decode(data.data() + i * frame + c * width, f);
    const auto value = static_cast<float>(sum / f.num_channels);
    if (!std::isfinite(value)) refuse(name, "sample " + std::to_string(i) + " is not finite");
    samples[i] = value;
  }
  return samples;
}

}  // namespace

Wav read_wav(const std::string& path) { return parse_wav(read_file(path), path); }

Wav parse_wav(Span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < 12 || std::memcmp(bytes.data(), "RIFF", 4) != 0 ||
      std::memcmp(bytes.data() + 8, "WAVE", 4) != 0) {
    refuse(name, "not a WAV file: no RIFF WAVE header");
  }
  // A recorder fills in the sizes at its end; this one says what a finished file holds.
  const bool is_finished = whole_number(bytes.data() + 4, 4) == bytes.size() - 8;
  Format format;
  bool has_format = false;
  std::size_t at = 12;
  while (at + 8 <= bytes.size()) {
    const std::uint8_t* id = bytes.data() + at;
    const std::uint32_t declared = whole_number(id + 4, 4);
    const auto rest = bytes.subspan(at + 8, bytes.size() - at - 8);
    if (std::memcmp(id, "fmt ", 4) == 0) {
      if (declared > rest.size()) refuse(name, "field 'fmt ' runs beyond the end of the file");
      format = parse_format(rest.subspan(0, declared), name);
      has_format = true;
    } else if (std::memcmp(id, "data", 4) == 0) {
      if (!has_format) refuse(name, "field 'data' stands before 'fmt '");
      Wav wav;
      wav.sample_rate_hz = static_cast<int>(format.sample_rate_hz);
      wav.num_channels = format.num_channels;
      wav.samples =
          to_mono(data_bytes(rest, declared, is_finished, format, &wav.notes), format, name);
      if (wav.samples.empty()) refuse(name, "too short: holds no samples");
      if (wav.num_channels > 1)
        wav.notes.push_back(std::to_string(wav.num_channels) + " channels averaged to mono");
      return wav;
    }
    if (declared > rest.size()) break;
    at += 8 + static_cast<std::size_t>(declared) + declared % 2;  // chunks are padded to even sizes
  }
  refuse(name, has_format ? "has no field 'data'" : "has no field 'fmt '");
}

void write_wav_pcm16(const std::string& path, Span<const float> samples, int sample_rate_hz) {
  require(sample_rate_hz >= 1000 && sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  require(samples.size() < (std::size_t{1} << 30U), "too many samples for a WAV file");
  const auto data_size = static_cast<std::uint32_t>(2 * samples.size());
  std::vector<std::uint8_t> out;
  out.reserve(44 + data_size);
  const auto text = [&](const char* s) { out.insert(out.end(), s, s + 4); };
  const auto number = [&](std::uint32_t value, unsigned num_bytes) {
    for (unsigned i = 0; i < num_bytes; ++i)
      out.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xFFU));
  };
  const auto rate = static_cast<std::uint32_t>(sample_rate_hz);
  text("RIFF");
  number(36 + data_size, 4);
  text("WAVE");
  text("fmt ");
  number(16, 4);
  number(kPcm, 2);
  number(1, 2);
  number(rate, 4);
  number(2 * rate, 4);
  number(2, 2);
  number(16, 2);
  text("data");
  number(data_size, 4);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i]))
      fail(ErrorKind::invalid_argument, "sample " + std::to_string(i) + " is not finite");
    const float scaled = std::round(std::clamp(samples[i], -1.0F, 1.0F) * 32767.0F);
    number(static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled)), 2);
  }
  write_file_atomically(path, out);
}

}  // namespace hri
