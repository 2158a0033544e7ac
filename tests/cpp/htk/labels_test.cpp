// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/labels.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

std::string refusal_of_labels(const std::string& text) {
  try {
    MasterLabelFile::parse(text, "words.mlf");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Transcription, ReadsTimesNamesScoresAndLevels) {
  const Transcription t = Transcription::parse(
      "0 3600000 one -125.5 w -60 \n3600000 4000000 \"two words\"\n\n\nthree 7\n"
      "5000000 four\n6000000 7000000 5\n///\n8\n",
      "a.lab");
  ASSERT_EQ(t.alternatives.size(), 2U);
  ASSERT_EQ(t.labels().size(), 5U);
  const Label& one = t.labels()[0];
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(one.last, 3600000);
  EXPECT_EQ(one.score, -125.5);
  ASSERT_EQ(one.auxiliary.size(), 1U);
  EXPECT_EQ(one.auxiliary[0].name, "w");
  EXPECT_EQ(one.auxiliary[0].score, -60);
  EXPECT_EQ(t.labels()[1].name, "two words");
  EXPECT_EQ(t.labels()[2].first, Label::kNoTime);
  EXPECT_EQ(t.labels()[2].score, 7);
  EXPECT_EQ(t.labels()[2].line, 5);
  EXPECT_EQ(Label().line, 0);
  EXPECT_EQ(t.labels()[3].first, 5000000);
  EXPECT_EQ(t.labels()[3].last, Label::kNoTime);
  EXPECT_EQ(t.labels()[4].name, "5");
  EXPECT_EQ(t.alternatives[1][0].name, "8");
}

TEST(Transcription, HasLabelsWithHashes) {
  const std::string text = "#no\n# 7\n0 5 #x\n";
  const Transcription t = Transcription::parse(text, "a.lab");
  ASSERT_EQ(t.labels().size(), 3U);
  EXPECT_EQ(t.labels()[0].name, "#no");
  EXPECT_EQ(t.labels()[1].name, "#");
  EXPECT_EQ(t.labels()[2].name, "#x");
  EXPECT_EQ(t.to_text(), text);
}

TEST(Transcription, IsReadAsItWasWritten) {
  Transcription t;
  for (const char* name : {"one", "7", "two words", "it's", "a\"b", "a\\b", ".", "///", "#!MLF!#",
                           "#x", "#\"x", "1e5", "\xe0\xa4\x8f\xe0\xa4\x95", "'"}) {
    Label label;
    label.name = name;
    t.alternatives[0].push_back(label);
    label.first = 100;
    label.last = 200;
    label.has_score = true;
    label.score = -1.0 / 3;
    label.auxiliary.push_back({"12", true, 0.1});
    t.alternatives[0].push_back(label);
    t.alternatives.push_back(t.alternatives[0]);
  }
  const MasterLabelFile file{{{"*/a \"quoted\".lab", t, "", false}, {"*/b.lab", {}, "", false}}};
  const std::string text = file.to_text();
  const MasterLabelFile read = MasterLabelFile::parse(text, "again");
  EXPECT_EQ(read.to_text(), text);
  ASSERT_EQ(read.entries.size(), 2U);
  EXPECT_EQ(read.entries[0].pattern, "*/a \"quoted\".lab");
  const auto& labels = read.entries[0].transcription.alternatives.back();
  ASSERT_EQ(labels.size(), t.alternatives.back().size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_EQ(labels[i].name, t.alternatives.back()[i].name);
    EXPECT_EQ(labels[i].score, t.alternatives.back()[i].score);
  }
}

TEST(MasterLabelFile, FindsTheFirstPatternThatMatches) {
  const MasterLabelFile file =
      MasterLabelFile::parse("#!MLF!#\n\"*/a?.lab\"\none\n.\n\"*\"\ntwo\n.\n", "words.mlf");
  EXPECT_EQ(file.find("x/y/a1.lab")->transcription.labels()[0].name, "one");
  EXPECT_EQ(file.find("x/y/a.lab")->transcription.labels()[0].name, "two");
  EXPECT_EQ(MasterLabelFile().find("a"), nullptr);
}

TEST(MasterLabelFile, KeepsFoldersOfLabelFiles) {
  const std::string text = "#!MLF!#\n\"*/a.lab\"\none\n.\n\"*\" -> \"labels\"\n\"*\" => \"x/y\"\n";
  const MasterLabelFile file = MasterLabelFile::parse(text, "words.mlf");
  EXPECT_EQ(file.to_text(), text);
  EXPECT_EQ(file.find("x/a.lab")->folder, "");
  EXPECT_EQ(file.find("b.lab")->folder, "labels");
  EXPECT_FALSE(file.find("b.lab")->is_searched);
  EXPECT_TRUE(file.entries[2].is_searched);
}

TEST(MasterLabelFile, WritesLinesAsTheyWereWhileTheySayTheSame) {
  const std::string text =
      "#!MLF!#\n\"*/a.rec\"\n0 3600000 sil -1234.500000\n3600000 5100000 7 -0.30 \"w\" 1.0\n"
      "5100000 5200000 'b c'\n.\n";
  MasterLabelFile file = MasterLabelFile::parse(text, "found.mlf");
  EXPECT_EQ(file.to_text(), text);
  file.entries[0].transcription.alternatives[0][0].score = -7;
  EXPECT_EQ(file.to_text().substr(0, 40), "#!MLF!#\n\"*/a.rec\"\n0 3600000 sil -7\n36000");
}

TEST(Matches, TakesStarsAndQuestionMarks) {
  EXPECT_TRUE(matches("*/a.lab", "x/y/a.lab"));
  EXPECT_TRUE(matches("*a*b*", "xxaxxbxx"));
  EXPECT_TRUE(matches("a??", "abc"));
  EXPECT_TRUE(matches("***", ""));
  EXPECT_FALSE(matches("a?", "a"));
  EXPECT_FALSE(matches("*/a.lab", "a.lab"));
  EXPECT_FALSE(matches("", "a"));
  EXPECT_FALSE(matches(std::string(5000, '*') + "b", std::string(5000, 'a')));
}

TEST(MasterLabelFile, RefusesDamagedFilesByNameAndLine) {
  const std::string head = "#!MLF!#\n";
  EXPECT_EQ(refusal_of_labels(""), "words.mlf: line 1: a master label file begins with #!MLF!#");
  EXPECT_EQ(refusal_of_labels(head + "\"a.lab\"\none\n"),
            "words.mlf: line 3: the transcription does not end with a full stop");
  EXPECT_EQ(refusal_of_labels(head + "a.lab\n.\n"),
            "words.mlf: line 2: expected the name of a label file in quotation marks");
  EXPECT_EQ(refusal_of_labels(head + "\"a.lab\n.\n"),
            "words.mlf: line 2: a quotation does not end");
  for (const char* line : {"\"*\" -> folder", "\"*\" ->", "\"*\" > \"folder\"", "\"*\" -> \"\"",
                           "\"*\" \"->\" \"folder\""}) {
    EXPECT_EQ(refusal_of_labels(head + line + "\n"),
              "words.mlf: line 2: expected \"pattern\", or \"pattern\" -> \"folder\"");
  }
  EXPECT_EQ(refusal_of_labels(head + "\"a\"\n200 100 one\n.\n"),
            "words.mlf: line 3: a label ends before it begins");
  EXPECT_EQ(refusal_of_labels(head + "\"a\"\n200 300 one\n100 200 two\n.\n"),
            "words.mlf: line 4: a label begins before the one above");
  EXPECT_EQ(refusal_of_labels(head + "\"a\"\n-5 300 one\n.\n"),
            "words.mlf: line 3: a time is below 0");
  EXPECT_EQ(refusal_of_labels(head + "\"a\"\n\xc3\n.\n"), "words.mlf: line 3: is not UTF-8 text");
}

TEST(Transcription, RefusesToWriteWhatNoFileCanHold) {
  for (const char* name : {"", "two\nlines", "\xff"}) {
    Transcription t;
    t.alternatives[0].emplace_back().name = name;
    EXPECT_THROW((void)t.to_text(), InvalidArgument);
  }
  Transcription t;
  Label label;
  label.name = "one";
  label.first = 200;
  label.last = 100;
  t.alternatives[0].push_back(label);
  EXPECT_THROW((void)t.to_text(), InvalidArgument);
}

}  // namespace
}  // namespace hri::htk
