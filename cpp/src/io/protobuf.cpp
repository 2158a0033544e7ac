// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "io/protobuf.hpp"

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

enum WireType : std::uint32_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

}  // namespace

void ProtobufReader::fail_cut() const {
  fail(ErrorKind::format, *name_ + ": is cut, or no ONNX file");
}

std::uint64_t ProtobufReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    if (at_ == bytes_.size()) fail_cut();
    const std::uint8_t byte = bytes_[at_++];
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  fail_cut();
}

Span<const std::uint8_t> ProtobufReader::take(std::uint64_t count) {
  if (count > bytes_.size() - at_) fail_cut();
  const Span<const std::uint8_t> taken{bytes_.data() + at_, static_cast<std::size_t>(count)};
  at_ += taken.size();
  return taken;
}

bool ProtobufReader::next(ProtobufField* field) {
  if (at_ == bytes_.size()) return false;
  const std::uint64_t key = varint();
  *field = {};
  field->number = static_cast<std::uint32_t>(key >> 3U);
  switch (key & 7U) {
    case kVarint:
      field->value = varint();
      break;
    case kBytes:
      field->has_bytes = true;
      field->bytes = take(varint());
      break;
    case kFixed32:
    case kFixed64: {
      const auto raw = take((key & 7U) == kFixed32 ? 4 : 8);
      for (std::size_t i = 0; i < raw.size(); ++i)
        field->value |= static_cast<std::uint64_t>(raw[i]) << (8 * i);
      break;
    }
    default:
      fail_cut();
  }
  return true;
}

bool ProtobufReader::next_varint(std::uint64_t* value) {
  if (at_ == bytes_.size()) return false;
  *value = varint();
  return true;
}

}  // namespace hri::detail
