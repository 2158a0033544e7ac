// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/jsgf_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <utility>

#include "hri/core/error.hpp"
#include "language/ngram_words.hpp"

namespace hri::detail {
namespace {

using Kind = GrammarExpression::Kind;

constexpr int kMostDepth = 400;  // of brackets and rules within each other
// Both fit into a string itself: nothing is allocated.
const std::string kBlanks = " \t\r\n";   // NOLINT(bugprone-throwing-static-initialization)
const std::string kMarks = "()[]|*+;=";  // NOLINT(bugprone-throwing-static-initialization)

bool is_blank(char c) { return kBlanks.find(c) != std::string::npos; }

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool is_slot_name(const std::string& name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_letter);
}

GrammarPart nothing() {
  GrammarExpression empty;
  empty.kind = Kind::word;
  empty.may_be_empty = true;
  return std::make_shared<const GrammarExpression>(std::move(empty));
}

// Alternatives of weight 0 are never taken.
void drop_impossible(std::vector<GrammarPart>* parts, std::vector<double>* weights) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < parts->size(); ++i) {
    if (!((*weights)[i] > 0)) continue;
    (*weights)[kept] = (*weights)[i];
    (*parts)[kept++] = std::move((*parts)[i]);
  }
  parts->resize(kept);
  weights->resize(kept);
}

}  // namespace

void JsgfReader::refuse(std::int64_t line, const std::string& why) const {
  fail(ErrorKind::format, name_ + ": line " + std::to_string(line) + ": " + why);
}

GrammarPart JsgfReader::read() {
  if (const std::int64_t line = bad_line(text_); line != 0) refuse(line, "is not UTF-8 text");
  read_header();
  split();
  read_rules();
  std::vector<GrammarPart> sentences;
  for (const auto& [name, rule] : rules_) {
    if (rule.is_public) sentences.push_back(part_of(name, rule.line, 0));
  }
  if (sentences.empty()) refuse(line_, "no rule is public");
  if (sentences.size() == 1) return sentences.front();
  const bool may_be_empty = std::any_of(sentences.begin(), sentences.end(),
                                        [](const GrammarPart& p) { return p->may_be_empty; });
  return joined(Kind::choice, std::move(sentences), may_be_empty, line_);
}

void JsgfReader::read_header() {
  if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ = 3;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string line = trimmed(text_.substr(at_, end - at_));
  if (line.rfind("#JSGF V1.0", 0) != 0 || line.back() != ';')
    refuse(1, "a grammar begins with '#JSGF V1.0;'");
  at_ = end;
}

void JsgfReader::skip_comment() {
  if (text_.compare(at_, 2, "//") == 0) {
    at_ = std::min(text_.find('\n', at_), text_.size());
    return;
  }
  const std::size_t end = text_.find("*/", at_ + 2);
  if (end == std::string::npos) refuse(line_, "a comment does not end");
  for (; at_ < end + 2; ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
}

// What stands up to `last`, which is passed; a backslash takes the next character as it is.
std::string JsgfReader::until(char last, const char* what) {
  const std::int64_t first_line = line_;
  std::string found;
  for (++at_; at_ < text_.size() && text_[at_] != last; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
    line_ += text_[at_] == '\n' ? 1 : 0;
    found += text_[at_];
  }
  if (at_ >= text_.size()) refuse(first_line, std::string(what) + " does not end");
  ++at_;
  return found;
}

void JsgfReader::split() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      line_ += c == '\n' ? 1 : 0;
      ++at_;
    } else if (text_.compare(at_, 2, "//") == 0 || text_.compare(at_, 2, "/*") == 0) {
      skip_comment();
    } else if (kMarks.find(c) != std::string::npos) {
      add_token(Token::Kind::mark, std::string(1, c));
      ++at_;
    } else if (c == '<') {
      add_token(Token::Kind::rule, trimmed(until('>', "the name of a rule")));
    } else if (c == '{') {
      add_token(Token::Kind::tag, trimmed(until('}', "a tag")));
    } else if (c == '/') {
      add_token(Token::Kind::weight, trimmed(until('/', "a weight")));
    } else {
      std::string word;
      if (c == '"') {
        word = trimmed(until('"', "a quotation"));
        if (const char* fault = label_fault(word)) refuse(line_, "'" + word + "' " + fault);
      } else {
        for (; at_ < text_.size() && !is_blank(text_[at_]) &&
               (kMarks + "<>{}/\"").find(text_[at_]) == std::string::npos;
             ++at_) {
          if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
          word += text_[at_];
        }
        if (word.empty()) refuse(line_, std::string("'") + c + "' has no meaning here");
        if (const char* fault = word_fault(word)) refuse(line_, "'" + word + "' " + fault);
      }
      add_token(Token::Kind::word, std::move(word));
    }
  }
  add_token(Token::Kind::end, {});
}

bool JsgfReader::is_mark(std::size_t at, char mark) const {
  return tokens_[at].kind == Token::Kind::mark && tokens_[at].text[0] == mark;
}

void JsgfReader::read_rules() {
  std::size_t at = 0;
  const auto expect = [&](char mark) {
    if (!is_mark(at, mark)) refuse(tokens_[at].line, std::string("expected ") + mark);
    ++at;
  };
  const auto is_word = [&](const char* word) {
    return tokens_[at].kind == Token::Kind::word && tokens_[at].text == word;
  };
  if (!is_word("grammar")) refuse(tokens_[at].line, "expected 'grammar name;'");
  ++at;
  if (tokens_[at].kind != Token::Kind::word) refuse(tokens_[at].line, "the grammar has no name");
  ++at;
  expect(';');
  while (tokens_[at].kind != Token::Kind::end) {
    if (is_word("import")) refuse(tokens_[at].line, "imports are not read");
    Rule rule;
    rule.line = tokens_[at].line;
    if (is_word("public")) {
      rule.is_public = true;
      ++at;
    }
    if (tokens_[at].kind != Token::Kind::rule) refuse(tokens_[at].line, "expected a <rule>");
    const std::string name = tokens_[at++].text;
    if (name.empty() || name == "NULL" || name == "VOID")
      refuse(rule.line, "<" + name + "> cannot be defined");
    expect('=');
    rule.first = at;
    while (tokens_[at].kind != Token::Kind::end && !is_mark(at, ';')) ++at;
    if (tokens_[at].kind == Token::Kind::end)
      refuse(rule.line, "<" + name + "> does not end with ;");
    ++at;
    if (!rules_.emplace(name, rule).second) refuse(rule.line, "<" + name + "> is defined twice");
  }
}

// What walks through the tree, and its end, call themselves as deep as it is.
GrammarPart JsgfReader::joined(Kind kind, std::vector<GrammarPart> parts, bool may_be_empty,
                               std::int64_t line) const {
  GrammarPart made = make_part(kind, std::move(parts), may_be_empty);
  if (made->depth > kMostGrammarDepth)
    refuse(line, "rules, tags and repetitions stand in each other too deep");
  if (const char* fault = size_fault(*made); fault != nullptr) refuse(line, fault);
  return made;
}

const GrammarPart& JsgfReader::part_of(const std::string& name, std::int64_t line, int depth) {
  const auto found = rules_.find(name);
  if (found == rules_.end()) refuse(line, "<" + name + "> is not defined");
  Rule& rule = found->second;
  if (rule.is_open) refuse(line, "<" + name + "> holds itself");
  if (rule.part == nullptr) {
    rule.is_open = true;
    std::size_t at = rule.first;
    rule.part = choice(&at, depth);
    if (!is_mark(at, ';')) refuse(tokens_[at].line, "a bracket is closed that was not opened");
    rule.is_open = false;
  }
  return rule.part;
}

GrammarPart JsgfReader::choice(std::size_t* at, int depth) {
  if (depth > kMostDepth)
    refuse(tokens_[*at].line, "brackets and rules stand in each other too deep");
  std::vector<GrammarPart> parts;
  std::vector<double> weights;
  double sum = 0;
  const std::int64_t line = tokens_[*at].line;
  for (bool more = true; more;) {
    if (tokens_[*at].kind == Token::Kind::weight) {
      std::istringstream number(tokens_[*at].text);
      number.imbue(std::locale::classic());
      double weight = 0;
      if (!(number >> weight) || !number.eof() || !(weight >= 0) || !(weight <= 1e12))
        refuse(tokens_[*at].line, "a weight must be a number from 0 to 1e12");
      weights.push_back(weight);
      sum += weight;
      ++*at;
    }
    parts.push_back(sequence(at, depth));
    more = is_mark(*at, '|');
    if (more) ++*at;
  }
  if (!weights.empty() && weights.size() != parts.size())
    refuse(line, "all alternatives have a weight, or none");
  if (!weights.empty()) drop_impossible(&parts, &weights);
  if (parts.empty()) refuse(line, "one of the alternatives must have a weight above 0");
  if (parts.size() == 1) return parts.front();
  const bool may_be_empty =
      std::any_of(parts.begin(), parts.end(), [](const GrammarPart& p) { return p->may_be_empty; });
  GrammarExpression made = *joined(Kind::choice, std::move(parts), may_be_empty, line);
  for (const double weight : weights) made.log_weights.push_back(std::log(weight / sum));
  return std::make_shared<const GrammarExpression>(std::move(made));
}

GrammarPart JsgfReader::sequence(std::size_t* at, int depth) {
  std::vector<GrammarPart> parts;
  while (tokens_[*at].kind == Token::Kind::word || tokens_[*at].kind == Token::Kind::rule ||
         is_mark(*at, '(') || is_mark(*at, '['))
    parts.push_back(item(at, depth));
  if (parts.empty()) refuse(tokens_[*at].line, "expected a word, a <rule> or a bracket");
  if (parts.size() == 1) return parts.front();
  const bool may_be_empty =
      std::all_of(parts.begin(), parts.end(), [](const GrammarPart& p) { return p->may_be_empty; });
  return joined(Kind::sequence, std::move(parts), may_be_empty, tokens_[*at].line);
}

GrammarPart JsgfReader::item(std::size_t* at, int depth) {
  const Token& token = tokens_[*at];
  ++*at;
  GrammarPart part;
  if (token.kind == Token::Kind::word) {
    GrammarExpression word;
    word.kind = Kind::word;
    word.word = token.text;
    part = std::make_shared<const GrammarExpression>(std::move(word));
  } else if (token.kind == Token::Kind::rule) {
    if (token.text == "VOID") refuse(token.line, "<VOID> is not read");
    part = token.text == "NULL" ? nothing() : part_of(token.text, token.line, depth + 1);
  } else {
    const bool is_option = token.text[0] == '[';
    part = choice(at, depth + 1);
    if (!is_mark(*at, is_option ? ']' : ')'))
      refuse(tokens_[*at].line,
             "a bracket of line " + std::to_string(token.line) + " is not closed");
    ++*at;
    if (is_option) part = joined(Kind::option, {part}, true, token.line);
  }
  while (is_mark(*at, '*') || is_mark(*at, '+') || tokens_[*at].kind == Token::Kind::tag) {
    const Token& mark = tokens_[*at];
    ++*at;
    if (mark.kind == Token::Kind::tag) {
      part = tagged(std::move(part), mark);
      continue;
    }
    if (part->may_be_empty)
      refuse(mark.line, "what is repeated here may be empty: a cycle without words");
    const bool at_least_one = mark.text[0] == '+';
    part = joined(at_least_one ? Kind::one_or_more : Kind::none_or_more, {part}, !at_least_one,
                  mark.line);
  }
  return part;
}

GrammarPart JsgfReader::tagged(GrammarPart inside, const Token& tag) const {
  const std::size_t equals = tag.text.find('=');
  const std::string slot = trimmed(tag.text.substr(0, equals));
  std::string value;
  if (equals != std::string::npos) {
    value = trimmed(tag.text.substr(equals + 1));
    if (value.size() > 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    if (value.empty()) refuse(tag.line, "the tag of slot '" + slot + "' has no value");
  }
  if (!is_slot_name(slot))
    refuse(tag.line, "a tag is {slot} or {slot=value}, a slot letters, digits and _");
  const bool may_be_empty = inside->may_be_empty;
  GrammarExpression made = *joined(Kind::tag, {std::move(inside)}, may_be_empty, tag.line);
  made.slot = slot;
  made.value = std::move(value);
  return std::make_shared<const GrammarExpression>(std::move(made));
}

}  // namespace hri::detail
