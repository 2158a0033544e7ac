// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Grammars of commands with slots, in the JSpeech Grammar Format (JSGF, W3C note of June 2000).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/language/word_network.hpp"

namespace hri {

namespace detail {
struct GrammarGraph;
}

/// What a command says beside its words, by name.
using Slots = std::map<std::string, std::string>;

/// Immutable; const calls are safe from several threads. Copies share what they hold.
class HRI_API Grammar {
 public:
  /// Reads a grammar: `#JSGF V1.0;`, `grammar name;`, rules `<name> = ...;`, of which any of the
  /// public ones is a sentence. ( ), [ ], |, *, +, /weights/ of alternatives and `<NULL>` mean what
  /// they do in JSGF; an alternative of weight 0 is never said, and its words are none of the
  /// grammar's. A tag {slot=value} sets a slot where the expansion before it is said, {slot}
  /// sets it to the words said; of two of one slot the later one counts. Throws IoError, and
  /// FormatError naming file and line for another form, imports, rules that are not defined or hold
  /// themselves, tags of another form, alternatives that all have weight 0, and what is repeated
  /// but may be empty.
  static Grammar load(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static Grammar parse(const std::string& text, const std::string& name);

  [[nodiscard]] const std::string& text() const { return text_; }                 ///< that was read
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }  ///< sorted

  /// The slots of a sentence; nothing for what is none, or has more than 10000 words. Where it can
  /// be read in several ways, those alternatives count that stand first.
  [[nodiscard]] std::optional<Slots> slots_of(const std::vector<std::string>& sentence) const;

  /// Every sentence once, in the order in which the grammar has them, with its weights left aside.
  /// Throws InvalidArgument for more than `most`, for repetitions, which have no end, for a
  /// sentence of more than 10000 words and for more than four million words in all.
  [[nodiscard]] std::vector<std::vector<std::string>> sentences(std::size_t most = 10000) const;

  /// Its sentences as a network; model i is the word labels[i]. With a `silence` model it may stand
  /// before, between and after words; with the number of an `unknown` word, sentences of this alone
  /// are allowed, too. Throws InvalidArgument for a word that labels do not have.
  [[nodiscard]] WordNetwork network(const std::vector<std::string>& labels,
                                    int silence = WordNetwork::kNoSilence,
                                    int unknown = WordNetwork::kNull) const;

 private:
  Grammar() = default;

  std::string text_;
  std::vector<std::string> words_;
  std::shared_ptr<const detail::GrammarGraph> graph_;
};

}  // namespace hri
