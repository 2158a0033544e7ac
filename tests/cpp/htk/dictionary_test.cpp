// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/dictionary.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

TEST(Dictionary, WritesLinesAsTheyWereWhileTheySayTheSame) {
  const std::string text = "ONE             [one]  0.50 w  ah n sp\nSENT-END        []  sil\n";
  Dictionary d = Dictionary::parse(text, "words.dic");
  EXPECT_EQ(d.to_text(), text);
  EXPECT_EQ(d.entries[1].line, 2);
  d.entries[0].models.pop_back();
  EXPECT_EQ(d.to_text(), "ONE [one] 0.5 w ah n\nSENT-END        []  sil\n");
}

TEST(Dictionary, ReadsOutputsAndProbabilities) {
  const Dictionary d = Dictionary::parse(
      "one w ah n\none [1] 0.25 hh w ah n\nSENT-START [] sil\n7 7\n\"8\" \"[x]\" "
      "\"#\\\"\" t\n",
      "words.dic");
  ASSERT_EQ(d.entries.size(), 5U);
  EXPECT_FALSE(d.entries[0].has_output);
  EXPECT_EQ(d.entries[1].output, "1");
  EXPECT_EQ(d.entries[1].probability, 0.25);
  EXPECT_EQ(d.entries[1].models, (std::vector<std::string>{"hh", "w", "ah", "n"}));
  EXPECT_TRUE(d.entries[2].has_output);
  EXPECT_EQ(d.entries[2].output, "");
  EXPECT_EQ(d.entries[3].models, std::vector<std::string>{"7"});
  EXPECT_EQ(d.entries[4].models[0], "[x]");
  EXPECT_EQ(d.by_word().at("one"), (std::vector<int>{0, 1}));
  const std::string text = d.to_text();
  EXPECT_EQ(Dictionary::parse(text, "again").to_text(), text);
}

TEST(Dictionary, HasWordsWithHashes) {
  const std::string text = "#no n ow\n# [#] hash\n#\\\"  h#\n";
  Dictionary d = Dictionary::parse(text, "words.dic");
  ASSERT_EQ(d.entries.size(), 3U);
  EXPECT_EQ(d.entries[0].word, "#no");
  EXPECT_EQ(d.entries[1].word, "#");
  EXPECT_EQ(d.entries[2].word, "#\"");
  EXPECT_EQ(d.to_text(), text);
  for (Pronunciation& entry : d.entries) entry.text.clear();
  EXPECT_EQ(Dictionary::parse(d.to_text(), "again").entries[2].word, "#\"");
}

TEST(Dictionary, RefusesByNameAndLine) {
  const auto of = [](const std::string& text) -> std::string {
    try {
      Dictionary::parse(text, "file");
    } catch (const FormatError& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_EQ(of("one w\ntwo\n"), "file: line 2: 'two' has no models");
  EXPECT_EQ(of("one [1]\n"), "file: line 1: 'one' has no models");
  EXPECT_EQ(of("one 1.5 w\n"),
            "file: line 1: the probability of a pronunciation is outside 0..1, 0 excluded");
  EXPECT_EQ(of("one \"w\n"), "file: line 1: a quotation does not end");
  EXPECT_EQ(of("one \"\" w\n"), "file: line 1: the name of a model is empty");
  EXPECT_EQ(of("\xff w\n"), "file: line 1: is not UTF-8 text");
  for (const char* wrong : {"one\\377 w\n", "one [\\377] w\n", "one w\\012x\n", "one w\\000\n"})
    EXPECT_EQ(of(wrong), "file: line 1: a name is not UTF-8 text of one line");
  EXPECT_EQ(Dictionary::parse("\\303\\244 w\n", "d").entries[0].word, "\xc3\xa4");
}

}  // namespace
}  // namespace hri::htk
