// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HHEd's questions about contexts, and the decision trees that they make, by which states of models
// in context are tied and those of unseen contexts found (HTK Book, section 10.5).
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"

namespace hri::htk {

/// Yes for models whose name fits one of the patterns: * stands for any characters, ? for one.
struct ContextQuestion {
  std::string name;
  std::vector<std::string> patterns;
};

/// Of one state of the models of one unit, whatever their contexts.
struct DecisionTree {
  struct Node {
    int question = -1;  ///< of DecisionTrees; -1: a leaf
    int no = -1;        ///< the node that follows
    int yes = -1;
    std::string leaf;  ///< the ~s of a leaf
  };

  std::string unit;         ///< b of a-b+c
  int state = 2;            ///< entry state is 1
  std::vector<Node> nodes;  ///< the root first; others stand behind the node that they follow
};

struct HRI_API DecisionTrees {
  std::vector<ContextQuestion> questions;
  std::vector<DecisionTree> trees;

  /// Throws IoError; FormatError naming file and line for whatever is no file of trees, a question
  /// that is not defined above, and nodes that are no tree.
  static DecisionTrees read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static DecisionTrees parse(const std::string& text, const std::string& name);

  /// The text of a file: questions, then trees, whose nodes have numbers from 0 down. Throws
  /// InvalidArgument for names that cannot stand in a file.
  [[nodiscard]] std::string to_text() const;

  /// The last tree of a unit and state; nullptr where there is none.
  [[nodiscard]] const DecisionTree* find(const std::string& unit, int state) const;
  /// The ~s that a tree of these has for a model of this name.
  [[nodiscard]] const std::string& leaf_of(const DecisionTree& tree,
                                           const std::string& model) const;
};

/// Whether a question is answered with yes for a model of this name.
HRI_API bool is_answered_yes(const ContextQuestion& question, const std::string& model);

}  // namespace hri::htk
