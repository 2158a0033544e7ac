// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/video_container.hpp"

#include <fstream>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes bytes_of(const std::string& s) { return {s.begin(), s.end()}; }

Bytes little(std::uint32_t v) {
  return {static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(v >> 8U),
          static_cast<std::uint8_t>(v >> 16U), static_cast<std::uint8_t>(v >> 24U)};
}

Bytes big(std::uint32_t v) {
  const Bytes b = little(v);
  return {b[3], b[2], b[1], b[0]};
}

Bytes avi(std::uint32_t size) {
  return bytes_of("RIFF") + little(size) + bytes_of("AVI ") + Bytes(96);
}
Bytes box(const char* type, std::uint32_t size) { return big(size) + bytes_of(type) + Bytes(92); }

// An EBML header of 3 bytes, and a segment of 100 bytes that says to have `size`.
Bytes matroska(const Bytes& size) {
  return Bytes{0x1A, 0x45, 0xDF, 0xA3, 0x83, 1, 2, 3, 0x18, 0x53, 0x80, 0x67} + size + Bytes(100);
}

// "" for a file taken as whole, else the message.
std::string verdict(const TestFolder& folder, const Bytes& content) {
  std::filesystem::remove(folder / "clip");  // to be cut and written anew takes some systems long
  std::ofstream(folder / "clip", std::ios::binary)
      .write(reinterpret_cast<const char*>(content.data()),
             static_cast<std::streamsize>(content.size()));
  try {
    require_whole_video(folder / "clip");
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

TEST(VideoContainer, IsWholeWhenItIsAsLongAsItSays) {
  const TestFolder folder;
  EXPECT_EQ(verdict(folder, avi(100)), "");
  EXPECT_EQ(verdict(folder, avi(100) + avi(100)), "");
  EXPECT_EQ(verdict(folder, avi(108)), "") << "as programs write that count the head";
  EXPECT_EQ(verdict(folder, avi(0)), "") << "never filled in";
  EXPECT_EQ(verdict(folder, box("ftyp", 100) + box("mdat", 100)), "");
  EXPECT_EQ(verdict(folder, box("ftyp", 100) + box("mdat", 0)), "") << "to the end";
  EXPECT_EQ(
      verdict(folder, box("ftyp", 100) + big(1) + bytes_of("mdat") + big(0) + big(50) + Bytes(34)),
      "");
  EXPECT_EQ(verdict(folder, matroska({0xE4})), "");
  EXPECT_EQ(verdict(folder, matroska({0xFF})), "") << "a stream";
  EXPECT_EQ(verdict(folder, matroska({0x01, 255, 255, 255, 255, 255, 255, 255})), "") << "a stream";
}

TEST(VideoContainer, OfNoKnownKindIsRefused) {
  const TestFolder folder;
  for (const Bytes& content : {bytes_of("ffconcat version 1.0\nfile other.mp4\n"), Bytes{}}) {
    const std::string message = verdict(folder, content);
    EXPECT_NE(message.find("clip: not a video that OpenCV reads"), std::string::npos) << message;
  }
}

TEST(VideoContainer, ThatWasCutSaysByHowMuch) {
  const TestFolder folder;
  EXPECT_NE(verdict(folder, avi(200)).find("108 of 208 bytes are there"), std::string::npos);
  EXPECT_NE(verdict(folder, avi(100) + avi(300)), "");
  EXPECT_NE(verdict(folder, box("ftyp", 100) + box("mdat", 101)).find("200 of 201 "),
            std::string::npos);
  EXPECT_NE(
      verdict(folder, box("ftyp", 100) + big(1) + bytes_of("mdat") + big(9) + big(9) + Bytes(34)),
      "");
  EXPECT_NE(verdict(folder, box("mdat", 0xFFFFFFFF)), "");
  EXPECT_NE(verdict(folder, big(1) + bytes_of("mdat") + Bytes(8, 0xFF)), "");
  EXPECT_NE(verdict(folder, matroska({0xE5})), "");
  EXPECT_NE(verdict(folder, matroska({0x01, 255, 255, 255, 255, 255, 255, 254})), "");
}

TEST(VideoContainer, OfAnyLengthEndsWell) {
  const TestFolder folder;
  for (const Bytes& whole : {avi(100), box("ftyp", 16) + box("moov", 8), matroska({0x40, 100}),
                             matroska({0}), box("free", 9)}) {
    for (std::size_t length = 0; length <= whole.size(); ++length)
      verdict(folder, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
  }
}

TEST(VideoContainer, WithAnyHeadEndsWell) {
  const TestFolder folder;
  Random random(1);
  const std::vector<Bytes> seeds = {avi(100) + avi(60), box("ftyp", 100) + box("mdat", 60),
                                    matroska({0x40, 100}), matroska({0xFF})};
  for (int i = 0; i < 4000; ++i) {
    Bytes bytes = seeds[static_cast<std::size_t>(i) % seeds.size()];
    for (int change = 0; change < 4; ++change) {
      const auto at =
          static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()));
      bytes[at] = static_cast<std::uint8_t>(random.uniform() * 256.0);
    }
    verdict(folder, bytes);
  }
}

}  // namespace
}  // namespace hri
