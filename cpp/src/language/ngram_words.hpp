// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a word of a language model may be.
#pragma once

#include <string>

namespace hri::detail {

/// nullptr, or what is wrong with a word: it is empty, has white space in it or is not UTF-8.
const char* word_fault(const std::string& word);

}  // namespace hri::detail
