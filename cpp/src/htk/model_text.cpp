// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/model_text.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk::detail {
namespace {

constexpr const char* kSpaces = " \t\r\n";

bool is_space(char c) { return std::string(kSpaces).find(c) != std::string::npos; }

constexpr double kScaleOfLogs = -2371.8;
constexpr int kScaledLogOfZero = 32767;

}  // namespace

int to_scaled_log(double probability) {
  if (!(probability > 0)) return kScaledLogOfZero;
  const double value = std::round(kScaleOfLogs * std::log(std::min(probability, 1.0)));
  return static_cast<int>(std::min(value, double{kScaledLogOfZero}));
}

double from_scaled_log(int value) {
  return value == kScaledLogOfZero ? 0 : std::exp(value / kScaleOfLogs);
}

void ModelTokens::refuse_at(std::int64_t line, const std::string& why) const {
  fail(ErrorKind::format, name_ + ": line " + std::to_string(line) + ": " + why);
}

void ModelTokens::skip_blanks() {
  while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
}

void ModelTokens::advance() {
  skip_blanks();
  taken_line_ = token_line_;
  token_line_ = line_;
  now_ = ModelToken();
  if (at_ >= text_.size()) return;
  const char c = text_[at_];
  if (c == '<') {
    const std::size_t end = text_.find('>', at_);
    if (end == std::string::npos || end - at_ > 64) refuse("a keyword does not end with >");
    now_ = {ModelToken::Kind::keyword, text_.substr(at_ + 1, end - at_ - 1)};
    for (char& k : now_.text) k = k >= 'a' && k <= 'z' ? static_cast<char>(k - 'a' + 'A') : k;
    at_ = end + 1;
  } else if (c == '~' && at_ + 1 < text_.size()) {
    now_ = {ModelToken::Kind::macro, std::string(1, text_[at_ + 1])};
    at_ += 2;
  } else if (c == '"' || c == '\'') {
    read_quoted();
  } else if (c == ':') {
    refuse("binary definitions are not read; HHEd writes them as text");
  } else {
    std::size_t end = at_;
    while (end < text_.size() && !is_space(text_[end]) && text_[end] != '<') ++end;
    now_ = {ModelToken::Kind::word, text_.substr(at_, end - at_)};
    at_ = end;
  }
}

void ModelTokens::read_quoted() {
  const std::size_t line_end = std::min(text_.find('\n', at_), text_.size());
  std::size_t end = at_ + 1;
  while (end < line_end && text_[end] != text_[at_]) end += text_[end] == '\\' ? 2 : 1;
  std::vector<std::string> fields;
  if (end >= line_end) refuse("a quotation does not end");
  if (const char* fault = split_fields(text_.substr(at_, end + 1 - at_), &fields); fault != nullptr)
    refuse(fault);
  if (fields.size() != 1) refuse("a quotation does not end");
  now_ = {ModelToken::Kind::name, fields.front()};
  at_ = end + 1;
}

bool ModelTokens::skip(const char* keyword) {
  if (!is(keyword)) return false;
  advance();
  return true;
}

void ModelTokens::expect(const char* keyword) {
  if (!skip(keyword)) refuse(std::string("expected <") + keyword + ">");
}

std::string ModelTokens::take_name() {
  const bool named = now_.kind == ModelToken::Kind::name || now_.kind == ModelToken::Kind::word;
  if (!named || now_.text.empty()) refuse("expected a name");
  const std::string name = now_.text;
  advance();
  return name;
}

double ModelTokens::take_number() {
  double value = 0;
  if (now_.kind != ModelToken::Kind::word || !parse_number(now_.text, &value) ||
      std::fabs(value) > 1e30)
    refuse("expected a number");
  advance();
  return value;
}

int ModelTokens::take_whole(int low, int high) {
  const std::string text = now_.text;
  double value = 0;
  if (now_.kind != ModelToken::Kind::word || !parse_number(text, &value) ||
      value != std::floor(value) || value < low || value > high)
    refuse("expected a whole number in " + std::to_string(low) + ".." + std::to_string(high));
  advance();
  return static_cast<int>(value);
}

}  // namespace hri::htk::detail
