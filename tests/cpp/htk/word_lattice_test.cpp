// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/word_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

using Words = std::vector<std::string>;

// All sentences of at most `most` words.
std::set<Words> sentences(const WordLattice& lattice, std::size_t most) {
  std::set<Words> found;
  std::set<std::pair<int, Words>> seen;
  std::function<void(int, Words)> walk = [&](int node, Words words) {
    const std::string& word = lattice.words[static_cast<std::size_t>(node)];
    if (word != WordLattice::kNull) words.push_back(word);
    if (words.size() > most || !seen.insert({node, words}).second) return;
    if (node == lattice.last()) found.insert(words);
    for (const WordLattice::Arc& arc : lattice.arcs) {
      if (arc.from == node) walk(arc.to, words);
    }
  };
  walk(lattice.first(), {});
  return found;
}

std::set<Words> of_grammar(const std::string& text, std::size_t most = 3) {
  return sentences(WordLattice::of_grammar(text, "grammar"), most);
}

template <class Read>
std::string refusal_of_lattice(const std::string& text, Read read) {
  try {
    read(text, "file");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}
std::string grammar_refusal(const std::string& text) {
  return refusal_of_lattice(text, WordLattice::of_grammar);
}
std::string lattice_refusal(const std::string& text) {
  return refusal_of_lattice(text, WordLattice::parse);
}

TEST(WordLattice, HoldsLatticesOfRecognition) {
  const Lattice lattice(
      {{-1, 0, false}, {0, 3, false}, {1, 4, false}, {2, 7, true}, {-1, 7, false}},
      {{0, 1, -3.25, -0.5}, {0, 2, -4, 0}, {1, 3, -1, 0}, {2, 3, -2, 0}, {3, 4}});
  const std::vector<std::string> labels{"one", "two", "sil"};
  const WordLattice written = WordLattice::of_lattice(lattice, labels, 0.05, 0.01);
  const WordLattice file = WordLattice::parse(written.to_text(), "file");
  EXPECT_EQ(file.to_text(), written.to_text());
  EXPECT_NE(file.to_text().find("I=1    t=0.08  W=one\n"), std::string::npos) << file.to_text();
  EXPECT_NE(file.to_text().find("J=0     S=0    E=1 a=-3.25 l=-0.5\n"), std::string::npos);
  const Lattice back = file.to_lattice(labels, {"sil"}, 0.05, 0.01);
  const std::vector<DecodedSentence> expected = lattice.n_best(5);
  const std::vector<DecodedSentence> found = back.n_best(5);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].log_score, expected[i].log_score);
    ASSERT_EQ(found[i].words.size(), 2U);
    EXPECT_EQ(found[i].words[0].model, expected[i].words[0].model);
    EXPECT_EQ(found[i].words[0].last_frame, expected[i].words[0].last_frame);
  }
  EXPECT_THROW((void)file.to_lattice({"one", "two"}, {}, 0.05, 0.01), InvalidArgument);
  EXPECT_THROW((void)file.to_lattice(labels, {}, 5, 0.01), InvalidArgument);
  EXPECT_THROW((void)WordLattice::of_words({"one"}).to_lattice(labels, {}, 0, 0.01),
               InvalidArgument);
  EXPECT_THROW((void)WordLattice::of_lattice(lattice, {"one"}, 0, 0.01), InvalidArgument);
  EXPECT_TRUE(
      WordLattice::parse("N=2 L=1\nI=0 t=0\nI=1 W=a\nJ=0 S=0 E=1\n", "file").times_s.empty());
}

// Words begin behind a node of their own, whose arcs hold weight and penalty, or at once.
TEST(WordLattice, TakesScaleAndPenaltyOutOfWeights) {
  const double half = std::log(0.5);
  const Lattice lattice({{-1, 0, false},
                         {-1, 0, false},
                         {0, 3, false},
                         {-1, 3, false},
                         {1, 4, false},
                         {2, 7, true},
                         {-1, 7, false}},
                        {{0, 1, 0, 8 * half - 10},
                         {1, 2, -3, 0},
                         {2, 3, 0, -10},
                         {3, 4, -1, 0},
                         {0, 4, -5, 8 * half - 10},
                         {4, 5, -2, 4 * half},
                         {5, 6, 0, 2}});
  const std::vector<std::string> labels{"one", "two", "sil"};
  const WordLattice written = WordLattice::of_lattice(lattice, labels, 0, 0.01, 4, -10);
  const WordLattice file = WordLattice::parse(written.to_text(), "file");
  EXPECT_NE(file.to_text().find("\nlmscale=4 wdpenalty=-10\n"), std::string::npos);
  EXPECT_EQ(file.language_scale, 4);
  EXPECT_EQ(file.insertion_penalty, -10);
  ASSERT_EQ(file.arcs.size(), 7U);
  for (const WordLattice::Arc& arc : file.arcs) {
    double expected = 0;
    if (arc.from == 0) expected = 2 * half;
    if (arc.from == 4) expected = half;
    if (arc.from == 5) expected = 0.5;
    EXPECT_NEAR(arc.log_weight, expected, 1e-12) << arc.from << " " << arc.to;
  }
  const Lattice back = file.to_lattice(labels, {"sil"}, 0, 0.01);
  ASSERT_EQ(back.arcs().size(), lattice.arcs().size());
  for (std::size_t a = 0; a < back.arcs().size(); ++a)
    EXPECT_NEAR(back.arcs()[a].log_weight, lattice.arcs()[a].log_weight, 1e-12) << a;
  const WordLattice bare = WordLattice::of_lattice(lattice, labels, 0, 0.01, 0, -10);
  for (const WordLattice::Arc& arc : bare.arcs) EXPECT_EQ(arc.log_weight, 0);
  EXPECT_THROW((void)WordLattice::of_lattice(lattice, labels, 0, 0.01, -1, 0), InvalidArgument);
  const WordLattice tens = WordLattice::parse(
      "base=10 lmscale=2.50 wdpenalty=-1.00\nN=2 L=1\nI=0\nI=1 W=a\nJ=0 S=0 E=1\n", "file");
  EXPECT_EQ(tens.language_scale, 2.5);
  EXPECT_NEAR(tens.insertion_penalty, -std::log(10.0), 1e-12);
}

TEST(WordLattice, HoldsTheSentencesOfAGrammar) {
  EXPECT_EQ(of_grammar("( go | stop )"), (std::set<Words>{{"go"}, {"stop"}}));
  EXPECT_EQ(of_grammar("( go [ left | right ] )"),
            (std::set<Words>{{"go"}, {"go", "left"}, {"go", "right"}}));
  EXPECT_EQ(of_grammar("( a { b } )"), (std::set<Words>{{"a"}, {"a", "b"}, {"a", "b", "b"}}));
  EXPECT_EQ(of_grammar("( < a | b > )", 2),
            (std::set<Words>{{"a"}, {"b"}, {"a", "a"}, {"a", "b"}, {"b", "a"}, {"b", "b"}}));
  EXPECT_EQ(
      of_grammar("$digit = one | two; /* digits */\n/* a\nsentence */\n$two = $digit $digit;\n"
                 "( \"sil\" $two | ( $digit ) )"),
      (std::set<Words>{{"one"},
                       {"two"},
                       {"sil", "one", "one"},
                       {"sil", "one", "two"},
                       {"sil", "two", "one"},
                       {"sil", "two", "two"}}));
  EXPECT_EQ(of_grammar("( { a } { b } )", 1), (std::set<Words>{{}, {"a"}, {"b"}}));
}

TEST(WordLattice, EndsNamesOfGrammarsAtComments) {
  EXPECT_EQ(of_grammar("$a/* one */=yes/* two\n*//**/|no/**/;(/**/$a/*three*/)"),
            (std::set<Words>{{"yes"}, {"no"}}));
  EXPECT_EQ(of_grammar("( yes #no | a/b\n | # | \"/*\" )"),
            (std::set<Words>{{"yes", "#no"}, {"a/b"}, {"#"}, {"/*"}}));
  EXPECT_EQ(grammar_refusal("( yes/* no )"), "file: line 1: a comment does not end");
}

TEST(WordLattice, RefusesOutputsInGrammars) {
  const std::string outputs =
      ": outputs of words behind % are not read, the dictionary has them in [ ]; a % that is part "
      "of a name needs a backslash";
  for (const char* name : {"yes%YES", "sil%%", "yes%", "%", "$a%b", "yes%\\377"})
    EXPECT_EQ(grammar_refusal("( no |\n" + std::string(name) + " )"),
              "file: line 2: '" + std::string(name) + "'" + outputs);
  EXPECT_EQ(grammar_refusal("( \"yes\"%YES )"), "file: line 1: '%YES'" + outputs);
  for (const char* name : {"WD_BEGIN", "WD_END"}) {
    for (const char* behind : {"%A", "% A", "%%"})
      EXPECT_EQ(grammar_refusal("(\n" + std::string(name) + behind + " )"),
                "file: line 2: " + std::string(name) + "% is not read");
  }
  EXPECT_EQ(of_grammar("( 50\\% | \"a%b\" )"), (std::set<Words>{{"50%"}, {"a%b"}}));
}

TEST(WordLattice, RefusesGrammarsByNameAndLine) {
  EXPECT_EQ(grammar_refusal(""),
            "file: line 1: expected a definition of a $name, or the sentence in ( )");
  EXPECT_EQ(grammar_refusal("$a = b | $a;\n( $a )"), "file: line 1: '$a' is not defined above");
  EXPECT_EQ(grammar_refusal("$a = x $b;\n$b = y [ $a ];\n( $a )"),
            "file: line 1: '$b' is not defined above");
  EXPECT_EQ(grammar_refusal("$a = b;\n$a = c;\n( $a )"), "file: line 2: '$a' is defined twice");
  EXPECT_EQ(grammar_refusal("( a\n"), "file: line 2: expected )");
  EXPECT_EQ(grammar_refusal("( a ) b"), "file: line 1: nothing stands behind the sentence");
  EXPECT_EQ(grammar_refusal("( a | )"), "file: line 1: expected a word, a $name or a bracket");
  EXPECT_EQ(grammar_refusal("(\n{ [ a ] } )"),
            "file: line 2: what is repeated here may be empty: a cycle without words");
  EXPECT_EQ(grammar_refusal("( << a >> )"), "file: line 1: loops << >> in context are not read");
  EXPECT_EQ(grammar_refusal("( a /* b )"), "file: line 1: a comment does not end");
  EXPECT_EQ(grammar_refusal("( \"a )"), "file: line 1: a quotation does not end");
  // What stands behind a backslash is taken as it is, the end of a line and bytes among it.
  EXPECT_EQ(grammar_refusal("( a |\nb\\\nc )"),
            "file: line 2: a name is not UTF-8 text of one line");
  EXPECT_EQ(grammar_refusal("\n( \"\\377\" )"),
            "file: line 2: a name is not UTF-8 text of one line");
  EXPECT_EQ(grammar_refusal("( \"\" )"), "file: line 1: a name is empty");
  EXPECT_EQ(grammar_refusal(std::string(100000, '(')),
            "file: line 1: brackets stand in brackets, too deep");
  std::string doubling = "$a0 = a;\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "$a" + std::to_string(i - 1);
    doubling += "$a" + std::to_string(i) + " = " + before + " " + before + ";\n";
  }
  EXPECT_EQ(grammar_refusal(doubling + "( $a39 )"),
            "file: line 21: the grammar has more than a million nodes");
}

TEST(WordLattice, IsReadAsItWasWritten) {
  WordLattice lattice = WordLattice::of_grammar("$d = one | two; ( sil { $d } sil )", "grammar");
  lattice.arcs[1].log_weight = -1.0 / 3;
  for (const char* word : {"a=b", "two words", "x\"y", "b\\c", "=", "#", "\"="}) {
    lattice.words[1] = word;
    const std::string text = lattice.to_text();
    const WordLattice read = WordLattice::parse(text, "again");
    EXPECT_EQ(read.to_text(), text);
    EXPECT_EQ(read.words, lattice.words);
    EXPECT_EQ(read.arcs[1].log_weight, lattice.arcs[1].log_weight);
  }
}

TEST(WordLattice, ReadsFilesOfOtherPrograms) {
  const WordLattice lattice = WordLattice::parse(
      "VERSION=1.0\r\n# by HParse\nlmscale=1.0 base=10\nN=4    L=4\nI=0    W=!NULL\nI=3\n"
      "I=1 t=0.25 W=one v=1\nI=2    W=\"two\"\nJ=0 S=0 E=1 l=-1\nJ=1     START=0 END=2 a=-5\n"
      "J=2 S=1 E=3\nJ=3 S=2 E=3\n",
      "other.slf");
  EXPECT_EQ(lattice.words, (Words{"!NULL", "one", "two", "!NULL"}));
  EXPECT_EQ(lattice.first(), 0);
  EXPECT_EQ(lattice.last(), 3);
  EXPECT_NEAR(lattice.arcs[0].log_weight, -2.302585092994046, 1e-12);
}

// Line ends, comments, fields that nothing is made of, nodes and arcs in any order, numbers as they
// were written, words on arcs, and no end of the last line.
const std::vector<std::string>& foreign_lattices() {
  static const std::vector<std::string> texts{
      "VERSION=1.0\r\nUTTERANCE=s1.mfc\r\n# by another program\r\nlmname=bg lmscale=14.00 "
      "wdpenalty=-0.00\r\nvocab=dict\r\nN=4    L=3   \r\nI=3    t=1.50\r\n\r\nI=1    t=0.250 W=one"
      "  v=1\r\nI=0    t=0.00  W=!NULL\r\nI=2    t=0.70  W=\"two\" v=2\r\n# arcs\r\nJ=2     S=2    "
      "E=3    a=-10.50   l=-1.00\r\nJ=0     S=0    E=1    a=-1e+3 l=0.000 r=0.00\r\nJ=1 S=1 E=2 "
      "p=0.5 l=-2\r\n",
      "VERSION=1.0\nbase=10\nNODES=2 LINKS=2\nI=0\nI=1 time=0.30\nJ=0 START=0 END=1 WORD=a "
      "acoustic=-5.0\nJ=1 START=0 END=1 WORD=b  \t",
      "start=0 end=1\nN=2 L=2\nI=0 W=a\nI=1 W=b\nJ=0 S=0 E=1\nJ=1 S=1 E=0\n\n\n"};
  return texts;
}

TEST(WordLattice, WritesFilesOfOtherProgramsByteForByte) {
  for (const std::string& text : foreign_lattices()) {
    const WordLattice read = WordLattice::parse(text, "other.slf");
    EXPECT_EQ(read.to_text(), text);
    const WordLattice copy = read;
    EXPECT_EQ(copy.to_text(), text);
    const std::string path = testing::TempDir() + "hri_other.slf";
    read.write(path);
    EXPECT_EQ(WordLattice::read(path).to_text(), text);
  }
}

TEST(WordLattice, WritesWhatWasChangedInItsOwnForm) {
  using Change = std::function<void(WordLattice&)>;
  const std::vector<Change> changes{
      [](WordLattice& l) { l.words[1] = "other"; },
      [](WordLattice& l) { l.arcs[0].log_weight -= 1; },
      [](WordLattice& l) { l.arcs[1].log_acoustic = -7; },
      [](WordLattice& l) { l.arcs.push_back(l.arcs[0]); },
      [](WordLattice& l) { l.language_scale += 1; },
      [](WordLattice& l) { l.insertion_penalty -= 1; },
      [](WordLattice& l) { l.times_s.assign(l.words.size(), 0.5); },
      [](WordLattice& l) { l.variants.assign(l.words.size(), 3); },
      [](WordLattice& l) { l.start = l.start == WordLattice::kByArcs ? l.first() : l.last(); },
  };
  for (const std::string& text : foreign_lattices()) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      WordLattice changed = WordLattice::parse(text, "other.slf");
      const WordLattice before = changed;
      changes[i](changed);
      const std::string written = changed.to_text();
      EXPECT_EQ(written.substr(0, 12), "VERSION=1.0\n") << i;
      EXPECT_EQ(written.find('#'), std::string::npos) << i;
      EXPECT_EQ(written.find('\r'), std::string::npos) << i;
      const WordLattice again = WordLattice::parse(written, "again");
      EXPECT_EQ(again.words, changed.words);
      EXPECT_EQ(again.start, changed.start);
      ASSERT_EQ(again.arcs.size(), changed.arcs.size());
      EXPECT_EQ(again.arcs[0].log_weight, changed.arcs[0].log_weight);
      EXPECT_EQ(again.arcs[1].log_acoustic, changed.arcs[1].log_acoustic);
      EXPECT_EQ(again.language_scale, changed.language_scale);
      // As it was before, it is written as it was read.
      changed.words = before.words;
      changed.arcs = before.arcs;
      changed.language_scale = before.language_scale;
      changed.insertion_penalty = before.insertion_penalty;
      changed.times_s = before.times_s;
      changed.variants = before.variants;
      changed.start = before.start;
      changed.end = before.end;
      EXPECT_EQ(changed.to_text(), text) << i;
    }
  }
  WordLattice broken = WordLattice::parse(foreign_lattices()[0], "other.slf");
  broken.arcs[0].to = 99;
  EXPECT_THROW((void)broken.to_text(), InvalidArgument);
}

TEST(WordLattice, ReadsLongNamesOfFields) {
  const WordLattice by_nodes = WordLattice::parse(
      "VERSION=1.0\nNODES=3 LINKS=2\nI=0 time=0\nI=1 time=0.5 WORD=one var=2\nI=2 time=1\n"
      "J=0 START=0 END=1 acoustic=-9 language=-1.5\nJ=1 START=1 END=2\n",
      "long.slf");
  EXPECT_EQ(by_nodes.times_s, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(by_nodes.variants, (std::vector<int>{0, 2, 0}));
  EXPECT_EQ(by_nodes.arcs[0].log_acoustic, -9);
  EXPECT_EQ(by_nodes.words[1], "one");
  EXPECT_EQ(by_nodes.arcs[0].log_weight, -1.5);
  const WordLattice by_arcs = WordLattice::parse(
      "NODES=2 LINKS=1\nI=0\nI=1\nJ=0 START=0 END=1 WORD=two var=3 language=-2\n", "long.slf");
  EXPECT_EQ(by_arcs.words[2], "two");
  EXPECT_EQ(by_arcs.variants[2], 3);
  EXPECT_EQ(by_arcs.arcs[0].log_weight, -2);
}

TEST(WordLattice, ReadsWordsOnArcsAndEndsThatAreNamed) {
  const WordLattice lattice = WordLattice::parse(
      "VERSION=1.0\nstart=0 end=2\nN=3 L=4\nI=0 t=0\nI=1 t=0.5\nI=2 t=1\nJ=0 S=0 E=1 W=one l=-1 "
      "a=-9\nJ=1 S=1 E=2 W=two v=2\nJ=2 S=1 E=2 W=!NULL\nJ=3 S=1 E=0 W=again\n",
      "other.slf");
  EXPECT_EQ(sentences(lattice, 2), (std::set<Words>{{"one"}, {"one", "two"}}));
  EXPECT_EQ(lattice.words[3], "one");
  EXPECT_EQ(lattice.times_s[3], 0.5);
  EXPECT_EQ(lattice.arcs[0].log_weight, -1);
  EXPECT_EQ(lattice.arcs[0].log_acoustic, -9);
  EXPECT_EQ(lattice.variants, (std::vector<int>{0, 0, 0, 0, 2, 0}));
  EXPECT_EQ(lattice.lines, (std::vector<std::int64_t>{4, 5, 6, 7, 8, 10}));
  const WordLattice again = WordLattice::parse(lattice.to_text(), "again");
  EXPECT_EQ(again.to_text(), lattice.to_text());
  EXPECT_EQ(sentences(again, 3), sentences(lattice, 3));
}

// The log probability of the best path that says a sentence.
double best_score(const WordLattice& lattice, const Words& sentence) {
  std::function<double(int, std::size_t)> walk = [&](int node, std::size_t said) {
    const std::string& word = lattice.words[static_cast<std::size_t>(node)];
    if (word != WordLattice::kNull) {
      if (said >= sentence.size() || sentence[said] != word) return -1e9;
      ++said;
    }
    if (node == lattice.last()) return said == sentence.size() ? 0 : -1e9;
    double best = -1e9;
    for (const WordLattice::Arc& arc : lattice.arcs) {
      if (arc.from == node) best = std::max(best, arc.log_weight + walk(arc.to, said));
    }
    return best;
  };
  return walk(lattice.first(), 0);
}

TEST(WordLattice, WeighsSentencesAsTheBigramDoes) {
  const NGramModel language =
      NGramModel::train({{"go", "left"}, {"go", "right"}, {"stop"}, {"go", "left"}}, {}, {"never"});
  const WordLattice lattice =
      WordLattice::of_bigram(language, {"go", "left", "right", "stop", "never"});
  EXPECT_EQ(lattice.fault(), "");
  for (const Words& sentence :
       {Words{"go", "left"}, Words{"stop"}, Words{"left", "never", "go"}, Words{}}) {
    const NGramFit fit = language.fit_of({sentence});
    const double found = best_score(lattice, sentence);
    // Backing off may weigh more than the bigram that there is: the better way counts.
    EXPECT_GE(found, fit.log_probability - 1e-9);
    EXPECT_NEAR(found, fit.log_probability, 0.7);
  }
  EXPECT_NEAR(best_score(lattice, {"go", "left"}),
              language.fit_of({{"go", "left"}}).log_probability, 1e-9);
  EXPECT_THROW((void)WordLattice::of_bigram(language, {"jump"}), InvalidArgument);
  EXPECT_THROW((void)WordLattice::of_bigram(language, {"go", "go"}), InvalidArgument);
  EXPECT_THROW((void)WordLattice::of_bigram(language, {"<s>"}), InvalidArgument);
  EXPECT_THROW((void)WordLattice::of_bigram(language, {}), InvalidArgument);
  NGramOptions trigram;
  trigram.order = 3;
  EXPECT_THROW((void)WordLattice::of_bigram(NGramModel::train({{"a"}}, trigram), {"a"}),
               InvalidArgument);
}

TEST(WordLattice, RefusesDamagedFilesByNameAndLine) {
  const std::string good = "N=3 L=2\nI=0\nI=1 W=a\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n";
  EXPECT_EQ(lattice_refusal(good), "nothing thrown");
  EXPECT_EQ(lattice_refusal(""), "file: line 1: the lattice has no line with N= and L=");
  EXPECT_EQ(lattice_refusal("I=0\n"), "file: line 1: nodes and arcs stand behind N= and L=");
  EXPECT_EQ(lattice_refusal(good + "J=1 S=0 E=2\n"),
            "file: line 7: there are more arcs than L= says");
  EXPECT_EQ(lattice_refusal(good.substr(0, good.size() - 12)),
            "file: line 5: there are 1 arcs above, L= says 2");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nI=0\nI=1 W=a\nI=1 W=b\n"),
            "file: line 4: node 1 stands here again");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nI=3\n"), "file: line 2: '3' is no whole number in 0..2");
  EXPECT_EQ(lattice_refusal("N=99999999999 L=2\n"),
            "file: line 1: '99999999999' is no whole number in 1..10000000");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nI=0 W=\\377\n"),
            "file: line 2: a name is not UTF-8 text of one line");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nSUBLAT=x\n"),
            "file: line 2: lattices in lattices are not read");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nI=0 L=digits\n"),
            "file: line 2: lattices in lattices are not read");
  EXPECT_EQ(lattice_refusal("S=digits\nN=3 L=2\n"),
            "file: line 1: lattices in lattices are not read");
  EXPECT_EQ(lattice_refusal("N=3 L=2\nI=0 W=a WORD=b\n"),
            "file: line 2: the field W= stands here twice, by its long name too");
  EXPECT_EQ(lattice_refusal("N=2 L=1\nI=0\nI=1 W=b\nJ=0 S=0 E=1 W=a\n"),
            "file: line 4: there are words on nodes and on arcs");
  EXPECT_EQ(lattice_refusal("VERSION=1.0\nlmscale=x\n"),
            "file: line 2: 'x' is no number that can stand here");
  // What would not be read again where it is written, to the base e.
  for (const char* field : {"l", "a"})
    EXPECT_EQ(lattice_refusal("base=10\nN=2 L=1\nI=0\nI=1\nJ=0 S=0 E=1 " + std::string(field) +
                              "=-9e11\n"),
              "file: line 5: a log of this base is no number that can stand here");
  EXPECT_EQ(lattice_refusal("wdpenalty=9e11 base=10\nN=2 L=1\nI=0\nI=1\nJ=0 S=0 E=1\n"),
            "file: line 5: a log of this base is no number that can stand here");
  EXPECT_EQ(lattice_refusal("start=7\nN=2 L=1\nI=0\nI=1\nJ=0 S=0 E=1\n"),
            "file: line 5: start= or end= is no node");
  EXPECT_EQ(lattice_refusal("N=3 L=1\nI=0\nI=1\nI=2\nJ=0 S=0 E=1\n"),
            "file: line 5: not exactly one node is without predecessors, to begin sentences");
  EXPECT_EQ(lattice_refusal("N=4 L=5\nI=0\nI=1\nI=2\nI=3\nJ=0 S=0 E=1\nJ=1 S=1 E=2\nJ=2 S=2 E=1\n"
                            "J=3 S=2 E=3\nJ=4 S=0 E=3\n"),
            "file: line 10: nodes without words make a cycle");
}

}  // namespace
}  // namespace hri::htk
