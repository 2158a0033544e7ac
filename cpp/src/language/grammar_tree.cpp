// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/grammar_tree.hpp"

#include <algorithm>
#include <utility>

namespace hri::detail {
namespace {

constexpr std::size_t kMostNodes = 1000000;
constexpr std::size_t kMostCharacters = 16000000;  // of words and tags, each where it stands

class GraphBuilder {
 public:
  GrammarGraph build(const GrammarExpression& sentence) {
    const int first = add({});
    const Ends ends = expand(sentence);
    const int last = add({});
    connect(first, ends.entry);
    connect(ends.exit, last);
    return std::move(graph_);
  }

 private:
  struct Ends {
    int entry;
    int exit;
  };

  int add(const GrammarGraph::Node& node) {
    graph_.nodes.push_back(node);
    return static_cast<int>(graph_.nodes.size()) - 1;
  }
  void connect(int from, int to, double log_weight = 0) {
    graph_.arcs.push_back({from, to, log_weight});
  }

  Ends expand(const GrammarExpression& e) {
    using Kind = GrammarExpression::Kind;
    switch (e.kind) {
      case Kind::word: {
        const int node = add({e.word, GrammarGraph::Mark::none, -1});
        return {node, node};
      }
      case Kind::sequence: {
        Ends ends = expand(*e.parts.front());
        for (std::size_t i = 1; i < e.parts.size(); ++i) {
          const Ends next = expand(*e.parts[i]);
          connect(ends.exit, next.entry);
          ends.exit = next.exit;
        }
        return ends;
      }
      case Kind::none_or_more: {
        const int node = add({});
        const Ends inside = expand(*e.parts.front());
        connect(node, inside.entry);
        connect(inside.exit, node);
        return {node, node};
      }
      case Kind::one_or_more: {
        const int entry = add({});
        const Ends inside = expand(*e.parts.front());
        const int exit = add({});
        connect(entry, inside.entry);
        connect(inside.exit, entry);
        connect(inside.exit, exit);
        return {entry, exit};
      }
      case Kind::tag: {
        const auto tag = static_cast<int>(graph_.tags.size());
        graph_.tags.push_back({e.slot, e.value});
        const int entry = add({"", GrammarGraph::Mark::opens, tag});
        const Ends inside = expand(*e.parts.front());
        const int exit = add({"", GrammarGraph::Mark::closes, tag});
        connect(entry, inside.entry);
        connect(inside.exit, exit);
        return {entry, exit};
      }
      default: {
        const int entry = add({});
        const int exit = add({});
        for (std::size_t i = 0; i < e.parts.size(); ++i) {
          const Ends inside = expand(*e.parts[i]);
          connect(entry, inside.entry, e.log_weights.empty() ? 0 : e.log_weights[i]);
          connect(inside.exit, exit);
        }
        if (e.kind == Kind::option) connect(entry, exit);
        return {entry, exit};
      }
    }
  }

  GrammarGraph graph_;
};

}  // namespace

GrammarPart make_part(GrammarExpression::Kind kind, std::vector<GrammarPart> parts,
                      bool may_be_empty) {
  GrammarExpression made;
  made.kind = kind;
  made.may_be_empty = may_be_empty;
  // Beside those of its parts.
  made.num_nodes = kind == GrammarExpression::Kind::sequence       ? 0
                   : kind == GrammarExpression::Kind::none_or_more ? 1
                                                                   : 2;
  for (const GrammarPart& part : parts) {
    made.depth = std::max(made.depth, part->depth + 1);
    made.num_nodes += part->num_nodes;
    made.num_characters +=
        part->num_characters + part->word.size() + part->slot.size() + part->value.size();
  }
  made.parts = std::move(parts);
  return std::make_shared<const GrammarExpression>(std::move(made));
}

const char* size_fault(const GrammarExpression& expression) {
  if (expression.num_nodes + 2 > kMostNodes) return "the grammar has more than a million nodes";
  if (expression.num_characters > kMostCharacters)
    return "the grammar is too large where its rules are written out";
  return nullptr;
}

GrammarGraph GrammarGraph::of(const GrammarPart& sentence) {
  return GraphBuilder().build(*sentence);
}

}  // namespace hri::detail
