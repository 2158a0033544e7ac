// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's pronunciation dictionaries (HTK Book, section 12.7).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hri/core/export.hpp"

namespace hri::htk {

struct Pronunciation {
  std::string word;
  bool has_output = false;  ///< else the word itself is printed
  std::string output;       ///< what is printed for it; "": nothing
  double probability = 1;
  std::vector<std::string> models;
  std::int64_t line = 0;  ///< of the file that it was read from, from 1; 0: of none
  std::string text;       ///< that line; it is written again while it says the same
};

/// Pronunciations in the order of the file.
struct HRI_API Dictionary {
  std::vector<Pronunciation> entries;

  /// Lines of word [output] probability models; output and probability may be missing. Throws
  /// IoError, and FormatError naming file and line for lines of another form, probabilities outside
  /// 0..1, and pronunciations without models.
  static Dictionary read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static Dictionary parse(const std::string& text, const std::string& name);

  /// Throws InvalidArgument for what parse() would refuse.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;

  /// Numbers of the entries of every word.
  [[nodiscard]] std::map<std::string, std::vector<int>> by_word() const;
};

}  // namespace hri::htk
