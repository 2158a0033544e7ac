// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/labels.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr const char* kHeader = "#!MLF!#";
constexpr const char* kAlternative = "///";
constexpr const char* kEnd = ".";
constexpr double kLargestTime = 9e15;  // whole numbers of double

bool is_number(const std::string& text) {
  double value = 0;
  return detail::parse_number(text, &value);
}

// Fields of one line, taken from the front.
class LabelLine {
 public:
  explicit LabelLine(const detail::TextLines& lines) : lines_(lines) {
    if (!detail::split_fields(lines.line(), &fields_, &marked_))
      lines.refuse("a quotation does not end");
  }

  Label read() {
    Label label;
    // What is left over by the times is the name, even where it is a number.
    if (number_ahead() && fields_.size() > 1) label.first = time();
    if (label.first != Label::kNoTime && number_ahead() && fields_.size() - at_ > 1)
      label.last = time();
    if (label.last != Label::kNoTime && label.last < label.first)
      lines_.refuse("a label ends before it begins");
    label.name = take_name();
    label.has_score = take_score(&label.score);
    while (at_ < fields_.size()) {
      AuxiliaryLabel auxiliary;
      auxiliary.name = take_name();
      auxiliary.has_score = take_score(&auxiliary.score);
      label.auxiliary.push_back(std::move(auxiliary));
    }
    return label;
  }

 private:
  [[nodiscard]] bool number_ahead() const {
    return at_ < fields_.size() && !marked_[at_] && is_number(fields_[at_]);
  }

  std::int64_t time() {
    const double value = lines_.number_of(fields_[at_++], kLargestTime);
    if (value < 0) lines_.refuse("a time is below 0");
    return std::llround(value);
  }

  std::string take_name() {
    if (fields_[at_].empty()) lines_.refuse("a name is empty");
    return fields_[at_++];
  }

  bool take_score(double* score) {
    if (!number_ahead()) return false;
    *score = lines_.number_of(fields_[at_++]);
    return true;
  }

  const detail::TextLines& lines_;
  std::vector<std::string> fields_;
  std::vector<bool> marked_;
  std::size_t at_ = 0;
};

// Lines up to the end of the text, or up to a line with a full stop where `in_master`.
Transcription read_labels(detail::TextLines* lines, bool in_master) {
  Transcription found;
  bool ended = false;
  while (!ended && lines->next()) {
    const std::string& line = lines->line();
    if (in_master && line == kEnd) {
      ended = true;
    } else if (line == kAlternative) {
      found.alternatives.emplace_back();
    } else if (!line.empty() && line.front() != '#') {
      Label label = LabelLine(*lines).read();
      label.line = lines->number();
      auto& labels = found.alternatives.back();
      if (!labels.empty() && label.first != Label::kNoTime && label.first < labels.back().first)
        lines->refuse("a label begins before the one above");
      labels.push_back(std::move(label));
    }
  }
  if (in_master && !ended) lines->refuse("the transcription does not end with a full stop");
  return found;
}

std::string name_text(const std::string& name) {
  detail::require_name(name, "the label");
  const bool special = is_number(name) || name == kEnd || name == kAlternative ||
                       name.front() == '#' || name == kHeader;
  return special ? detail::in_quotes(name) : detail::quoted(name);
}

void add_score(bool has_score, double score, std::string* text) {
  if (!has_score) return;
  require(std::isfinite(score) && std::fabs(score) <= 1e30, "the score of a label is not finite");
  *text += " " + detail::shortest(score);
}

std::string label_text(const Label& label) {
  const auto is_time = [](std::int64_t t) {
    return t >= Label::kNoTime && static_cast<double>(t) <= kLargestTime;
  };
  require(is_time(label.first) && is_time(label.last), "the time of a label is out of range");
  require(label.last == Label::kNoTime || (label.first >= 0 && label.last >= label.first),
          "a label ends before it begins");
  std::string text;
  if (label.first != Label::kNoTime) text += std::to_string(label.first) + " ";
  if (label.last != Label::kNoTime) text += std::to_string(label.last) + " ";
  text += name_text(label.name);
  add_score(label.has_score, label.score, &text);
  for (const AuxiliaryLabel& auxiliary : label.auxiliary) {
    text += " " + name_text(auxiliary.name);
    add_score(auxiliary.has_score, auxiliary.score, &text);
  }
  return text + "\n";
}

}  // namespace

Transcription Transcription::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  detail::TextLines lines(text, name);
  return read_labels(&lines, false);
}

Transcription Transcription::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

std::string Transcription::to_text() const {
  require(!alternatives.empty(), "a transcription has one alternative at least");
  std::string text;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    if (i > 0) text += std::string(kAlternative) + "\n";
    std::int64_t before = Label::kNoTime;
    for (const Label& label : alternatives[i]) {
      require(label.first == Label::kNoTime || label.first >= before,
              "a label begins before the one above");
      before = label.first;
      text += label_text(label);
    }
  }
  return text;
}

void Transcription::write(const std::string& path) const { detail::write_text(path, to_text()); }

MasterLabelFile MasterLabelFile::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  detail::TextLines lines(text, name);
  if (!lines.next() || lines.line() != kHeader)
    lines.refuse(std::string("a master label file begins with ") + kHeader);
  MasterLabelFile file;
  while (lines.next()) {
    if (lines.line().empty()) continue;
    std::vector<std::string> fields;
    std::vector<bool> marked;
    if (!detail::split_fields(lines.line(), &fields, &marked))
      lines.refuse("a quotation does not end");
    if (!marked.front() || fields.front().empty())
      lines.refuse("expected the name of a label file in quotation marks");
    if (fields.size() > 1)
      lines.refuse("only transcriptions are read, no entries that name a folder");
    Entry entry;
    entry.pattern = fields.front();
    entry.transcription = read_labels(&lines, true);
    file.entries.push_back(std::move(entry));
  }
  return file;
}

MasterLabelFile MasterLabelFile::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

std::string MasterLabelFile::to_text() const {
  std::string text = std::string(kHeader) + "\n";
  for (const Entry& entry : entries) {
    detail::require_name(entry.pattern, "the pattern");
    text += detail::in_quotes(entry.pattern) + "\n" + entry.transcription.to_text() + kEnd + "\n";
  }
  return text;
}

void MasterLabelFile::write(const std::string& path) const { detail::write_text(path, to_text()); }

const MasterLabelFile::Entry* MasterLabelFile::find(const std::string& name) const {
  for (const Entry& entry : entries) {
    if (matches(entry.pattern, name)) return &entry;
  }
  return nullptr;
}

bool matches(const std::string& pattern, const std::string& name) {
  // Where the last * stood, and what it has matched so far: no other needs to be tried again.
  std::size_t star = std::string::npos;
  std::size_t matched = 0;
  std::size_t p = 0;
  std::size_t n = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      matched = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++matched;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

}  // namespace hri::htk
