// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/grammar.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "language/decoding_testing.hpp"

namespace hri {
namespace {

const std::string kHead = "#JSGF V1.0 UTF-8 en;\ngrammar commands;\n";
const std::string kCommands = kHead + R"(
// What a robot does.
public <command> = [ please ] ( <walk> | <hand> );
<walk> = go ( forward {direction=ahead} | back {direction} ) [ <number> {steps} ( step | steps ) ];
<hand> = raise the ( left | right ) {side} hand {action=raise};
<number> = one | two | three; /* at
most */
)";

Slots slots_of(const Grammar& grammar, const std::vector<std::string>& sentence) {
  const auto found = grammar.slots_of(sentence);
  return found ? *found : Slots{{"no", "sentence"}};
}

std::string refusal(const std::string& rules) {
  try {
    (void)Grammar::parse(kHead + rules, "file");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Grammar, FillsSlots) {
  const Grammar grammar = Grammar::parse(kCommands, "commands.jsgf");
  EXPECT_EQ(slots_of(grammar, {"go", "forward", "three", "steps"}),
            (Slots{{"direction", "ahead"}, {"steps", "three"}}));
  EXPECT_EQ(slots_of(grammar, {"please", "go", "back"}), (Slots{{"direction", "back"}}));
  EXPECT_EQ(slots_of(grammar, {"raise", "the", "left", "hand"}),
            (Slots{{"side", "left"}, {"action", "raise"}}));
  EXPECT_FALSE(grammar.slots_of({"go"}));
  EXPECT_FALSE(grammar.slots_of({"go", "forward", "three"}));
  EXPECT_FALSE(grammar.slots_of({}));
  EXPECT_EQ(grammar.words().front(), "back");
  EXPECT_EQ(grammar.words().size(), 14U);
}

TEST(Grammar, ReadsWhatJsgfHas) {
  const auto grammar = Grammar::parse(
      kHead + "public <s> = ( /3/ a | /1/ \"b\" )+ {all} [<NULL>] c* {c} | \\{ d;", "file");
  EXPECT_EQ(slots_of(grammar, {"a", "b", "a"}), (Slots{{"all", "a b a"}, {"c", ""}}));
  EXPECT_EQ(slots_of(grammar, {"b", "c", "c"}), (Slots{{"all", "b"}, {"c", "c c"}}));
  EXPECT_TRUE(grammar.slots_of({"{", "d"}));
  // A label may be of several words.
  const auto blanks =
      Grammar::parse(kHead + "public <s> = \" New York \" {to=\"the city\"};", "file");
  EXPECT_EQ(blanks.words(), (std::vector<std::string>{"New York"}));
  EXPECT_EQ(slots_of(blanks, {"New York"}), (Slots{{"to", "the city"}}));
  // Of several readings the first counts.
  const auto twice = Grammar::parse(kHead + "public <s> = a {first=1} | a {second=2};", "file");
  EXPECT_EQ(slots_of(twice, {"a"}), (Slots{{"first", "1"}}));
  const auto two = Grammar::parse(kHead + "public <x> = a; public <y> = <z> b; <z> = c;", "file");
  EXPECT_TRUE(two.slots_of({"a"}));
  EXPECT_TRUE(two.slots_of({"c", "b"}));
  EXPECT_FALSE(two.slots_of({"c"}));
}

TEST(Grammar, ListsItsSentences) {
  const Grammar grammar = Grammar::parse(kCommands, "commands.jsgf");
  const auto sentences = grammar.sentences();
  ASSERT_EQ(sentences.size(), 32U);  // [please], and 2 x (1 + 3 x 2) ways to walk or 2 hands
  EXPECT_EQ(sentences.front(),
            (std::vector<std::string>{"please", "go", "forward", "one", "step"}));
  EXPECT_EQ(sentences.back(), (std::vector<std::string>{"raise", "the", "right", "hand"}));
  for (const auto& sentence : sentences) EXPECT_TRUE(grammar.slots_of(sentence));
  EXPECT_THROW((void)grammar.sentences(31), InvalidArgument);
  EXPECT_EQ(Grammar::parse(kHead + "public <s> = a | [b] a | b a;", "file").sentences().size(), 2U);
  for (const std::string endless : {"a+", "[a] b*"}) {
    EXPECT_THROW((void)Grammar::parse(kHead + "public <s> = " + endless + ";", "f").sentences(),
                 InvalidArgument);
  }
  std::string options;
  for (int i = 0; i < 40; ++i) options += "[<NULL>] ";
  EXPECT_THROW((void)Grammar::parse(kHead + "public <s> = a " + options + ";", "f").sentences(),
               InvalidArgument);
}

// Rules that double: <r12> has 4096 words, <r14> 16384.
TEST(Grammar, ListsNoSentenceThatItDoesNotTake) {
  std::string rules = "<r0> = a;";
  for (int i = 1; i <= 14; ++i) {
    const std::string inner = "<r" + std::to_string(i - 1) + ">";
    rules += "<r" + std::to_string(i) + "> = " + inner + " " + inner + ";";
  }
  const auto listed = [&rules](const std::string& sentence) {
    return Grammar::parse(kHead + rules + "public <s> = " + sentence + ";", "f");
  };
  const Grammar long_ones = listed("<r12> ( a | b )");
  ASSERT_EQ(long_ones.sentences().size(), 2U);
  for (const auto& sentence : long_ones.sentences()) EXPECT_TRUE(long_ones.slots_of(sentence));
  EXPECT_THROW((void)listed("<r14>").sentences(), InvalidArgument);
  // Ten bits behind 4096 words: too many words in all.
  std::string bits;
  for (int i = 0; i < 10; ++i) bits += "( a | b ) ";
  EXPECT_EQ(listed(bits).sentences().size(), 1024U);
  EXPECT_THROW((void)listed("<r12> " + bits).sentences(), InvalidArgument);
}

TEST(Grammar, RefusesWhatGrowsBeyondBounds) {
  std::string tags = "public <s> = a ";
  for (int i = 0; i < 100000; ++i) tags += "{t}";
  EXPECT_EQ(refusal(tags + ";"),
            "file: line 3: rules, tags and repetitions stand in each other too deep");
  std::string rules = "<r0> = a;";
  for (int i = 1; i < 3000; ++i)
    rules += "<r" + std::to_string(i) + "> = [<r" + std::to_string(i - 1) + ">];";
  EXPECT_NE(refusal(rules + "public <s> = <r2999>;").find("too deep"), std::string::npos);
  std::string copies = "<c0> = a {slot=" + std::string(3000, 'v') + "};";
  for (int i = 1; i < 6; ++i) {
    const std::string inner = "<c" + std::to_string(i - 1) + "> ";
    copies += "<c" + std::to_string(i) + "> =";
    for (int k = 0; k < 9; ++k) copies += " " + inner;
    copies += ";";
  }
  EXPECT_EQ(refusal(copies + "public <s> = <c5>;"),
            "file: line 3: the grammar is too large where its rules are written out");
}

TEST(Grammar, MakesANetworkOfItsSentencesAlone) {
  using namespace testing_data;
  const Grammar grammar = Grammar::parse(kHead + "public <s> = ( /3/ a b | /1/ b a );", "file");
  std::vector<WordChain> chains;
  for (int m = 0; m < 3; ++m) chains.push_back(random_chain(1, 1, 1, m == 2));
  // Frames that sound like "a a": the nearest sentence begins with a.
  MatrixF scores = MatrixF::Constant(4, 3, -5);
  scores.col(0).setConstant(0);
  ConnectedDecoder decoder(chains, grammar.network({"a", "b"}, 2));
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  const DecodedSentence found = decoder.finish();
  ASSERT_TRUE(found.complete);
  ASSERT_EQ(found.words.size(), 2U);
  EXPECT_EQ(found.words[0].model, 0);
  EXPECT_EQ(found.words[1].model, 1);
  // The weight of the alternative is in the score.
  ConnectedDecoder plain(chains, WordNetwork::transcript({0, 1}, 2));
  for (Eigen::Index t = 0; t < scores.rows(); ++t) plain.push(row_span(scores, t));
  EXPECT_NEAR(found.log_score, plain.finish().log_score + std::log(0.75), 1e-9);
  EXPECT_THROW((void)grammar.network({"a"}), InvalidArgument);
}

// JSGF: "a zero weight indicates that the expansion is never spoken".
TEST(Grammar, NeverTakesAlternativesOfWeightZero) {
  using namespace testing_data;
  const std::string rest = " b {kind=rest} | /1/ c ) | /0.0/ ( e | f );";
  const Grammar grammar =
      Grammar::parse(kHead + "public <s> = /2/ ( /3/ a {kind=first} | /0/ x | /0/" + rest, "file");
  EXPECT_EQ(grammar.words(), (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(grammar.sentences(), (std::vector<std::vector<std::string>>{{"a"}, {"c"}}));
  EXPECT_EQ(slots_of(grammar, {"a"}), (Slots{{"kind", "first"}}));
  for (const char* never : {"x", "b", "e", "f"}) EXPECT_FALSE(grammar.slots_of({never})) << never;
  // Nothing that is never said can be empty, and be repeated for ever.
  const Grammar repeated = Grammar::parse(kHead + "public <s> = ( /0/ <NULL> | /1/ a )+;", "file");
  EXPECT_FALSE(repeated.slots_of({}));
  EXPECT_TRUE(repeated.slots_of({"a", "a"}));
  // The others share the weight among them: 3/4 and 1/4.
  std::vector<WordChain> chains;
  for (int m = 0; m < 2; ++m) chains.push_back(random_chain(1, 1, 1, false));
  for (const int said : {0, 1}) {
    MatrixF scores = MatrixF::Constant(3, 2, -50);
    scores.col(said).setConstant(0);
    ConnectedDecoder decoder(chains, grammar.network({"a", "c"}));
    ConnectedDecoder plain(chains, WordNetwork::transcript({said}));
    for (Eigen::Index t = 0; t < scores.rows(); ++t) {
      decoder.push(row_span(scores, t));
      plain.push(row_span(scores, t));
    }
    const DecodedSentence found = decoder.finish();
    ASSERT_EQ(found.words.size(), 1U);
    EXPECT_EQ(found.words[0].model, said);
    EXPECT_NEAR(found.log_score, plain.finish().log_score + std::log(said == 0 ? 0.75 : 0.25),
                1e-9);
  }
}

TEST(Grammar, AllowsSilenceAndUnknownSentences) {
  using namespace testing_data;
  const Grammar grammar = Grammar::parse(kHead + "public <s> = a b;", "file");
  std::vector<WordChain> chains;
  for (int m = 0; m < 4; ++m) chains.push_back(random_chain(1, 1, 1, m == 2));
  const auto decode = [&](const std::vector<int>& best) {
    ConnectedDecoder decoder(chains, grammar.network({"a", "b"}, 2, 3));
    for (const int model : best) {
      std::vector<float> frame(4, -50);
      frame[static_cast<std::size_t>(model)] = 0;
      decoder.push(frame);
    }
    std::vector<int> models;
    for (const DecodedWord& word : decoder.finish().words) models.push_back(word.model);
    return models;
  };
  EXPECT_EQ(decode({2, 2, 0, 2, 1, 2}), (std::vector<int>{2, 0, 2, 1, 2}));
  EXPECT_EQ(decode({3, 3, 2, 3}).back(), 3);
}

TEST(Grammar, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_EQ(refusal("public <a> = b\n<c>;"), "file: line 4: <c> is not defined");
  EXPECT_EQ(refusal("public <a> = b <c>;\n<c> = d\n<a>;"), "file: line 5: <a> holds itself");
  EXPECT_EQ(refusal("<a> = b;"), "file: line 3: no rule is public");
  EXPECT_EQ(refusal("public <a> = [b]*;"),
            "file: line 3: what is repeated here may be empty: a cycle without words");
  EXPECT_EQ(refusal("import <other.*>;"), "file: line 3: imports are not read");
  EXPECT_EQ(refusal("public <a> = ( b;"), "file: line 3: a bracket of line 3 is not closed");
  EXPECT_EQ(refusal("public <a> = b );"), "file: line 3: a bracket is closed that was not opened");
  EXPECT_EQ(refusal("public <a> = b"), "file: line 3: <a> does not end with ;");
  EXPECT_EQ(refusal("public <a> = b; public <a> = c;"), "file: line 3: <a> is defined twice");
  EXPECT_EQ(refusal("public <a> = b {=c};"),
            "file: line 3: a tag is {slot} or {slot=value}, a slot letters, digits and _");
  EXPECT_EQ(refusal("public <a> = b {c=};"), "file: line 3: the tag of slot 'c' has no value");
  EXPECT_EQ(refusal("public <a> = /x/ b | /1/ c;"),
            "file: line 3: a weight must be a number from 0 to 1e12");
  EXPECT_EQ(refusal("public <a> = /-1/ b | /1/ c;"),
            "file: line 3: a weight must be a number from 0 to 1e12");
  EXPECT_EQ(refusal("public <a> = /0/ b | /0.0/ c;"),
            "file: line 3: one of the alternatives must have a weight above 0");
  EXPECT_EQ(refusal("public <a> = /1/ b | c;"),
            "file: line 3: all alternatives have a weight, or none");
  EXPECT_EQ(refusal("public <a> = b \"c;"), "file: line 3: a quotation does not end");
  EXPECT_EQ(refusal("public <a> = b \" \";"), "file: line 3: '' is empty");
  EXPECT_EQ(refusal("public <a> = | b;"), "file: line 3: expected a word, a <rule> or a bracket");
  EXPECT_EQ(refusal("public <NULL> = b;"), "file: line 3: <NULL> cannot be defined");
  EXPECT_EQ(refusal("public <a> = > b;"), "file: line 3: '>' has no meaning here");
  EXPECT_EQ(refusal("public <a> = b <VOID>;"), "file: line 3: <VOID> is not read");
  EXPECT_EQ(refusal("// \xff\npublic <a> = b;"), "file: line 3: is not UTF-8 text");
  EXPECT_EQ(refusal("public <a> = b\n{c=\xff};"), "file: line 4: is not UTF-8 text");
  EXPECT_EQ(refusal(std::string("public <a> = b {c=\0d};", 22)), "file: line 3: is not UTF-8 text");
  EXPECT_THROW(Grammar::parse("", "file"), FormatError);
  EXPECT_THROW(Grammar::parse("#JSGF V1.0;", "file"), FormatError);
  EXPECT_THROW(Grammar::parse("#JSGF V1.0;\ngrammar a", "file"), FormatError);
  EXPECT_THROW(Grammar::load("/no/such/file"), IoError);
}

TEST(Grammar, BoundsWhatItIsGiven) {
  EXPECT_NE(refusal("public <a> = " + std::string(10000, '(') + "b" + std::string(10000, ')') + ";")
                .find("too deep"),
            std::string::npos);
  // Every rule holds that before it twice.
  std::string doubling = "<r0> = a b;\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "<r" + std::to_string(i - 1) + ">";
    doubling += "<r" + std::to_string(i) + "> = " + before + " " + before + ";\n";
  }
  EXPECT_EQ(refusal(doubling + "public <s> = <r39>;"),
            "file: line 22: the grammar has more than a million nodes");
}

}  // namespace
}  // namespace hri
