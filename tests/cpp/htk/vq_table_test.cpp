// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/vq_table.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

// Two columns of kind MFCC, 6.
const std::string kListTable = "6 0 5 3 1 2\n1 1 1 0 2\n 0 0\n1 2 2 0 3\n 4 0\n1 3 3 0 0\n 0 4.5\n";

// The way to codeword 1 leads over node 1 of the root, which is nearer to what lies left.
const std::string kTreeTable =
    "6 1 5 5 1 1\n1 0 9 4 5\n 0\n1 0 4 6 7\n -2\n1 1 6 0 0\n -3\n1 2 7 0 0\n 1.5\n"
    "1 3 5 0 0\n 2\n";

std::string refusal_of_table(const std::string& text) {
  try {
    (void)VqTable::parse(text, "table");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

std::string table_with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(VqTable, NumbersTheNearestCodeword) {
  const VqTable table = VqTable::parse(kListTable, "table");
  EXPECT_EQ(table.num_codewords(), 3);
  EXPECT_EQ(table.dim(), 2);
  EXPECT_EQ(table.kind.text(), "MFCC");
  MatrixF frames(4, 2);
  frames << 1, 1, 3, 1, 1, 3, 2, 0;  // the last is as near to two
  EXPECT_EQ(table.quantise(frames), (std::vector<std::int32_t>{1, 2, 3, 1}));
  EXPECT_EQ(table.to_text(), kListTable);
  EXPECT_THROW((void)table.quantise(MatrixF::Zero(1, 3)), InvalidArgument);
  frames(0, 0) = NAN;
  EXPECT_THROW((void)table.quantise(frames), InvalidArgument);
}

TEST(VqTable, ReadsLayoutsOfOthers) {
  // As fields of a fixed width, on lines of any length; the kind with the bit of _V.
  const VqTable table = VqTable::parse(
      " 16390   0  5\n 3 1 2 1 1 1 0 2 0.000000e+00 0.0 1 2 2 0 3\n 4 0 1 3 3 0 0\n"
      "0 4.5",
      "table");
  EXPECT_EQ(table.to_text(), kListTable);
}

TEST(VqTable, FollowsATree) {
  const VqTable table = VqTable::parse(kTreeTable, "table");
  MatrixF frames(4, 1);
  // 1.4 is nearest to codeword 2, but nearer to the right node of the root than to the left one.
  frames << -5, -0.5F, 1.4F, 9;
  EXPECT_EQ(table.quantise(frames), (std::vector<std::int32_t>{1, 2, 3, 3}));
  EXPECT_EQ(table.to_text(), kTreeTable);
}

TEST(VqTable, WeighsColumnsByTheirVariance) {
  MatrixF centres(2, 2);
  centres << 0, 0, 1, 1;
  const VectorF deviation = (VectorF(2) << 10, 0.5F).finished();
  const VqTable table =
      VqTable::of_codebook(Codebook(centres), ParameterKind::parse("USER"), deviation);
  EXPECT_EQ(table.distance, VqTable::Distance::variances);
  EXPECT_EQ(table.nodes[1].mean[0], 10);
  MatrixF frame(1, 2);
  frame << 10, 0.1F;  // the first column says two, the second one; it is by far the surer one
  EXPECT_EQ(table.quantise(frame).front(), 2);
  frame << 6, 0.1F;
  EXPECT_EQ(table.quantise(frame).front(), 1);
  EXPECT_EQ(VqTable::parse(table.to_text(), "again").to_text(), table.to_text());
  EXPECT_THROW((void)VqTable::of_codebook(Codebook(centres), {}, VectorF::Zero(2)),
               InvalidArgument);
  EXPECT_THROW((void)VqTable::of_codebook(Codebook(centres), {}, VectorF::Ones(3)),
               InvalidArgument);
}

TEST(VqTable, RefusesDamageWithFileAndLine) {
  EXPECT_EQ(refusal_of_table(""), "table: line 1: the file ends before the parameter kind");
  EXPECT_EQ(refusal_of_table("6 0 5 3 2 2 2"), "table: line 1: several streams are not read");
  EXPECT_EQ(refusal_of_table("6 0 2 3 1 2"), "table: line 1: full covariances are not read");
  EXPECT_EQ(refusal_of_table("63 0 5 3 1 2"), "table: line 1: the parameter kind 63 is none");
  EXPECT_EQ(refusal_of_table(table_with(kListTable, "0 4.5\n", "0\n")),
            "table: line 7: the file ends before the mean of a node");
  EXPECT_EQ(refusal_of_table(kListTable + "1\n"),
            "table: line 8: there are more values than the header says");
  EXPECT_EQ(refusal_of_table(table_with(kListTable, "1 2 2 0 3", "1 1 2 0 3")),
            "table: line 5: the codeword 1 again");
  EXPECT_EQ(refusal_of_table(table_with(kListTable, "1 2 2 0 3", "1 2 1 0 3")),
            "table: line 5: the node 1 stands here again");
  EXPECT_EQ(refusal_of_table(table_with(kListTable, "1 2 2 0 3", "1 2 2 1 3")),
            "table: line 4: a node of a list has no codeword, or a left node");
  EXPECT_EQ(refusal_of_table(table_with(kListTable, "4 0\n", "4 x\n")),
            "table: line 5: 'x' is no number that can stand here");
  EXPECT_EQ(refusal_of_table("6 0 1 1 1 2\n1 1 1 0 0\n 0 0\n 1 0\n"),
            "table: line 4: an inverse variance is not above 0");
  EXPECT_EQ(refusal_of_table(table_with(kTreeTable, "1 0 4 6 7", "1 0 4 6 6")),
            "table: line 11: the node 6 does not follow one node before it");
  EXPECT_EQ(refusal_of_table(table_with(kTreeTable, "1 0 4 6 7", "1 0 4 6 9")),
            "table: line 11: the node 9 does not follow one node before it");
  EXPECT_EQ(refusal_of_table(table_with(kTreeTable, "1 0 4 6 7", "1 0 4 6 8")),
            "table: line 11: there is no node 8, which another names");
  EXPECT_EQ(refusal_of_table(table_with(kTreeTable, "1 3 5 0 0", "1 4 5 0 0")),
            "table: line 11: codewords are not 1, 2, ... up to 4096");
}

TEST(VqTable, SizesAreBoundedBeforeAnythingIsRead) {
  EXPECT_EQ(refusal_of_table("6 0 5 99999999 1 2"),
            "table: line 1: '99999999' is no whole number in 1..8192");
  EXPECT_EQ(refusal_of_table("6 0 5 8192 1 8191"), "table: line 1: the table has too many values");
}

}  // namespace
}  // namespace hri::htk
