// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/edit_script.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "test_folder.hpp"

namespace hri::htk {
namespace {

std::string state(int number, double mean, double variance) {
  return "<STATE> " + std::to_string(number) + " <MEAN> 2 " + std::to_string(mean) + " 1 " +
         "<VARIANCE> 2 " + std::to_string(variance) + " 4 ";
}

const std::string kSteps = "<TRANSP> 4 0 1 0 0 0 0.6 0.3 0.1 0 0 0.5 0.5 0 0 0 0 ";

// Two models of two states, and sp of one.
ModelSet models() {
  ModelSet set;
  set.parse("~o <VECSIZE> 2 <USER>\n~h aa <BEGINHMM> <NUMSTATES> 4 " + state(2, 0, 1) +
                state(3, 2, 9) + kSteps + "<ENDHMM> ~h ab <BEGINHMM> <NUMSTATES> 4 " +
                state(2, 4, 3) + state(3, 6, 1) + kSteps +
                "<ENDHMM> ~h sp <BEGINHMM> <NUMSTATES> 3 " + state(2, 8, 2) +
                "<TRANSP> 3 0 1 0 0 0.5 0.5 0 0 0 <ENDHMM>",
            "models");
  return set;
}

ModelSet edited(const std::string& script, const ModelSet& set = models()) {
  ModelSet made = EditScript::parse(script, "script").apply(set);
  EXPECT_NO_THROW((void)made.to_text());
  return made;
}

const StateDefinition& state_of(const ModelSet& set, const std::string& name, std::size_t s) {
  return set.find('h', name)->hmm.states[s];
}

std::string refusal(const std::string& script) {
  try {
    (void)EditScript::parse(script, "script").apply(models());
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(EditScript, PassesOverCommentsAndTrace) {
  const EditScript script =
      EditScript::parse("// as HTS has them\n# ours\nTR 3\nMU 2 {*.state[2].mix}\n", "script");
  ASSERT_EQ(script.commands.size(), 1U);
  EXPECT_EQ(script.commands[0].line, 4);
  EXPECT_EQ(refusal("TR x\n"), "script: line 1: expected a number, not 'x'");
}

TEST(EditScript, ClonesModelsForTheirContexts) {
  const TestFolder folder;
  const std::string list = folder.write("list", "sp\nx-aa+y\n\naa+b\nb-ab\n");
  const ModelSet made =
      edited("TI steps {(aa,ab).transP}\nCL \"" + list + "\"\nTI T_aa {(*-aa+*,aa+*).state[3]}\n");
  EXPECT_EQ(made.hmm_names(), (std::vector<std::string>{"sp", "x-aa+y", "aa+b", "b-ab"}));
  EXPECT_EQ(state_of(made, "x-aa+y", 1).macro, "T_aa");
  EXPECT_EQ(state_of(made, "aa+b", 1).macro, "T_aa");
  EXPECT_EQ(state_of(made, "b-ab", 1).macro, "");
  EXPECT_EQ(state_of(made, "x-aa+y", 0).components[0].component.mean.values,
            state_of(models(), "aa", 0).components[0].component.mean.values);
  EXPECT_EQ(made.find('h', "b-ab")->hmm.transitions.macro, "steps");
}

TEST(EditScript, RefusesListsByNameAndLine) {
  const TestFolder folder;
  for (const auto& [text, message] :
       {std::pair<const char*, const char*>{"aa\nx-oo+y\n",
                                            ": line 2: there is no model 'x-oo+y', and no 'oo'"},
        {"aa\naa\n", ": line 2: 'aa' stands here again"},
        {"aa ab\n", ": line 1: expected the name of a model"}}) {
    const std::string list = folder.write("list", text);
    EXPECT_EQ(refusal("CL " + list + "\n"), list + message);
  }
  const std::string list = folder.write("list", "\n");
  EXPECT_EQ(refusal("CL " + list + "\n"), "script: line 1: the list '" + list + "' has no model");
  EXPECT_EQ(refusal("CL"), "script: line 1: expected the path of a file");
  EXPECT_THROW(edited("CL nowhere\n"), IoError);
}

TEST(EditScript, SplitsTheHeaviestIntoTwoAboutItsMean) {
  const ModelSet given = models();
  const ModelSet made = edited("MU 2 {*.state[2-4].mix}\n", given);
  for (const char* name : {"aa", "ab", "sp"}) {
    const StateDefinition& before = state_of(given, name, 0);
    const StateDefinition& after = state_of(made, name, 0);
    ASSERT_EQ(after.components.size(), 2U);
    EXPECT_EQ(after.num_mixtures, 2);
    const VectorD shift =
        0.2 * before.components[0].component.variance.values.array().sqrt().matrix();
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_EQ(after.components[c].number, static_cast<int>(c) + 1);
      EXPECT_EQ(after.components[c].weight, 0.5);
      EXPECT_EQ(after.components[c].component.variance.values,
                before.components[0].component.variance.values);
      EXPECT_EQ(after.components[c].component.mean.values,
                before.components[0].component.mean.values + (c == 0 ? 1 : -1) * shift);
    }
  }
}

TEST(EditScript, SplitsNoneTwiceWhileAnotherIsWhole) {
  ModelSet set = edited("MU 2 {aa.state[2].mix}");
  StateDefinition& state = set.macros[0].hmm.states[0];
  state.components[0].weight = 0.9;
  state.components[1].weight = 0.1;
  const ModelSet four = edited("MU +2 {aa.state[2].mix}", set);
  std::vector<double> weights;
  for (const WeightedComponent& one : state_of(four, "aa", 0).components)
    weights.push_back(one.weight);
  EXPECT_EQ(weights, (std::vector<double>{0.45, 0.05, 0.45, 0.05}));
  // Each command counts anew, and none makes fewer.
  const ModelSet again = edited("MU 3 {aa.state[2].mix}\nMU 2 {aa.state[2].mix}", set);
  EXPECT_EQ(state_of(again, "aa", 0).components.size(), 3U);
  EXPECT_EQ(state_of(again, "aa", 0).components[2].weight, 0.45);
}

TEST(EditScript, DropsWhatHasNoWeightBeforeItSplits) {
  ModelSet set = edited("MU 2 {aa.state[2].mix}");
  set.macros[0].hmm.states[0].components[0].weight = 0;
  set.macros[0].hmm.states[0].components[1].weight = 1;
  const ModelSet made = edited("MU 2 {aa.state[2].mix}", set);
  ASSERT_EQ(state_of(made, "aa", 0).components.size(), 2U);
  EXPECT_EQ(state_of(made, "aa", 0).components[0].weight, 0.5);
  EXPECT_LT(state_of(made, "aa", 0).components[1].component.mean.values[0],
            set.macros[0].hmm.states[0].components[1].component.mean.values[0]);
}

TEST(EditScript, TiesStatesToTheBroadest) {
  const ModelSet made = edited("TI both {aa.state[2-3],ab.state[2]}\nMU 3 {(aa,ab).state[2].mix}");
  ASSERT_NE(made.find('s', "both"), nullptr);
  EXPECT_EQ(made.macros.front().type, 's');
  for (const StateDefinition* one : {&made.find('s', "both")->state, &state_of(made, "aa", 0),
                                     &state_of(made, "aa", 1), &state_of(made, "ab", 0)}) {
    EXPECT_EQ(one->components.size(), 3U);
    EXPECT_EQ(one->components[0].component.variance.values[0], 9);
  }
  EXPECT_EQ(state_of(made, "ab", 1).components.size(), 1U);
}

TEST(EditScript, TiesVectorsComponentsAndTransitions) {
  ModelSet made = edited("TI middle {*.state[2].mix[1].mean}\nTI wide {*.state[2-3].mix[1].cov}\n");
  EXPECT_EQ(made.find('u', "middle")->vector.values[0], 4);
  EXPECT_EQ(made.find('v', "wide")->vector.values[0], 9);
  for (const char* name : {"aa", "ab", "sp"}) {
    const ComponentDefinition& one = state_of(made, name, 0).components[0].component;
    EXPECT_EQ(one.mean.macro, "middle");
    EXPECT_EQ(one.mean.values[0], 4);
    EXPECT_EQ(one.variance.values[0], 9);
    EXPECT_NEAR(one.gconst, 2 * std::log(2 * 3.14159265358979324) + std::log(36), 1e-12);
  }
  made = edited("TI m {aa.state[2].mix[1],sp.state[2].mix[1]}\nTI \"the steps\" {a?.transP}");
  EXPECT_EQ(state_of(made, "aa", 0).components[0].component.macro, "m");
  EXPECT_EQ(state_of(made, "aa", 0).components[0].component.mean.values[0], 8);
  EXPECT_EQ(made.find('h', "ab")->hmm.transitions.macro, "the steps");
  ModelSet again;
  again.parse(made.to_text(), "again");
  EXPECT_EQ(again.to_text(), made.to_text());
}

TEST(EditScript, AddsAndRemovesTransitions) {
  ModelSet made = edited("# a tee, and a way back\nAT 1 3 0.3 {sp.transP}\nAT 3 2 0.2 {aa.transP}");
  EXPECT_EQ(made.find('h', "sp")->hmm.transitions.values(0, 2), 0.3);
  EXPECT_EQ(made.find('h', "sp")->hmm.transitions.values(0, 1), 0.7);
  EXPECT_EQ(made.find('h', "aa")->hmm.transitions.values.row(2),
            (VectorD(4) << 0, 0.2, 0.4, 0.4).finished().transpose());
  made = edited("TI t {a?.transP} RT 2 4 {aa.transP}");
  for (const char* name : {"aa", "ab"}) {
    const MatrixD& values = made.find('h', name)->hmm.transitions.values;
    EXPECT_EQ(values(1, 3), 0);
    EXPECT_NEAR(values(1, 1), 2.0 / 3, 1e-15);
  }
  EXPECT_EQ(made.find('t', "t")->transitions.values(1, 3), 0);
}

TEST(EditScript, RefusesWithFileAndLine) {
  const auto expect = [](const std::string& script, const std::string& why) {
    EXPECT_EQ(refusal(script), "script: line " + why);
  };
  expect(
      "MU 2 {*.state[2].mix}\nXX 1",
      "2: there is no command 'XX' but MU, TI, AT, RT, CL, RO, LS, QS, TB, TC, AU, CO, ST and LT");
  expect("MU 2 *.state[2].mix}", "1: expected {");
  expect("\nMU 2 {*.state[2].mix", "2: expected }");
  expect("MU 0 {*.state[2].mix}", "1: expected a whole number in 1..4096");
  expect("MU 4096 {sp.state[2].mix}\nMU +1 {sp.state[2].mix}",
         "2: a mixture would have more than 4096 Gaussians");
  expect("MU 2 {*.state[2]}", "1: MU takes items such as {*.state[2-4].mix}");
  expect("MU 2 {*.state[5-3].mix}", "1: a range ends before it begins");
  expect("MU 2 {*.state[1].mix}", "1: expected a whole number in 2..4097");
  expect("MU 2 {*.stat[2].mix}", "1: expected transP or state, not 'stat'");
  expect("MU 2 {b.state[2].mix}", "1: no model has what the items name");
  expect("MU 2 {aa.state[4].mix}", "1: no model has what the items name");
  expect("TI x {aa.state[2],\nab.transP}", "2: TI takes items of one kind");
  expect("TI x {aa.state[2].mix}", "1: TI takes a mixture by its number, as in mix[1]");
  expect("TI x {aa.state[2].mix[1].var}", "1: expected mean or cov, not 'var'");
  expect("TI x {aa.state[2]}\nTI x {ab.state[2]}", "2: ~s \"x\" is defined already");
  expect("TI x {(aa,sp).transP}", "1: the models have different numbers of states");
  expect("TI \"x {aa.transP}", "1: a quotation does not end");
  expect("TI {aa.transP}", "1: expected the name of a macro");
  expect("AT 1 3 1.5 {aa.transP}", "1: a probability is above 0, and at most 1");
  expect("AT 2 4 {aa.transP}", "1: expected a number, not ''");
  expect("AT 2 5 0.1 {aa.transP}", "1: the model 'aa' has 4 states");
  expect("AT 1 2 0.5 {sp.transP}", "1: the model 'sp' has no other transition from the state");
  expect("RT 1 2 {sp.transP}", "1: the model 'sp' has no other transition from the state");
  expect("RT 1 3 {sp.transP}", "1: the model 'sp' has no such transition");
  expect("RT 1 3 {sp.state[2]}", "1: AT and RT take items such as {a.transP}");
  expect("\xff", "1: is not UTF-8 text");
}

}  // namespace
}  // namespace hri::htk
