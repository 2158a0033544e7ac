// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Tokens of HTK's model definitions.
#pragma once

#include <cstdint>
#include <string>

namespace hri::htk::detail {

// Of what is read: far above anything in use.
constexpr int kMostStates = 4098;
constexpr int kMostMixtures = 4096;  // codewords, too

/// What discrete models have in a file for a probability within 0..1, and the same back: -2371.8 ln
/// of it, rounded, 0..32767; 32767 stands for 0.
int to_scaled_log(double probability);
double from_scaled_log(int value);

/// <KEYWORD>, ~o and the like, "name", a number or a word.
struct ModelToken {
  enum class Kind : std::uint8_t { end, keyword, macro, name, word };
  Kind kind = Kind::end;
  std::string text;  ///< of a keyword in capitals, without < >
};

/// `text` and `name` outlive it.
class ModelTokens {
 public:
  ModelTokens(const std::string& text, const std::string& name) : text_(text), name_(name) {
    advance();
  }

  [[nodiscard]] const ModelToken& now() const { return now_; }
  [[nodiscard]] bool is(const char* keyword) const {
    return now_.kind == ModelToken::Kind::keyword && now_.text == keyword;
  }
  [[nodiscard]] bool is_macro(char type) const {
    return now_.kind == ModelToken::Kind::macro && now_.text[0] == type;
  }
  void advance();
  /// Past the keyword if it stands here.
  bool skip(const char* keyword);
  void expect(const char* keyword);
  std::string take_name();
  double take_number();
  int take_whole(int low, int high);
  /// Of the token that stands here, and of the one before.
  [[noreturn]] void refuse(const std::string& why) const { refuse_at(token_line_, why); }
  [[noreturn]] void refuse_taken(const std::string& why) const { refuse_at(taken_line_, why); }

 private:
  [[noreturn]] void refuse_at(std::int64_t line, const std::string& why) const;
  void skip_blanks();
  void read_quoted();

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;        // where reading is
  std::int64_t taken_line_ = 1;  // where the token before began
  std::int64_t token_line_ = 1;  // where the token began
  ModelToken now_;
};

}  // namespace hri::htk::detail
