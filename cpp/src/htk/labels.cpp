// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/labels.hpp"

#include <algorithm>
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
constexpr double kLargestScore = 1e30;

bool is_number(const std::string& text) {
  double value = 0;
  return detail::parse_number(text, &value);
}

bool same(const Label& a, const Label& b) {
  const auto same_auxiliary = [](const AuxiliaryLabel& x, const AuxiliaryLabel& y) {
    return x.name == y.name && x.has_score == y.has_score && x.score == y.score;
  };
  return a.name == b.name && a.first == b.first && a.last == b.last && a.has_score == b.has_score &&
         a.score == b.score &&
         std::equal(a.auxiliary.begin(), a.auxiliary.end(), b.auxiliary.begin(), b.auxiliary.end(),
                    same_auxiliary);
}

// Fields of one line, taken from the front.
class LabelLine {
 public:
  explicit LabelLine(const std::string& line) {
    if (const char* fault = detail::split_fields(line, &fields_, &marked_); fault != nullptr)
      fault_ = fault;
  }

  // "", or what is wrong with the line.
  std::string read(Label* label) {
    if (!fault_.empty()) return fault_;
    // What is left over by the times is the name, even where it is a number.
    if (number_ahead() && fields_.size() > 1) label->first = time();
    if (label->first != Label::kNoTime && number_ahead() && fields_.size() - at_ > 1)
      label->last = time();
    if (label->last != Label::kNoTime && label->last < label->first)
      set_fault("a label ends before it begins");
    label->name = take_name();
    label->has_score = take_score(&label->score);
    while (at_ < fields_.size()) {
      AuxiliaryLabel auxiliary;
      auxiliary.name = take_name();
      auxiliary.has_score = take_score(&auxiliary.score);
      label->auxiliary.push_back(std::move(auxiliary));
    }
    return fault_;
  }

 private:
  void set_fault(const std::string& fault) {
    if (fault_.empty()) fault_ = fault;
  }

  [[nodiscard]] bool number_ahead() const {
    return at_ < fields_.size() && !marked_[at_] && is_number(fields_[at_]);
  }

  double number(double largest) {
    double value = 0;
    if (!detail::parse_number(fields_[at_], &value) || std::fabs(value) > largest)
      set_fault("'" + fields_[at_] + "' is no number that can stand here");
    ++at_;
    return fault_.empty() ? value : 0;
  }

  std::int64_t time() {
    const double value = number(kLargestTime);
    if (value < 0) set_fault("a time is below 0");
    return std::llround(value);
  }

  std::string take_name() {
    if (fields_[at_].empty()) set_fault("a name is empty");
    return fields_[at_++];
  }

  bool take_score(double* score) {
    if (!number_ahead()) return false;
    *score = number(kLargestScore);
    return true;
  }

  std::vector<std::string> fields_;
  std::vector<bool> marked_;
  std::size_t at_ = 0;
  std::string fault_;
};

// Whether the line that a label was read from says what it holds now.
bool is_said_by_its_line(const Label& label) {
  if (label.text.empty() || label.text.find_first_of("\r\n") != std::string::npos) return false;
  Label again;
  return LabelLine(label.text).read(&again).empty() && same(label, again);
}

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
    } else if (!line.empty()) {
      Label label;
      if (const std::string fault = LabelLine(line).read(&label); !fault.empty())
        lines->refuse(fault);
      label.line = lines->number();
      label.text = line;
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
  require(std::isfinite(score) && std::fabs(score) <= kLargestScore,
          "the score of a label is not finite");
  *text += " " + detail::shortest(score);
}

std::string label_text(const Label& label) {
  const auto is_time = [](std::int64_t t) {
    return t >= Label::kNoTime && static_cast<double>(t) <= kLargestTime;
  };
  require(is_time(label.first) && is_time(label.last), "the time of a label is out of range");
  require(label.last == Label::kNoTime || (label.first >= 0 && label.last >= label.first),
          "a label ends before it begins");
  if (is_said_by_its_line(label)) return label.text + "\n";
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
    if (const char* fault = detail::split_fields(lines.line(), &fields, &marked); fault != nullptr)
      lines.refuse(fault);
    if (!marked.front() || fields.front().empty())
      lines.refuse("expected the name of a label file in quotation marks");
    Entry entry;
    entry.pattern = fields.front();
    if (fields.size() == 1) {
      entry.transcription = read_labels(&lines, true);
    } else {
      entry.is_searched = fields[1] == "=>";
      if (fields.size() != 3 || marked[1] || !marked[2] || fields[2].empty() ||
          (fields[1] != "->" && !entry.is_searched))
        lines.refuse("expected \"pattern\", or \"pattern\" -> \"folder\"");
      entry.folder = fields[2];
    }
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
    text += detail::in_quotes(entry.pattern);
    if (entry.folder.empty()) {
      text += "\n" + entry.transcription.to_text() + kEnd + "\n";
    } else {
      detail::require_name(entry.folder, "the folder");
      text +=
          std::string(entry.is_searched ? " => " : " -> ") + detail::in_quotes(entry.folder) + "\n";
    }
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
