// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON of model files, read value by value: anything but the few forms that have a place there
// is refused where it stands, so that what is read takes no more memory than the text itself,
// however deep or wide it claims to be.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t{1} << 24U;

struct TensorEntry {
  bool is_double = false;
  std::uint64_t rows = 0;
  std::uint64_t cols = 0;
  std::uint64_t begin = 0;  // of its bytes in the data
  std::uint64_t end = 0;
};

struct ModelHeader {
  std::map<std::string, std::string> metadata;
  std::map<std::string, TensorEntry> tensors;
};

// Throws FormatError that names the file and the field; no key may stand twice.
ModelHeader read_model_header(Span<const std::uint8_t> text, const std::string& name);

// A JSON list of strings; none for anything else.
std::optional<std::vector<std::string>> read_text_list(const std::string& text);

}  // namespace hri::detail
