// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/ngram_words.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hri::detail {

const char* word_fault(const std::string& word) {
  if (word.empty()) return "is empty";
  if (word.find_first_of(std::string(" \t\r\n\v\f\0", 7)) != std::string::npos)
    return "has white space in it";
  return label_fault(word);
}

const char* label_fault(const std::string& label) {
  if (label.empty()) return "is empty";
  const nlohmann::json text(label);
  const std::string kept = text.dump(-1, ' ', false, nlohmann::json::error_handler_t::ignore);
  const std::string read = nlohmann::json::parse(kept, nullptr, false).get<std::string>();
  return read == label ? nullptr : "is not UTF-8";
}

std::int64_t bad_line(const std::string& text) {
  std::int64_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++number;
    const auto is_ascii = [](char c) { return c > 0 && static_cast<unsigned char>(c) < 128; };
    const auto first = text.begin() + static_cast<std::ptrdiff_t>(at);
    const auto last = text.begin() + static_cast<std::ptrdiff_t>(end);
    if (!std::all_of(first, last, is_ascii)) {
      std::string visible(first, last);
      for (const char blank : {' ', '\t', '\r', '\v', '\f'})
        std::replace(visible.begin(), visible.end(), blank, '_');
      if (word_fault(visible) != nullptr) return number;
    }
    at = end + 1;
  }
  return 0;
}

}  // namespace hri::detail
