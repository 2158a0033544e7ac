// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "language/ngram_words.hpp"

namespace hri::htk::detail {
namespace {

bool is_octal(const std::string& text, std::size_t at) {
  if (at + 3 > text.size()) return false;
  return std::all_of(text.begin() + static_cast<std::ptrdiff_t>(at),
                     text.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                     [](char c) { return c >= '0' && c <= '7'; });
}

// The character behind a backslash at `*at`, which moves on.
char escaped(const std::string& line, std::size_t* at) {
  if (is_octal(line, *at + 1)) {
    int code = 0;
    for (int i = 0; i < 3; ++i) code = code * 8 + (line[++*at] - '0');
    ++*at;
    return static_cast<char>(code & 0xff);
  }
  ++*at;
  return line[(*at)++];
}

// What a backslash and octal digits say can be anything.
bool is_one_line(const std::string& name) {
  return name.find_first_of(std::string("\r\n\0", 3)) == std::string::npos &&
         hri::detail::bad_line(name) == 0;
}

template <class T>
std::string shortest_text(T value, int digits) {
  for (; digits < 18; ++digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << value;
    double read = 0;
    if (parse_number(out.str(), &read) && static_cast<T>(read) == value) return out.str();
  }
  return "0";  // not reached: 17 digits are enough
}

}  // namespace

bool TextLines::next() {
  if (at_ >= text_.size()) {
    line_.clear();
    return false;
  }
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line_ = text_.substr(at_, end - at_);
  at_ = end + 1;
  ++number_;
  const std::size_t first = line_.find_first_not_of(kBlanks);
  if (first == std::string::npos) {
    line_.clear();
  } else {
    line_ = line_.substr(first, line_.find_last_not_of(kBlanks) + 1 - first);
  }
  return true;
}

std::vector<std::string> TextLines::fields() const {
  std::vector<std::string> result;
  if (const char* fault = split_fields(line_, &result); fault != nullptr) refuse(fault);
  return result;
}

void TextLines::refuse(const std::string& why) const {
  fail(ErrorKind::format,
       name_ + ": line " + std::to_string(std::max(number_, std::int64_t{1})) + ": " + why);
}

double TextLines::number_of(const std::string& field, double largest) const {
  double value = 0;
  if (!parse_number(field, &value) || std::fabs(value) > largest)
    refuse("'" + field + "' is no number that can stand here");
  return value;
}

std::int64_t TextLines::whole_of(const std::string& field, std::int64_t low,
                                 std::int64_t high) const {
  const double value = number_of(field, 9e15);
  if (value != std::floor(value) || value < static_cast<double>(low) ||
      value > static_cast<double>(high))
    refuse("'" + field + "' is no whole number in " + std::to_string(low) + ".." +
           std::to_string(high));
  return static_cast<std::int64_t>(value);
}

const char* split_fields(const std::string& line, std::vector<std::string>* fields,
                         std::vector<bool>* marked) {
  fields->clear();
  if (marked != nullptr) marked->clear();
  std::size_t at = line.find_first_not_of(kBlanks);
  while (at < line.size()) {
    std::string field;
    const char quote = line[at] == '"' || line[at] == '\'' ? line[at] : '\0';
    if (quote != '\0') ++at;
    bool ended = quote == '\0';
    while (at < line.size()) {
      const char c = line[at];
      if (c == '\\' && at + 1 < line.size()) {
        field += escaped(line, &at);
        continue;
      }
      ++at;
      if (quote != '\0' ? c == quote : std::string(kBlanks).find(c) != std::string::npos) {
        ended = true;
        break;
      }
      field += c;
    }
    if (!ended) return "a quotation does not end";
    if (!is_one_line(field)) return "a name is not UTF-8 text of one line";
    fields->push_back(std::move(field));
    if (marked != nullptr) marked->push_back(quote != '\0');
    at = std::min(line.find_first_not_of(kBlanks, at), line.size());
  }
  return nullptr;
}

std::string in_quotes(const std::string& name) {
  std::string result = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string quoted(const std::string& name) {
  const bool plain = !name.empty() && name.find_first_of(" \t\"'\\") == std::string::npos;
  return plain ? name : in_quotes(name);
}

bool parse_number(const std::string& text, double* value) {
  // Streams would also take white space in front, and hexadecimal digits.
  if (text.empty() || text.size() > 64 ||
      text.find_first_not_of("0123456789.+-eE") != std::string::npos)
    return false;
  std::istringstream in(text);
  in.imbue(std::locale::classic());  // a program may have set a locale with decimal commas
  return (in >> *value) && in.peek() == std::istringstream::traits_type::eof() &&
         std::isfinite(*value);
}

std::string shortest(double value) { return shortest_text(value, 6); }
std::string shortest(float value) { return shortest_text(value, 6); }

void require_name(const std::string& name, const std::string& what) {
  std::string visible = name;
  std::replace(visible.begin(), visible.end(), ' ', '_');
  std::replace(visible.begin(), visible.end(), '\t', '_');
  if (const char* fault = hri::detail::word_fault(visible); fault != nullptr)
    fail(ErrorKind::invalid_argument, what + " '" + name + "' " + fault);
}

void require_text(const std::string& text, const std::string& name) {
  if (const std::int64_t line = hri::detail::bad_line(text); line != 0)
    fail(ErrorKind::format, name + ": line " + std::to_string(line) + ": is not UTF-8 text");
}

std::string read_text(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  std::string text(bytes.begin(), bytes.end());
  require_text(text, path);
  return text;
}

void write_text(const std::string& path, const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  write_file_atomically(path, bytes);
}

}  // namespace hri::htk::detail
