// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WordLattice from a grammar: by recursive descent to a tree, which becomes nodes and arcs.
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/word_lattice.hpp"
#include "htk/text_lines.hpp"
#include "language/grammar_tree.hpp"

namespace hri::htk {
namespace {

constexpr int kMostDepth = 200;  // of brackets within brackets

using Expression = hri::detail::GrammarExpression;
using Part = hri::detail::GrammarPart;

// A token is a mark, or a name: of a variable (with its $) or of a word.
struct GrammarToken {
  char mark = '\0';
  std::string name;
  bool ended = false;
};

class GrammarReader {
 public:
  GrammarReader(const std::string& text, const std::string& name) : text_(text), name_(name) {
    advance();
  }

  Part read() {
    while (!now_.name.empty() && now_.name.front() == '$') read_definition();
    if (now_.mark != '(') refuse("expected a definition of a $name, or the sentence in ( )");
    advance();
    Part sentence = choice(1);
    expect(')');
    if (!now_.ended) refuse("nothing stands behind the sentence");
    return sentence;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": line " + std::to_string(token_line_) + ": " + why);
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        token_line_ = line_;
        if (end == std::string::npos) refuse("a comment does not end");
        for (; at_ < end + 2; ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
      } else if (std::string(" \t\r\n").find(c) != std::string::npos) {
        ++at_;
      } else {
        return;
      }
    }
  }

  void advance() {
    skip_blanks();
    token_line_ = line_;
    now_ = GrammarToken();
    if (at_ >= text_.size()) {
      now_.ended = true;
      return;
    }
    if (std::string("()[]{}<>|=;").find(text_[at_]) != std::string::npos) {
      now_.mark = text_[at_++];
      return;
    }
    std::size_t end = at_;
    if (text_[at_] == '"' || text_[at_] == '\'') {
      ++end;
      while (end < text_.size() && text_[end] != text_[at_] && text_[end] != '\n')
        end += text_[end] == '\\' ? 2 : 1;
      if (end >= text_.size() || text_[end] != text_[at_]) refuse("a quotation does not end");
      ++end;
    } else {
      end = end_of_name();
    }
    std::vector<std::string> fields;
    const char* fault = detail::split_fields(text_.substr(at_, end - at_), &fields);
    if (fault != nullptr) refuse(fault);
    if (fields.size() != 1 || fields.front().empty()) refuse("a name is empty");
    now_.name = fields.front();
    at_ = end;
  }

  // A name ends before a mark, a blank or a comment.
  [[nodiscard]] std::size_t end_of_name() const {
    std::size_t end = at_;
    std::size_t percent = std::string::npos;
    while (end < text_.size() && text_.compare(end, 2, "/*") != 0 &&
           std::string("()[]{}<>|=; \t\r\n").find(text_[end]) == std::string::npos) {
      if (text_[end] == '%') percent = std::min(percent, end);
      end += text_[end] == '\\' ? 2 : 1;
    }
    end = std::min(end, text_.size());
    if (percent == std::string::npos) return end;
    const std::string before = text_.substr(at_, percent - at_);
    if (before == "WD_BEGIN" || before == "WD_END") refuse(before + "% is not read");
    refuse("'" + text_.substr(at_, end - at_) +
           "': outputs of words behind % are not read, the dictionary has them in [ ]; a % that is "
           "part of a name needs a backslash");
  }

  void expect(char mark) {
    if (now_.mark != mark) refuse(std::string("expected ") + mark);
    advance();
  }

  void read_definition() {
    const std::string name = now_.name;
    if (variables_.count(name) > 0) refuse("'" + name + "' is defined twice");
    advance();
    expect('=');
    Part value = choice(1);
    expect(';');
    variables_.emplace(name, std::move(value));
  }

  Part choice(int depth) {
    if (depth > kMostDepth) refuse("brackets stand in brackets, too deep");
    std::vector<Part> parts{sequence(depth)};
    while (now_.mark == '|') {
      advance();
      parts.push_back(sequence(depth));
    }
    if (parts.size() == 1) return parts.front();
    bool may_be_empty = false;
    for (const Part& part : parts) may_be_empty = may_be_empty || part->may_be_empty;
    return make(Expression::Kind::choice, std::move(parts), may_be_empty);
  }

  Part sequence(int depth) {
    std::vector<Part> parts;
    bool may_be_empty = true;
    while (!now_.name.empty() || now_.mark == '(' || now_.mark == '[' || now_.mark == '{' ||
           now_.mark == '<') {
      parts.push_back(factor(depth));
      may_be_empty = may_be_empty && parts.back()->may_be_empty;
    }
    if (parts.empty()) refuse("expected a word, a $name or a bracket");
    return parts.size() == 1 ? parts.front()
                             : make(Expression::Kind::sequence, std::move(parts), may_be_empty);
  }

  Part factor(int depth) {
    if (!now_.name.empty()) return named();
    const char mark = now_.mark;
    advance();
    if (mark == '<' && now_.mark == '<') refuse("loops << >> in context are not read");
    Part inside = choice(depth + 1);
    switch (mark) {
      case '(':
        expect(')');
        return inside;
      case '[':
        expect(']');
        return make(Expression::Kind::option, {inside}, true);
      case '{':
        require_words(inside);
        expect('}');
        return make(Expression::Kind::none_or_more, {inside}, true);
      default:
        require_words(inside);
        expect('>');
        return make(Expression::Kind::one_or_more, {inside}, false);
    }
  }

  void require_words(const Part& inside) const {
    if (inside->may_be_empty) refuse("what is repeated here may be empty: a cycle without words");
  }

  Part named() {
    const std::string name = now_.name;
    Part found;
    if (name.front() == '$') {
      const auto variable = variables_.find(name);
      if (variable == variables_.end()) refuse("'" + name + "' is not defined above");
      found = variable->second;
    } else {
      Expression word;
      word.kind = Expression::Kind::word;
      word.may_be_empty = name == WordLattice::kNull;
      if (!word.may_be_empty) word.word = name;
      found = std::make_shared<const Expression>(std::move(word));
    }
    advance();
    return found;
  }

  Part make(Expression::Kind kind, std::vector<Part> parts, bool may_be_empty) const {
    Part made = hri::detail::make_part(kind, std::move(parts), may_be_empty);
    if (made->depth > hri::detail::kMostGrammarDepth)
      refuse("the definitions stand in each other too deep");
    if (const char* fault = hri::detail::size_fault(*made); fault != nullptr) refuse(fault);
    return made;
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  std::int64_t token_line_ = 1;
  GrammarToken now_;
  std::map<std::string, Part> variables_;
};

}  // namespace

WordLattice WordLattice::of_grammar(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  const auto graph = hri::detail::GrammarGraph::of(GrammarReader(text, name).read());
  WordLattice lattice;
  for (const auto& node : graph.nodes)
    lattice.words.push_back(node.word.empty() ? kNull : node.word);
  for (const auto& arc : graph.arcs) lattice.arcs.push_back({arc.from, arc.to, arc.log_weight});
  return lattice;
}

}  // namespace hri::htk
