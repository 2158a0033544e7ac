// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The strict reader of model files: nothing is believed before it is checked against the bytes that
// are there.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/io/model_file.hpp"
#include "io/model_header.hpp"

namespace hri {
namespace {

constexpr std::uint64_t kMaxSide = std::uint64_t{1} << 28U;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 62U;

[[noreturn]] void reject(const std::string& name, const std::string& why) {
  fail(ErrorKind::format, name + ": " + why);
}

// A file whose first bytes say that there is more of it than there is.
[[noreturn]] void reject_cut(const std::string& name, std::uint64_t size, std::uint64_t needed,
                             bool at_least) {
  reject(name, "is cut: " + std::to_string(size) + " of " + (at_least ? "at least " : "") +
                   std::to_string(needed) + " bytes are there");
}

// Whether a header may begin with this byte: JSON has blanks before an object.
bool begins_object(std::uint8_t byte) {
  return byte == '{' || byte == ' ' || byte == '\t' || byte == '\n' || byte == '\r';
}

// Whether the sides of a tensor fit the bytes that it says are its own.
bool fits_itself(const detail::TensorEntry& entry) {
  // Sides below 2^28 and 8 bytes a value keep the product within 64 bits.
  return entry.rows <= kMaxSide && entry.cols <= kMaxSide && entry.begin <= entry.end &&
         entry.rows * entry.cols * (entry.is_double ? 8U : 4U) == entry.end - entry.begin;
}

// How many bytes behind the header tensors have that contradict nothing.
std::uint64_t data_needed(const detail::ModelHeader& header) {
  std::uint64_t needed = 0;
  for (const auto& [key, entry] : header.tensors)
    if (fits_itself(entry)) needed = std::max(needed, entry.end);
  return needed;
}

}  // namespace

ModelFile ModelFile::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < 8)
    reject(name, "too short for a model file: " + std::to_string(bytes.size()) + " bytes");
  std::uint64_t header_size = 0;
  for (unsigned i = 0; i < 8; ++i) header_size |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  // Any other file gives a length of its own, as a text one of 18 digits.
  if (header_size == 0 || header_size > detail::kMaxHeaderBytes ||
      (bytes.size() > 8 && !begins_object(bytes[8])))
    reject(name, "is no model file of hri: it does not begin with the length of a JSON object");
  if (header_size > bytes.size() - 8) reject_cut(name, bytes.size(), 8 + header_size, true);
  detail::ModelHeader header =
      detail::read_model_header(bytes.subspan(8, static_cast<std::size_t>(header_size)), name);
  const auto data = bytes.subspan(8 + static_cast<std::size_t>(header_size),
                                  bytes.size() - 8 - static_cast<std::size_t>(header_size));

  ModelFile file;
  file.name_ = name;
  file.metadata_ = std::move(header.metadata);
  const std::int64_t version = file.integer("format_version");
  if (version < 1 || version > kFormatVersion) {
    reject(name, "format version " + std::to_string(version) + "; this library reads up to " +
                     std::to_string(kFormatVersion));
  }
  file.version_ = static_cast<int>(version);

  const std::uint64_t needed = data_needed(header);
  // Beyond that the sum could not be printed, and no file has so many.
  if (needed > data.size() && needed < kMaxBytes)
    reject_cut(name, bytes.size(), 8 + header_size + needed, false);

  std::map<std::uint64_t, std::uint64_t> ranges;
  for (const auto& [key, entry] : header.tensors) {
    if (!fits_itself(entry) || entry.end > data.size()) {
      reject(name,
             "tensor '" + key + "': shape and data_offsets do not fit each other or the file");
    }
    Tensor t;
    t.is_double = entry.is_double;
    t.rows = static_cast<std::int64_t>(entry.rows);
    t.cols = static_cast<std::int64_t>(entry.cols);
    t.bytes.assign(data.begin() + entry.begin, data.begin() + entry.end);
    if (entry.end > entry.begin && !ranges.emplace(entry.begin, entry.end).second)
      reject(name, "tensor '" + key + "' overlaps another");
    file.tensors_.emplace(key, std::move(t));
  }
  std::uint64_t covered = 0;
  for (const auto& [begin, end] : ranges) {
    if (begin != covered)
      reject(name, "tensor data have a gap or overlap at byte " + std::to_string(covered));
    covered = end;
  }
  if (covered != data.size())
    reject(name, "has " + std::to_string(data.size() - covered) + " bytes beyond its tensors");

  const std::string stored = file.text("checksum");
  char computed[9];
  std::snprintf(computed, sizeof computed, "%08x", static_cast<unsigned>(file.checksum()));
  if (stored != computed)
    reject(name, "checksum is " + stored + " but the content gives " + computed + ": damaged");
  return file;
}

}  // namespace hri
