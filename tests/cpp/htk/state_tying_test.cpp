// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// EditScript's commands on states of models in context.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/htk/edit_script.hpp"
#include "test_folder.hpp"

namespace hri::htk {
namespace {

struct ContextModel {
  std::string name;
  double mean;
  double frames;
};

// Of one state: near 0 after p and t, near 10 after other units, k-a+k a little apart.
const std::vector<ContextModel> kUnits{{"p-a+k", 0, 50},  {"t-a+k", 0.2, 30}, {"p-a+t", 0.1, 20},
                                       {"k-a+k", 12, 40}, {"k-a+t", 10, 25},  {"m-a+t", 10.5, 35}};
const std::string kContextQuestions =
    "QS \"L_stop\" { p-*,t-* }\nQS 'R_k' { \"*+k\" }\nQS \"L_k\" { \"k-*\" }\n";

ModelSet context_models() {
  std::string text = "~o <VECSIZE> 1 <USER>\n~t \"T_a\" <TRANSP> 3 0 1 0 0 0.5 0.5 0 0 0\n";
  for (const ContextModel& unit : kUnits)
    text += "~h \"" + unit.name + "\" <BEGINHMM> <NUMSTATES> 3 <STATE> 2 <MEAN> 1 " +
            std::to_string(unit.mean) + " <VARIANCE> 1 1.0 ~t \"T_a\" <ENDHMM>\n";
  ModelSet set;
  set.parse(text, "models");
  return set;
}

std::string context_statistics() {
  std::string text;
  for (const ContextModel& unit : kUnits)
    text += "1 \"" + unit.name + "\" 3 " + std::to_string(unit.frames) + "\n";
  return text;
}

class StateTying : public testing::Test {
 protected:
  [[nodiscard]] ModelSet edited(const std::string& script,
                                std::vector<EditedFile>* files = nullptr) const {
    ModelSet made =
        EditScript::parse("RO " + outliers_ + " \"" + statistics_ + "\"\n" + script, "script")
            .apply(context_models(), files);
    EXPECT_NO_THROW((void)made.to_text());
    return made;
  }
  [[nodiscard]] std::string refusal(const std::string& script) const {
    try {
      (void)edited(script);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "nothing thrown";
  }
  static std::string state_of(const ModelSet& set, const std::string& model) {
    return set.find('h', model)->hmm.states.front().macro;
  }

  TestFolder folder_;
  std::string statistics_ = folder_.write("statistics", context_statistics());
  std::string outliers_ = "10";
};

TEST_F(StateTying, TreesSplitByTheQuestionThatGainsMost) {
  const ModelSet set = edited(kContextQuestions + "TB 50 \"a2_\" {(*-a+*).state[2]}\n");
  EXPECT_EQ(state_of(set, "p-a+k"), state_of(set, "t-a+k"));
  EXPECT_EQ(state_of(set, "p-a+k"), state_of(set, "p-a+t"));
  EXPECT_EQ(state_of(set, "k-a+t"), state_of(set, "m-a+t"));
  EXPECT_NE(state_of(set, "p-a+k"), state_of(set, "k-a+t"));
  // The mean and variance of the frames: within states, and between them.
  const auto& gaussian = set.find('s', state_of(set, "p-a+k"))->state.components[0].component;
  const double mean = (0 * 50 + 0.2 * 30 + 0.1 * 20) / 100;
  EXPECT_NEAR(gaussian.mean.values[0], mean, 1e-6);
  EXPECT_NEAR(gaussian.variance.values[0], 1 + (0.04 * 30 + 0.01 * 20) / 100 - mean * mean, 1e-6);
}

TEST_F(StateTying, TheThresholdIsTheGainInLogLikelihood) {
  // 12 apart from 10 and 10.5: by hand, N/2 ln of the variance of all, less those of the parts.
  const auto log_likelihood = [](const std::vector<ContextModel>& units) {
    double frames = 0;
    double first = 0;
    double second = 0;
    for (const ContextModel& unit : units) {
      frames += unit.frames;
      first += unit.frames * unit.mean;
      second += unit.frames * (1 + unit.mean * unit.mean);
    }
    const double mean = first / frames;
    return -0.5 * frames * std::log(second / frames - mean * mean);
  };
  const double gain = log_likelihood({kUnits[3]}) + log_likelihood({kUnits[4], kUnits[5]}) -
                      log_likelihood({kUnits[3], kUnits[4], kUnits[5]});
  for (const double share : {0.99, 1.01}) {
    const ModelSet set =
        edited(kContextQuestions + "TB " + std::to_string(gain * share) + " a2_ {*.state[2]}");
    EXPECT_EQ(state_of(set, "k-a+k") != state_of(set, "k-a+t"), share < 1) << gain;
  }
}

TEST_F(StateTying, NoSideOfASplitHasFewerFramesThanRo) {
  outliers_ = "41";  // k-a+k has 40
  const ModelSet set = edited(kContextQuestions + "TB 1 a2_ {*.state[2]}");
  EXPECT_EQ(state_of(set, "k-a+k"), state_of(set, "k-a+t"));
  EXPECT_NE(state_of(set, "k-a+k"), state_of(set, "p-a+t"));
}

TEST_F(StateTying, LeavesThatAreAlikeAreMerged) {
  // R_k parts p-a+k and t-a+k from p-a+t first, for lack of others; then L_p splits, which says as
  // much as L_stop: what stands near 0 comes together again.
  const ModelSet set = edited("QS R_k { *+k }\nQS L_pt { p-*,t-* }\nTB 30 a2_ {*.state[2]}");
  EXPECT_EQ(state_of(set, "p-a+k"), state_of(set, "p-a+t"));
  EXPECT_EQ(state_of(set, "k-a+t"), state_of(set, "m-a+t"));
}

TEST_F(StateTying, ClustersGrowUpToADistance) {
  // Variances are 1: distances are those of means.
  for (const auto& [threshold, count] :
       {std::pair{0.05, 6}, {0.15, 5}, {0.25, 4}, {0.6, 3}, {2.1, 2}, {13.0, 1}}) {
    outliers_ = "0";
    const ModelSet set = edited("TC " + std::to_string(threshold) + " \"c\" {*.state[2]}");
    const auto is_state = [](const MacroDefinition& macro) { return macro.type == 's'; };
    EXPECT_EQ(std::count_if(set.macros.begin(), set.macros.end(), is_state), count) << threshold;
  }
  outliers_ = "60";
  const ModelSet set = edited("TC 0.6 c {*.state[2]}");
  EXPECT_EQ(state_of(set, "k-a+k"), state_of(set, "m-a+t"));
}

TEST_F(StateTying, UnseenModelsFollowTheTrees) {
  const std::string list = folder_.write("list", "p-a+k\nt-a+m\nk-a\nm-a+k\n");
  std::vector<EditedFile> files;
  const ModelSet set = edited(
      kContextQuestions + "TB 5 a2_ {*.state[2]}\nAU \"" + list + "\"\nCO \"tied\"\nST \"trees\"\n",
      &files);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].path, "tied");
  // Three models are left, of which all have the same transitions; t-a+m is one of those near 0.
  EXPECT_EQ(set.hmm_names().size(), 3u);
  const auto has = [&](const std::string& line) {
    return files[0].text.find(line) != std::string::npos;
  };
  EXPECT_TRUE(has("t-a+m p-a+k\n")) << files[0].text;
  EXPECT_TRUE(has("m-a+k k-a+k\n")) << files[0].text;
  EXPECT_EQ(std::count(files[0].text.begin(), files[0].text.end(), '\n'), 9);
  EXPECT_EQ(files[1].path, "trees");
  EXPECT_NE(files[1].text.find("a[2]\n{\n  0 'L_stop' -1 \"a2_"), std::string::npos)
      << files[1].text;

  // The trees of the file serve another script.
  const std::string trees = folder_.write("trees", files[1].text);
  (void)folder_.write("list", "t-a+p\n");
  const ModelSet later = EditScript::parse("LT " + trees + "\nAU " + list, "later").apply(set);
  EXPECT_EQ(state_of(later, "t-a+p"), state_of(set, "p-a+k"));
}

TEST_F(StateTying, ModelsThatShareAllAreOne) {
  std::vector<EditedFile> files;
  const ModelSet set = EditScript::parse("TI s {(p-a+k,p-a+t).state[2]}\nCO list", "script")
                           .apply(context_models(), &files);
  EXPECT_EQ(set.find('h', "p-a+t"), nullptr);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].text, "p-a+k\nt-a+k\np-a+t p-a+k\nk-a+k\nk-a+t\nm-a+t\n");
}

TEST_F(StateTying, RefusesWithFileAndLine) {
  const std::string tree = kContextQuestions + "TB 1 a2_ {*.state[2]}\n";
  EXPECT_EQ(refusal(kContextQuestions + "QS R_k { x }"),
            "script: line 5: the question 'R_k' is defined already");
  EXPECT_EQ(refusal(tree + "TB 1 a2_ {*.state[2]}"),
            "script: line 6: ~s \"a2_1\" is defined already");
  EXPECT_EQ(refusal(tree + "LT x"), "script: line 6: LT stands before all questions and trees");
  EXPECT_EQ(refusal("TB 1 x {*.transP}"),
            "script: line 2: TB and TC take items such as {(a,*-a+*).state[2]}");
  EXPECT_EQ(refusal("TB -1 x {*.state[2]}"), "script: line 2: a threshold is not negative");
  EXPECT_EQ(refusal("QS x p-*"), "script: line 2: expected {");
  EXPECT_EQ(refusal("QS x {}"), "script: line 2: expected a pattern");
  EXPECT_EQ(refusal("MU 2 {*.state[2].mix}\nTB 1 x {*.state[2]}"),
            "script: line 3: state 2 of 'p-a+k' is not of one Gaussian");
  const std::string list = folder_.write("list", "p-b+k\n");
  EXPECT_EQ(refusal(tree + "AU " + list),
            list + ": line 1: there is no model of the same unit: of 'b' and 'p-b+k'");
  (void)folder_.write("list", "m-a\n");
  EXPECT_EQ(refusal("AU " + list), list + ": line 1: there is no tree for state 2 of 'a'");
  (void)folder_.write("list", "a b\n");
  EXPECT_EQ(refusal(tree + "AU " + list), list + ": line 1: expected the name of a model");
  EXPECT_THROW((void)edited("AU /nowhere/at/all"), IoError);
}

TEST_F(StateTying, RefusesStatisticsThatDoNotFit) {
  EXPECT_THROW((void)EditScript::parse("TB 1 x {*.state[2]}", "s").apply(context_models()),
               FormatError);
  const std::string tree = "TB 1 x {*.state[2]}";
  for (const auto& [text, message] :
       {std::pair<const char*, const char*>{"1 \"p-a+k\" 3 50\n",
                                            "script: line 2: the statistics {} do not have state 2 "
                                            "of 't-a+k'"},
        {"1 p-a+k 3\n", "{}: line 1: expected number, name, occurrences and frames of states"},
        {"\n1 p-a+k 3 -1\n", "{}: line 2: a number of frames is below 0"},
        {"1 p-a+k 3 x\n", "{}: line 1: 'x' is no number that can stand here"},
        {"1 a 3 1\n1 a 3 1\n", "{}: line 2: 'a' stands here again"}}) {
    (void)folder_.write("statistics", text);
    std::string expected = message;
    const std::size_t at = expected.find("{}");
    EXPECT_EQ(refusal(tree), expected.replace(at, 2, statistics_)) << text;
  }
}

TEST_F(StateTying, StatesWithoutFramesCountAlike) {
  std::string text = context_statistics();
  for (const ContextModel& unit : kUnits) {
    const std::string frames = std::to_string(unit.frames);
    text.replace(text.find(frames), frames.size(), "0");
  }
  (void)folder_.write("statistics", text);
  outliers_ = "0";
  const ModelSet set = edited(kContextQuestions + "TB 0.5 a2_ {*.state[2]}");
  const auto& state = set.find('s', "a2_1")->state.components[0].component;
  EXPECT_NEAR(state.mean.values[0], (0.3 + 32.5) / 6, 1e-6);
}

}  // namespace
}  // namespace hri::htk
