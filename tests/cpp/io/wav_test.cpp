// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/wav.hpp"

#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using io_testing::message_of;
using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
void put(Bytes& bytes, const char* text) {
  bytes.insert(bytes.end(), text, text + std::strlen(text));
}

constexpr std::uint32_t kPcm = 1;
constexpr std::uint32_t kFloat = 3;

// A WAV of one rate whose sizes can be declared wrong.
Bytes wav(std::uint32_t codec, int channels, int bits, const Bytes& data, std::uint32_t data_size) {
  Bytes bytes;
  put(bytes, "RIFF");
  put(bytes, 36 + data_size, 4);
  put(bytes, "WAVEfmt ");
  put(bytes, 16, 4);
  put(bytes, codec, 2);
  put(bytes, static_cast<std::uint64_t>(channels), 2);
  put(bytes, 16000, 4);
  put(bytes,
      std::uint64_t{2000} * static_cast<std::uint64_t>(channels) * static_cast<std::uint64_t>(bits),
      4);
  put(bytes, static_cast<std::uint64_t>(channels * bits / 8), 2);
  put(bytes, static_cast<std::uint64_t>(bits), 2);
  put(bytes, "data");
  put(bytes, data_size, 4);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}
Bytes wav(std::uint32_t codec, int channels, int bits, const Bytes& data) {
  return wav(codec, channels, bits, data, static_cast<std::uint32_t>(data.size()));
}

Bytes float_bytes(const std::vector<float>& values) {
  Bytes bytes(values.size() * sizeof(float));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

TEST(Wav, IsReadInEveryWidth) {
  const auto first = [](const Bytes& bytes) { return parse_wav(bytes, "x").samples.at(0); };
  EXPECT_FLOAT_EQ(first(wav(kPcm, 1, 8, {0xC0, 0x80})), 0.5F);
  EXPECT_FLOAT_EQ(first(wav(kPcm, 1, 16, {0x00, 0xC0})), -0.5F);
  EXPECT_FLOAT_EQ(first(wav(kPcm, 1, 24, {0, 0, 0x40, 0, 0, 0})), 0.5F);
  EXPECT_FLOAT_EQ(first(wav(kPcm, 1, 32, {0, 0, 0, 0x40})), 0.5F);
  EXPECT_FLOAT_EQ(first(wav(kFloat, 1, 32, float_bytes({0.25F}))), 0.25F);
}

TEST(Wav, AveragesChannelsAndSaysSo) {
  const Wav w = parse_wav(wav(kFloat, 2, 32, float_bytes({0.5F, 0.0F, -1.0F, 0.5F})), "x");
  EXPECT_EQ(w.samples, (std::vector<float>{0.25F, -0.25F}));
  EXPECT_EQ(w.num_channels, 2);
  ASSERT_EQ(w.notes.size(), 1U);
  EXPECT_NE(w.notes[0].find("2"), std::string::npos);
}

TEST(Wav, ShorterThanItsHeaderIsReadInPart) {
  for (const std::uint32_t claimed : {0U, 0xFFFFFFFFU, 1000U, 0x7FFFFFFFU}) {
    const Wav w = parse_wav(wav(kPcm, 1, 16, {0, 64, 0, 64, 0, 64}, claimed), "x");
    EXPECT_EQ(w.samples.size(), 3U) << claimed;
    EXPECT_FALSE(w.notes.empty()) << claimed;
  }
}

TEST(Wav, OfAnEmptyRecordingIsNoSoundFromTheChunksBehind) {
  Bytes bytes = wav(kPcm, 1, 16, {});
  put(bytes, "LIST");
  put(bytes, 4, 4);
  put(bytes, "INFO");
  const Bytes unfinished = bytes;  // its header says 36 bytes
  bytes[4] = static_cast<std::uint8_t>(bytes.size() - 8);
  EXPECT_EQ(message_of<FormatError>([&] { parse_wav(bytes, "x"); }),
            "x: too short: holds no samples");
  EXPECT_EQ(parse_wav(unfinished, "x").samples.size(), 6U);
}

TEST(Wav, SaysThatItsEndIsNoWholeSample) {
  const Wav found = parse_wav(wav(kPcm, 2, 16, Bytes(11, 0)), "x");
  EXPECT_EQ(found.samples.size(), 2U);
  EXPECT_EQ(found.notes.front(), "3 bytes at the end are no whole sample");
}

TEST(Wav, RefusesSamplesInWiderContainers) {
  Bytes bytes = wav(kPcm, 1, 24, Bytes(12, 0));
  bytes[32] = 4;
  EXPECT_EQ(message_of<FormatError>([&] { parse_wav(bytes, "x"); }),
            "x: field 'block align' is 4, 1 channels of 24 bits take 3 bytes");
}

TEST(Wav, RefusesWhatItCannotTellByName) {
  const std::string codec = message_of<FormatError>([] {
    (void)parse_wav(wav(7, 1, 8, {1, 2}), "ulaw.wav");
  });
  EXPECT_NE(codec.find("ulaw.wav"), std::string::npos);
  EXPECT_NE(codec.find('7'), std::string::npos);
  EXPECT_NE(
      message_of<FormatError>([] { (void)parse_wav(wav(kPcm, 1, 16, {}), "x"); }).find("too short"),
      std::string::npos);
  EXPECT_NE(message_of<FormatError>([] {
              (void)parse_wav(wav(kFloat, 1, 32, float_bytes({0, 0, std::nanf("")})), "x");
            }).find('2'),
            std::string::npos);
  for (const auto& [channels, bits] : {std::pair{0, 16}, {1, 12}, {1, 0}, {9999, 16}}) {
    EXPECT_THROW(parse_wav(wav(kPcm, channels, bits, {1, 2, 3, 4}), "x"), FormatError);
  }
  EXPECT_THROW(parse_wav({}, "x"), FormatError);
}

TEST(Wav, SkipsChunksItDoesNotKnow) {
  Bytes bytes = wav(kPcm, 1, 16, {0, 64});
  Bytes extra;
  put(extra, "LIST");
  put(extra, 3, 4);  // odd: one byte of padding follows
  put(extra, "abc");
  put(extra, 0, 1);
  bytes.insert(bytes.begin() + 12, extra.begin(), extra.end());
  EXPECT_EQ(parse_wav(bytes, "x").samples, std::vector<float>{0.5F});
}

TEST(Wav, WrittenIsReadAndClips) {
  const TestFolder folder;
  const std::vector<float> samples{0, 0.5F, -0.5F, 2.0F, -2.0F};
  write_wav_pcm16(folder / "a.wav", samples, 8000);
  const Wav w = read_wav(folder / "a.wav");
  EXPECT_EQ(w.sample_rate_hz, 8000);
  ASSERT_EQ(w.samples.size(), samples.size());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(w.samples[i], samples[i], 1.0 / 32768);
  EXPECT_NEAR(w.samples[3], 1, 1e-4);
  EXPECT_NEAR(w.samples[4], -1, 1e-4);
  EXPECT_THROW(read_wav(folder / "none.wav"), IoError);
}

TEST(Wav, SurvivesEveryMutation) {
  const Bytes whole = wav(kPcm, 1, 16, Bytes(64, 17));
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    Bytes broken = whole;
    for (std::uint64_t k = 0; k <= random.below(4); ++k) {
      broken[random.below(broken.size())] = static_cast<std::uint8_t>(random.below(256));
    }
    if (random.below(3) == 0) broken.resize(random.below(broken.size() + 1));
    try {
      const Wav w = parse_wav(broken, "x");
      EXPECT_LE(w.samples.size(), broken.size());
      for (const float x : w.samples) ASSERT_TRUE(std::isfinite(x));
    } catch (const FormatError&) {
    }
  }
}

}  // namespace
}  // namespace hri
