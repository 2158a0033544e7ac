// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the wire format of protocol buffers, as far as ONNX files need it: fields by number,
// without a schema.
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/types.hpp"

namespace hri::detail {

/// A field of a message: `number`, and by its wire type a value or bytes.
struct ProtobufField {
  std::uint32_t number = 0;
  bool has_bytes = false;   ///< text, bytes, message or packed numbers
  std::uint64_t value = 0;  ///< otherwise: varint, or a fixed number's bits
  Span<const std::uint8_t> bytes;

  [[nodiscard]] std::string text() const {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
};

/// The fields of a message in their order. `name` is what errors call the file. The bytes must
/// outlive it.
class ProtobufReader {
 public:
  ProtobufReader(Span<const std::uint8_t> bytes, const std::string& name)
      : bytes_(bytes), name_(&name) {}

  /// The next field; false behind the last. Throws FormatError for bytes that are no message.
  bool next(ProtobufField* field);

  /// The next varint, for packed numbers; false behind the last.
  bool next_varint(std::uint64_t* value);

 private:
  std::uint64_t varint();
  Span<const std::uint8_t> take(std::uint64_t count);
  [[noreturn]] void fail_cut() const;

  Span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  const std::string* name_;
};

}  // namespace hri::detail
