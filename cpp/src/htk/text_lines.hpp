// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Lines and fields of HTK's text files, and errors that name file and line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hri::htk::detail {

constexpr const char* kBlanks = " \t\r";

/// Text line by line. `text` and `name` outlive it.
class TextLines {
 public:
  TextLines(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  /// The next line, without blanks at its ends; false after the last.
  bool next();
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] std::int64_t number() const { return number_; }
  /// The fields of the line; see split_fields().
  [[nodiscard]] std::vector<std::string> fields() const;

  [[noreturn]] void refuse(const std::string& why) const;

  /// The finite number that a field is, within -largest..largest.
  [[nodiscard]] double number_of(const std::string& field, double largest = 1e30) const;
  /// The whole number that a field is, within low..high.
  [[nodiscard]] std::int64_t whole_of(const std::string& field, std::int64_t low,
                                      std::int64_t high) const;

 private:
  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t number_ = 0;
  std::string line_;
};

/// Fields between blanks; one may stand in "" or '', and a backslash takes the next character, or
/// three octal digits, as it is. Gives nullptr, or what is wrong: a quotation does not end, or a
/// field is not UTF-8 text of one line. `marked`, if wanted: which fields stood in quotation marks.
const char* split_fields(const std::string& line, std::vector<std::string>* fields,
                         std::vector<bool>* marked = nullptr);

/// A name in quotation marks, as split_fields() reads it.
std::string in_quotes(const std::string& name);
/// The same where it needs them: not for a name without blanks, marks and backslashes.
std::string quoted(const std::string& name);

/// Whether `text` is a finite decimal number, whatever the locale.
bool parse_number(const std::string& text, double* value);

/// A number in as few digits as read back equal, of double or of float.
std::string shortest(double value);
std::string shortest(float value);

/// Throws InvalidArgument where `name` is empty, not UTF-8 or has characters that end a line.
void require_name(const std::string& name, const std::string& what);

/// The text of a file, which must be UTF-8 without NUL: FormatError else, as IoError.
std::string read_text(const std::string& path);
/// FormatError where `text` is no UTF-8 or has a NUL; names the line.
void require_text(const std::string& text, const std::string& name);

void write_text(const std::string& path, const std::string& text);

}  // namespace hri::htk::detail
