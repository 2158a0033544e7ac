// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Grammar files in the JSpeech Grammar Format: to tokens, these to rules, the public rules to a
// tree.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "language/grammar_tree.hpp"

namespace hri::detail {

class JsgfReader {
 public:
  /// `name` stands for the file in messages. Both must live as long as the reader.
  JsgfReader(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  /// The sentences: alternatives of the public rules. Throws FormatError naming file and line.
  GrammarPart read();

 private:
  struct Token {
    enum class Kind : std::uint8_t { mark, word, rule, tag, weight, end };
    Kind kind = Kind::end;
    std::string text;
    std::int64_t line = 0;
  };
  struct Rule {
    std::size_t first = 0;  // token of its expansion
    std::int64_t line = 0;
    bool is_public = false;
    bool is_open = false;  // being read
    GrammarPart part;
  };

  [[noreturn]] void refuse(std::int64_t line, const std::string& why) const;
  void read_header();
  void split();
  void add_token(Token::Kind kind, std::string text) {
    tokens_.push_back({kind, std::move(text), line_});
  }
  void skip_comment();
  std::string until(char last, const char* what);
  void read_rules();
  [[nodiscard]] bool is_mark(std::size_t at, char mark) const;
  GrammarPart joined(GrammarExpression::Kind kind, std::vector<GrammarPart> parts,
                     bool may_be_empty, std::int64_t line) const;
  const GrammarPart& part_of(const std::string& rule, std::int64_t line, int depth);
  GrammarPart choice(std::size_t* at, int depth);
  GrammarPart sequence(std::size_t* at, int depth);
  GrammarPart item(std::size_t* at, int depth);
  GrammarPart tagged(GrammarPart inside, const Token& tag) const;

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  std::vector<Token> tokens_;
  std::map<std::string, Rule> rules_;
};

}  // namespace hri::detail
