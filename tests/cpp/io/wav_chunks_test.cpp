// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WAV files put together chunk by chunk: extensible formats, wrong orders, wrong sizes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/io/file.hpp"
#include "hri/io/wav.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using io_testing::message_of;
using Bytes = std::vector<std::uint8_t>;

Bytes number(std::uint64_t value, int count) {
  Bytes bytes;
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return bytes;
}
Bytes text(const char* s) { return {s, s + std::strlen(s)}; }
Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& p : parts) all.insert(all.end(), p.begin(), p.end());
  return all;
}
template <class T>
Bytes raw(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

struct Shape {
  std::uint32_t codec = 1;
  std::uint32_t bits = 16;
  std::uint32_t channels = 1;
  std::uint32_t rate_hz = 16000;
};
Bytes format(const Shape& s) {
  return joined({number(s.codec, 2), number(s.channels, 2), number(s.rate_hz, 4),
                 number(std::uint64_t{s.rate_hz} * s.channels * s.bits / 8, 4),
                 number(std::uint64_t{s.channels} * s.bits / 8, 2), number(s.bits, 2)});
}
// WAVE_FORMAT_EXTENSIBLE: the codec stands in the first two bytes of the sub-format.
Bytes extensible(const Shape& s) {
  Shape outer = s;
  outer.codec = 0xFFFE;
  return joined({format(outer),
                 number(22, 2),
                 number(s.bits, 2),
                 number(3, 4),
                 number(s.codec, 2),
                 {0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xAA, 0, 0x38, 0x9B, 0x71}});
}
Bytes chunk(const char* id, const Bytes& body) {
  return joined({text(id), number(body.size(), 4), body, Bytes(body.size() % 2, 0)});
}
Bytes riff(const std::vector<Bytes>& chunks) {
  const Bytes body = joined(chunks);
  return joined({text("RIFF"), number(body.size() + 4, 4), text("WAVE"), body});
}
Bytes sound(const Shape& s, const Bytes& data) {
  return riff({chunk("fmt ", format(s)), chunk("data", data)});
}

std::string refusal(const Bytes& bytes) {
  const std::string message = message_of<FormatError>([&] { (void)parse_wav(bytes, "x.wav"); });
  EXPECT_EQ(message.rfind("x.wav: ", 0), 0U) << message;
  return message;
}

TEST(WavChunks, ExtremesOfEveryWidthAreFullScale) {
  const auto samples = [](const Shape& s, const Bytes& d) {
    return parse_wav(sound(s, d), "x").samples;
  };
  EXPECT_EQ(samples({1, 8}, {0, 128, 255}), (std::vector<float>{-1, 0, 127.0F / 128}));
  EXPECT_EQ(samples({1, 16}, raw<std::int16_t>({-32768, 0, 32767})),
            (std::vector<float>{-1, 0, 32767.0F / 32768}));
  EXPECT_EQ(samples({1, 24}, {0, 0, 0x80, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F}),
            (std::vector<float>{-1, -1.0F / 8388608, 8388607.0F / 8388608}));
  EXPECT_EQ(
      samples({1, 32}, raw<std::int32_t>({std::numeric_limits<std::int32_t>::min(), 1 << 30})),
      (std::vector<float>{-1, 0.5F}));
  EXPECT_EQ(samples({3, 32}, raw<float>({-1.5F, 1e-20F})), (std::vector<float>{-1.5F, 1e-20F}));
  EXPECT_EQ(samples({3, 64}, raw<double>({-0.125, 0.5})), (std::vector<float>{-0.125F, 0.5F}));
}

TEST(WavChunks, ExtensibleFormatIsReadAsThePlainOne) {
  const Bytes data = raw<std::int16_t>({100, -200, 300, -400});
  for (const Shape& s : {Shape{1, 16, 2}, Shape{3, 32, 1}, Shape{1, 8, 4}}) {
    const Wav plain = parse_wav(sound(s, data), "x");
    const Wav wide = parse_wav(riff({chunk("fmt ", extensible(s)), chunk("data", data)}), "x");
    EXPECT_EQ(wide.samples, plain.samples);
    EXPECT_EQ(wide.num_channels, plain.num_channels);
    EXPECT_EQ(wide.sample_rate_hz, 16000);
  }
  Bytes cut = extensible({});
  cut.resize(24);
  EXPECT_NE(refusal(riff({chunk("fmt ", cut), chunk("data", data)})).find("extensible"),
            std::string::npos);
  EXPECT_NE(refusal(riff({chunk("fmt ", extensible({6, 8})), chunk("data", data)})).find("codec 6"),
            std::string::npos);
}

TEST(WavChunks, RefusalsNameTheField) {
  const Bytes fmt = chunk("fmt ", format({}));
  const Bytes data = chunk("data", {0, 0});
  const std::pair<Bytes, const char*> cases[] = {
      {riff({data, fmt}), "'data' stands before 'fmt '"},
      {riff({fmt}), "no field 'data'"},
      {riff({chunk("LIST", {1, 2})}), "no field 'fmt '"},
      {riff({}), "no field 'fmt '"},
      {riff({chunk("fmt ", Bytes(15, 1)), data}), "'fmt ' has 15 bytes"},
      {riff({joined({text("fmt "), number(0xFFFFFFF0, 4), format({})})}), "'fmt ' runs beyond"},
      {riff({fmt, joined({text("LIST"), number(0xFFFFFFFF, 4), {1, 2, 3, 4}})}), "no field 'data'"},
      {sound({1, 16, 1, 999}, {0, 0}), "sample rate"},
      {sound({1, 16, 1, 384001}, {0, 0}), "sample rate"},
      {sound({1, 16, 0}, {0, 0}), "channels"},
      {sound({1, 16, 65}, Bytes(130, 0)), "channels"},
      {sound({2, 4}, {0, 0}), "codec 2 with 4 bits"},    // ADPCM
      {sound({85, 0}, {0, 0}), "codec 85"},              // MP3
      {sound({3, 16}, {0, 0}), "codec 3 with 16 bits"},  // half floats
      {sound({1, 16, 1}, {7}), "too short"},             // half a sample
      {sound({1, 16, 2}, {7, 7, 7}), "too short"},       // less than one of every channel
      {sound({3, 64}, raw<double>({0, 1e300})), "sample 1 is not finite"},  // beyond float
      {sound({3, 32, 2}, raw<float>({0, 0, 0, -HUGE_VALF})), "sample 1 is not finite"},
      {text("RIFX"), "RIFF"},
      {joined({text("RIFF"), number(4, 4), text("AVI ")}), "RIFF WAVE"},
  };
  for (const auto& [bytes, named] : cases) {
    EXPECT_NE(refusal(bytes).find(named), std::string::npos) << named << ": " << refusal(bytes);
  }
}

TEST(WavChunks, WhatFollowsTheSoundIsNotHeard) {
  const Bytes data = raw<std::int16_t>({1, 2, 3});
  const Bytes with_tail = riff(
      {chunk("fmt ", format({})), chunk("data", data), chunk("LIST", text("made by a program"))});
  const Wav wav = parse_wav(with_tail, "x");
  EXPECT_EQ(wav.samples.size(), 3U);
  EXPECT_TRUE(wav.notes.empty());
  // An odd number of bytes: the last half sample is left out, the padding is not sound.
  EXPECT_EQ(parse_wav(sound({1, 16}, {1, 0, 2, 0, 3}), "x").samples.size(), 2U);
  EXPECT_EQ(parse_wav(sound({1, 8}, {1, 2, 3}), "x").samples.size(), 3U);
}

TEST(WavChunks, EveryLengthOfACutFileIsReadOrRefused) {
  const Bytes whole = sound({1, 16, 2}, Bytes(40, 5));
  const std::size_t header = whole.size() - 40;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    if (length < header + 4) {
      (void)refusal(cut);
      continue;
    }
    const Wav wav = parse_wav(cut, "x");
    EXPECT_EQ(wav.samples.size(), (length - header) / 4) << length;
    EXPECT_NE(wav.notes.at(0).find("ends early"), std::string::npos) << length;
  }
}

// Every kind of file, with bytes changed, cut out, doubled and cut off: only a FormatError may come
// of it, and never more samples than bytes.
TEST(WavChunks, MutatedFilesThrowFormatErrorsOnly) {
  const Bytes data(48, 61);
  const std::vector<Bytes> seeds = {
      sound({1, 8}, data),
      sound({1, 24, 2}, data),
      sound({3, 64}, data),
      riff({chunk("LIST", {1, 2, 3}), chunk("fmt ", extensible({3, 32, 3})), chunk("data", data)}),
  };
  Random random(29);
  int read = 0;
  for (int i = 0; i < 8000; ++i) {
    Bytes broken = seeds[random.below(seeds.size())];
    for (std::uint64_t k = 0; k <= random.below(4); ++k) {
      const auto at = static_cast<std::ptrdiff_t>(random.below(broken.size()));
      const auto to = std::min(static_cast<std::ptrdiff_t>(broken.size()),
                               at + 1 + static_cast<std::ptrdiff_t>(random.below(6)));
      const Bytes piece(broken.begin() + at, broken.begin() + to);
      switch (random.below(4)) {
        case 0:
          broken[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random.below(256));
          break;
        case 1:
          std::fill(broken.begin() + at, broken.begin() + to, std::uint8_t{0xFF});
          break;
        case 2:
          broken.insert(broken.begin() + at, piece.begin(), piece.end());
          break;
        default:
          if (broken.size() > 12) broken.erase(broken.begin() + at, broken.begin() + to);
      }
    }
    try {
      const Wav wav = parse_wav(broken, "x");
      ++read;
      ASSERT_FALSE(wav.samples.empty());
      ASSERT_LE(wav.samples.size(), broken.size());
      for (const float s : wav.samples) ASSERT_TRUE(std::isfinite(s));
    } catch (const FormatError&) {
    }
  }
  EXPECT_GT(read, 500);
  EXPECT_LT(read, 7500);
}

TEST(WavChunks, WritingRefusesWhatNoFileHolds) {
  const TestFolder folder;
  const std::string path = folder / "a.wav";
  write_wav_pcm16(path, std::vector<float>{0.5F}, 16000);
  const Bytes before = read_file(path);
  EXPECT_NE(message_of<InvalidArgument>([&] {
              write_wav_pcm16(path, std::vector<float>{0, std::nanf("")}, 16000);
            }).find("sample 1"),
            std::string::npos);
  for (const int rate : {0, 999, 384001, -16000})
    EXPECT_THROW(write_wav_pcm16(path, std::vector<float>{0}, rate), InvalidArgument) << rate;
  EXPECT_EQ(read_file(path), before);
  EXPECT_EQ(before.size(), 46U);
}

}  // namespace
}  // namespace hri
