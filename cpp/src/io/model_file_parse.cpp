// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The strict reader of model files: nothing is believed before it is checked against the bytes that
// are there.
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "hri/core/error.hpp"
#include "hri/io/model_file.hpp"

namespace hri {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t{1} << 26U;
constexpr std::uint64_t kMaxSide = std::uint64_t{1} << 28U;

[[noreturn]] void reject(const std::string& name, const std::string& why) {
  fail(ErrorKind::format, name + ": " + why);
}

// The header as JSON, with no key given twice at any depth.
json parse_header(Span<const std::uint8_t> text, const std::string& name) {
  std::vector<std::set<std::string>> open;
  std::string repeated;
  const auto callback = [&](int /*depth*/, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second) {
      repeated = value.get<std::string>();
    }
    return true;
  };
  json header = json::parse(text.begin(), text.end(), callback, false);
  if (header.is_discarded() || !header.is_object()) reject(name, "header is not a JSON object");
  if (!repeated.empty()) reject(name, "header field '" + repeated + "' stands twice");
  return header;
}

std::uint64_t unsigned_at(const json& list, std::size_t i, const std::string& name,
                          const std::string& field) {
  if (!list.is_array() || list.size() != 2 || !list[i].is_number_unsigned()) {
    reject(name, "field '" + field + "' must be two whole numbers");
  }
  return list[i].get<std::uint64_t>();
}

}  // namespace

ModelFile ModelFile::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < 8)
    reject(name, "too short for a model file: " + std::to_string(bytes.size()) + " bytes");
  std::uint64_t header_size = 0;
  for (unsigned i = 0; i < 8; ++i) header_size |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  if (header_size > kMaxHeaderBytes || header_size > bytes.size() - 8) {
    reject(name, "header length " + std::to_string(header_size) + " exceeds the file");
  }
  const json header = parse_header(bytes.subspan(8, static_cast<std::size_t>(header_size)), name);
  const auto data = bytes.subspan(8 + static_cast<std::size_t>(header_size),
                                  bytes.size() - 8 - static_cast<std::size_t>(header_size));

  ModelFile file;
  file.name_ = name;
  const auto metadata = header.find("__metadata__");
  if (metadata == header.end() || !metadata->is_object())
    reject(name, "field '__metadata__' is missing");
  for (const auto& [key, value] : metadata->items()) {
    if (!value.is_string()) reject(name, "metadata field '" + key + "' is not a text");
    file.metadata_[key] = value.get<std::string>();
  }
  const std::int64_t version = file.integer("format_version");
  if (version < 1 || version > kFormatVersion) {
    reject(name, "format version " + std::to_string(version) + "; this library reads up to " +
                     std::to_string(kFormatVersion));
  }

  file.version_ = static_cast<int>(version);

  std::map<std::uint64_t, std::uint64_t> ranges;
  for (const auto& [key, value] : header.items()) {
    if (key == "__metadata__") continue;
    if (!value.is_object() || value.size() != 3 || !value.contains("dtype") ||
        !value.contains("shape") || !value.contains("data_offsets")) {
      reject(name, "tensor '" + key + "' needs dtype, shape and data_offsets, and nothing else");
    }
    Tensor t;
    if (value["dtype"] != "F32" && value["dtype"] != "F64")
      reject(name, "tensor '" + key + "': dtype must be F32 or F64");
    t.is_double = value["dtype"] == "F64";
    const std::uint64_t rows = unsigned_at(value["shape"], 0, name, key + ".shape");
    const std::uint64_t cols = unsigned_at(value["shape"], 1, name, key + ".shape");
    const std::uint64_t begin = unsigned_at(value["data_offsets"], 0, name, key + ".data_offsets");
    const std::uint64_t end = unsigned_at(value["data_offsets"], 1, name, key + ".data_offsets");
    // Sides below 2^28 and 8 bytes a value keep the product within 64 bits.
    if (rows > kMaxSide || cols > kMaxSide || begin > end || end > data.size() ||
        rows * cols * (t.is_double ? 8U : 4U) != end - begin) {
      reject(name,
             "tensor '" + key + "': shape and data_offsets do not fit each other or the file");
    }
    t.rows = static_cast<std::int64_t>(rows);
    t.cols = static_cast<std::int64_t>(cols);
    t.bytes.assign(data.begin() + begin, data.begin() + end);
    if (end > begin && !ranges.emplace(begin, end).second)
      reject(name, "tensor '" + key + "' overlaps another");
    file.tensors_[key] = std::move(t);
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
