// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/decision_trees.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

const std::string kTreeQuestions = "QS 'L_stop' { \"p-*\",\"t-*\" }\nQS 'R_any' { \"*+*\" }\n";
const std::string kTrees = kTreeQuestions +
                           "\na[2]\n{\n  0 'L_stop' -1 \"a1\"\n -1 'R_any' \"a2\" \"a3\"\n}\n\n"
                           "b[3]\n   \"b1\"\n\n";

std::string refusal_of_trees(const std::string& text) {
  try {
    (void)DecisionTrees::parse(text, "trees");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(DecisionTrees, AreReadAndWritten) {
  const DecisionTrees trees = DecisionTrees::parse(kTrees, "trees");
  ASSERT_EQ(trees.trees.size(), 2u);
  EXPECT_EQ(trees.to_text(), kTrees);
  const DecisionTree* tree = trees.find("a", 2);
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(trees.leaf_of(*tree, "p-a+k"), "a1");
  EXPECT_EQ(trees.leaf_of(*tree, "k-a"), "a2");
  EXPECT_EQ(trees.leaf_of(*tree, "k-a+t"), "a3");
  EXPECT_EQ(trees.leaf_of(*trees.find("b", 3), "b"), "b1");
  EXPECT_EQ(trees.find("b", 2), nullptr);
}

TEST(DecisionTrees, TakeNodesInAnyOrderAndPatternsWithoutMarks) {
  const DecisionTrees trees = DecisionTrees::parse(
      "QS L_stop {p-*, t-*}\nQS R_any {*+*}\na[2] { -7 R_any \"a2\" \"a3\" 0 L_stop -7 \"a1\" } "
      "b[3] \"b1\"",
      "trees");
  EXPECT_EQ(trees.to_text(), kTrees);
}

TEST(DecisionTrees, RefuseDamageWithFileAndLine) {
  EXPECT_EQ(refusal_of_trees("x"), "trees: line 1: expected QS, or a tree such as a[2]");
  EXPECT_EQ(refusal_of_trees("a[1] \"b\""), "trees: line 1: expected QS, or a tree such as a[2]");
  EXPECT_EQ(refusal_of_trees("QS q {}"), "trees: line 1: expected a pattern");
  EXPECT_EQ(refusal_of_trees("QS q { a"), "trees: line 1: expected }");
  EXPECT_EQ(refusal_of_trees("QS q { a }\nQS q { b }\n"),
            "trees: line 2: the question 'q' stands here again");
  EXPECT_EQ(refusal_of_trees("a[2]\n{ 0 'q' \"x\" \"y\" }"),
            "trees: line 2: the question is not defined above");
  const std::string tree = kTreeQuestions + "a[2]\n{\n 0 'L_stop' ";
  EXPECT_EQ(refusal_of_trees(tree + "-1 \"a\" }"), "trees: line 5: there is no node -1");
  EXPECT_EQ(refusal_of_trees(tree + "0 \"a\" }"), "trees: line 5: node 0 follows none");
  EXPECT_EQ(refusal_of_trees(tree + "-1 -1\n -1 'R_any' \"a\" \"b\" }"),
            "trees: line 6: node -1 follows two");
  EXPECT_EQ(refusal_of_trees(tree + "-1 \"a\"\n -1 'R_any' -1 \"b\" }"),
            "trees: line 6: node -1 follows two");
  EXPECT_EQ(refusal_of_trees(tree + "\"a\" \"b\"\n -1 'R_any' \"a\" \"b\" }"),
            "trees: line 6: a node follows none");
  EXPECT_EQ(refusal_of_trees(tree + "\"a\" \"b\"\n 0 'R_any' \"a\" \"b\" }"),
            "trees: line 6: a node stands here again");
  EXPECT_EQ(refusal_of_trees(tree + "\"a\" \"b\"\n"), "trees: line 5: a tree does not end with }");
  EXPECT_EQ(refusal_of_trees(tree + "\"a\" \"b"), "trees: line 5: a quotation does not end");
  EXPECT_EQ(refusal_of_trees("a[2] \"\\377\""),
            "trees: line 1: a name is not UTF-8 text of one line");
}

}  // namespace
}  // namespace hri::htk
