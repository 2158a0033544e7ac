// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Model files for the fuzzer: changes of what they say rather than of bytes, and a checksum that
// fits afterwards, so that what lies behind the checksum is reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "hri/io/crc32.hpp"

namespace hri::fuzzing {

class ModelBytes {
 public:
  /// Nothing where the header is no JSON object with metadata.
  static std::optional<ModelBytes> parse(const std::uint8_t* data, std::size_t size) {
    if (size < 8) return std::nullopt;
    std::uint64_t length = 0;
    std::memcpy(&length, data, 8);
    if (length > size - 8) return std::nullopt;
    ModelBytes file;
    file.header_ = nlohmann::json::parse(data + 8, data + 8 + length, nullptr, false);
    if (!file.header_.is_object() || !file.header_["__metadata__"].is_object()) return std::nullopt;
    file.tensors_.assign(data + 8 + length, data + size);
    return file;
  }

  /// One change of a number, a text, a shape or a name.
  void change(std::mt19937& random) {
    auto& metadata = header_["__metadata__"];
    switch (random() % 8) {
      case 0:
      case 1:
      case 2:
        if (auto* value = any(metadata, random)) *value = a_text(random);
        break;
      case 3:
      case 4:
      case 5:
        change_values(random);
        break;
      case 6:
        if (auto* tensor = any(header_, random); tensor != nullptr && tensor->contains("shape")) {
          auto& shape = (*tensor)["shape"];
          if (shape.is_array() && shape.size() == 2) {
            const int kind = static_cast<int>(random() % 3);
            if (kind == 0) std::swap(shape[0], shape[1]);
            if (kind == 1) shape[random() % 2] = random() % 5;
            if (kind == 2) shape[random() % 2] = std::uint64_t{1} << (random() % 40);
          }
        }
        break;
      default: {
        auto& object = random() % 2 == 0 ? metadata : header_;
        if (object.empty()) break;
        auto at = object.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(random() % object.size()));
        if (at.key() == "__metadata__" || at.key() == "kind") break;
        if (random() % 2 == 0) object["other." + at.key()] = at.value();
        object.erase(at.key());
      }
    }
  }

  /// With the checksum that fits.
  [[nodiscard]] std::vector<std::uint8_t> serialise() {
    header_["__metadata__"]["checksum"] = checksum();
    std::string text = header_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.append((8 - text.size() % 8) % 8, ' ');
    std::vector<std::uint8_t> out(8);
    const std::uint64_t length = text.size();
    std::memcpy(out.data(), &length, 8);
    out.insert(out.end(), text.begin(), text.end());
    out.insert(out.end(), tensors_.begin(), tensors_.end());
    return out;
  }

 private:
  static nlohmann::json* any(nlohmann::json& object, std::mt19937& random) {
    if (object.empty()) return nullptr;
    auto at = object.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(random() % object.size()));
    return at.key() == "__metadata__" || at.key() == "kind" ? nullptr : &at.value();
  }

  static std::string a_text(std::mt19937& random) {
    static const char* const kTexts[] = {
        "0",     "1",      "-1",      "2",          "3",
        "64",    "65537",  "1000000", "2147483648", "-9223372036854775808",
        "1e308", "-1e308", "1e30",    "1e-308",     "0.5",
        "nan",   "inf",    "",        "x",          "automatic",
        "hmm",   "ptbhmm", "[]",      "[\"a\"]",    "[\"a\",\"a\",\"b\"]",
        "{}",    "haar",   "db38",    "mfcc",       "true"};
    if (random() % 4 != 0) return kTexts[random() % std::size(kTexts)];
    return std::to_string(static_cast<std::int32_t>(random()) >> (random() % 31));
  }

  void change_values(std::mt19937& random) {
    if (tensors_.size() < 8) return;
    static const double kNumbers[] = {0,     -1,   1,    1e-300, 1e-38, 1e15,
                                      -1e15, 9e14, 1e30, -1e30,  1e300, 0.5};
    const double value = kNumbers[random() % std::size(kNumbers)];
    const std::size_t count = std::size_t{1} << (random() % 6);
    const bool wide = random() % 2 == 0;
    std::size_t at = random() % (tensors_.size() / 8) * 8;
    for (std::size_t i = 0; i < count && at + 8 <= tensors_.size(); ++i) {
      if (wide) {
        std::memcpy(&tensors_[at], &value, 8);
        at += 8;
      } else {
        const auto narrow = static_cast<float>(value);
        std::memcpy(&tensors_[at], &narrow, 4);
        at += 4;
      }
    }
  }

  // As ModelFile computes it: names and values end in a zero byte.
  std::string checksum() {
    std::uint32_t crc = 0;
    const auto add = [&crc](const std::string& s) {
      crc = crc32({reinterpret_cast<const std::uint8_t*>(s.c_str()), s.size() + 1}, crc);
    };
    for (const auto& [name, tensor] : header_.items()) {
      if (name == "__metadata__") continue;
      const auto& offsets = tensor.is_object() && tensor.contains("data_offsets")
                                ? tensor["data_offsets"]
                                : nlohmann::json();
      if (!offsets.is_array() || offsets.size() != 2 || !offsets[0].is_number_unsigned() ||
          !offsets[1].is_number_unsigned() || !tensor.contains("shape") ||
          !tensor["shape"].is_array() || tensor["shape"].size() != 2)
        continue;
      const auto begin = offsets[0].get<std::size_t>();
      const auto end = offsets[1].get<std::size_t>();
      if (begin > end || end > tensors_.size()) continue;
      add(name);
      add(tensor.value("dtype", nlohmann::json()) == "F64" ? "F64" : "F32");
      add(tensor["shape"][0].dump() + " " + tensor["shape"][1].dump());
      crc = crc32({tensors_.data() + begin, end - begin}, crc);
    }
    for (const auto& [key, value] : header_["__metadata__"].items()) {
      if (key == "checksum" || !value.is_string()) continue;
      add(key);
      add(value.get<std::string>());
    }
    char text[9];
    std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(crc));
    return text;
  }

  nlohmann::json header_;
  std::vector<std::uint8_t> tensors_;
};

}  // namespace hri::fuzzing
