// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/video_container.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "hri/core/error.hpp"
#include "io/open_file.hpp"

namespace hri {
namespace {

using detail::OpenFile;

// Some programs count the eight bytes of an AVI's own head too.
constexpr std::uint64_t kRiffSlack = 8;

std::uint64_t little_endian(const std::uint8_t* p, unsigned num_bytes) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < num_bytes; ++i) value |= std::uint64_t{p[i]} << (8 * i);
  return value;
}

std::uint64_t big_endian(const std::uint8_t* p, unsigned num_bytes) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < num_bytes; ++i) value = value << 8U | p[i];
  return value;
}

// The 16 bytes at `offset`, zeros where the file ends.
std::array<std::uint8_t, 16> head_at(const OpenFile& file, std::uint64_t offset) {
  std::array<std::uint8_t, 16> head{};
  file.read_at(offset, {head.data(), head.size()});
  return head;
}

// Each of these gives where the file should end, as far as it says so; 0 if not.

std::uint64_t end_of_avi(const OpenFile& file) {
  std::uint64_t at = 0;
  while (at + 12 <= file.size()) {  // long files hold several RIFFs
    const auto head = head_at(file, at);
    if (std::memcmp(head.data(), "RIFF", 4) != 0) break;
    const std::uint64_t size = little_endian(head.data() + 4, 4);
    if (size == 0 || size == 0xFFFFFFFF) return 0;
    if (size > file.size() - at - 8 + kRiffSlack) return at + 8 + size;
    at += 8 + size + size % 2;
  }
  return 0;
}

std::uint64_t end_of_mp4(const OpenFile& file) {
  std::uint64_t at = 0;
  while (at + 8 <= file.size()) {
    const auto head = head_at(file, at);
    const std::uint64_t size32 = big_endian(head.data(), 4);
    const std::uint64_t size = size32 == 1 ? big_endian(head.data() + 8, 8) : size32;
    if (size < 8) break;  // 0: the last box, to the end
    if (size > file.size() - at) return size > UINT64_MAX - at ? UINT64_MAX : at + size;
    at += size;
  }
  return 0;
}

// The value of a number whose first byte says its length, and that length; 0 for one longer than 8.
std::uint64_t ebml_size(const std::uint8_t* p, unsigned* length) {
  *length = 1;
  while (*length <= 8 && (p[0] & (0x80U >> (*length - 1))) == 0) ++*length;
  if (*length > 8) return 0;
  return big_endian(p, *length) & ((std::uint64_t{1} << (7 * *length)) - 1);
}

std::uint64_t end_of_matroska(const OpenFile& file) {
  unsigned length = 0;
  const std::uint64_t header = ebml_size(head_at(file, 0).data() + 4, &length);
  if (header > file.size()) return 0;
  std::uint64_t at = 4 + length + header;
  const auto head = head_at(file, at);
  if (big_endian(head.data(), 4) != 0x18538067) return 0;  // the segment, which is all the rest
  const std::uint64_t size = ebml_size(head.data() + 4, &length);
  if (length > 8 || size == (std::uint64_t{1} << (7 * length)) - 1) return 0;  // a stream
  at += 4 + length;
  return at > file.size() || size > file.size() - at ? at + size : 0;
}

bool is_mp4(const std::uint8_t* type) {
  for (const char* known : {"ftyp", "moov", "mdat", "free", "skip", "wide", "styp"}) {
    if (std::memcmp(type, known, 4) == 0) return true;
  }
  return false;
}

}  // namespace

void require_whole_video(const std::string& path) {
  const OpenFile file(path);
  const auto head = head_at(file, 0);
  std::uint64_t end = 0;
  if (std::memcmp(head.data(), "RIFF", 4) == 0 && std::memcmp(head.data() + 8, "AVI ", 4) == 0) {
    end = end_of_avi(file);
  } else if (big_endian(head.data(), 4) == 0x1A45DFA3) {
    end = end_of_matroska(file);
  } else if (is_mp4(head.data() + 4)) {
    end = end_of_mp4(file);
  } else {
    // What else OpenCV reads may be a list that names other files.
    fail(ErrorKind::format, path + ": not a video that OpenCV reads: no AVI, MP4 or Matroska");
  }
  if (end != 0) {
    fail(ErrorKind::format, path + ": file ends early: " + std::to_string(file.size()) + " of " +
                                std::to_string(end) + " bytes are there");
  }
}

}  // namespace hri
