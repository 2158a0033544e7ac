// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a grammar says, whatever it is written in: a tree, which becomes nodes and arcs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hri::detail {

constexpr int kMostGrammarDepth = 2000;  ///< of the tree

struct GrammarExpression {
  enum class Kind : std::uint8_t { word, sequence, choice, option, none_or_more, one_or_more, tag };
  Kind kind = Kind::sequence;
  std::string word;  ///< empty: no word
  std::vector<std::shared_ptr<const GrammarExpression>> parts;
  std::vector<double> log_weights;  ///< of the parts of a choice; none: 0
  std::string slot;                 ///< of a tag
  std::string value;                ///< of a tag; empty: the words inside
  bool may_be_empty = false;
  int depth = 1;
  std::size_t num_nodes = 1;       ///< that it becomes
  std::size_t num_characters = 0;  ///< of the words and tags of its parts, each where it stands
};
using GrammarPart = std::shared_ptr<const GrammarExpression>;

/// An expression of parts; its depth and size are set.
GrammarPart make_part(GrammarExpression::Kind kind, std::vector<GrammarPart> parts,
                      bool may_be_empty);

/// nullptr, or why a graph cannot be made of it: more than a million nodes, or 16 million
/// characters of words and tags.
const char* size_fault(const GrammarExpression& expression);

struct GrammarGraph {
  enum class Mark : std::uint8_t { none, opens, closes };
  struct Node {
    std::string word;  ///< empty: none
    Mark mark = Mark::none;
    int tag = -1;
  };
  struct Arc {
    int from;
    int to;
    double log_weight;
  };
  struct Tag {
    std::string slot;
    std::string value;
  };
  std::vector<Node> nodes;  ///< the first begins sentences, the last ends them
  std::vector<Arc> arcs;
  std::vector<Tag> tags;

  /// Of an expression without size_fault().
  static GrammarGraph of(const GrammarPart& sentence);
};

}  // namespace hri::detail
