// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a word of a language model may be.
#pragma once

#include <cstdint>
#include <string>

namespace hri::detail {

/// nullptr, or what is wrong with a word: it is empty, has white space in it or is not UTF-8.
const char* word_fault(const std::string& word);

/// The same of a label of a recogniser, which may have white space in it.
const char* label_fault(const std::string& label);

/// The number of the first line of a text, from 1, that is not UTF-8 or has a NUL; 0: none is.
std::int64_t bad_line(const std::string& text);

}  // namespace hri::detail
