// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/ngram_words.hpp"

#include <nlohmann/json.hpp>

namespace hri::detail {

const char* word_fault(const std::string& word) {
  if (word.empty()) return "is empty";
  if (word.find_first_of(std::string(" \t\r\n\v\f\0", 7)) != std::string::npos)
    return "has white space in it";
  const nlohmann::json text(word);
  const std::string kept = text.dump(-1, ' ', false, nlohmann::json::error_handler_t::ignore);
  const std::string read = nlohmann::json::parse(kept, nullptr, false).get<std::string>();
  return read == word ? nullptr : "is not UTF-8";
}

}  // namespace hri::detail
