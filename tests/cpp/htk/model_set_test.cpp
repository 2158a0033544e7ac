// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/model_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

// As HTK writes it, with every macro there is.
const std::string kShared =
    "~o\n<STREAMINFO> 1 2\n<VECSIZE> 2<NULLD><MFCC_D><DIAGC>\n"
    "~t \"steps\"\n<TRANSP> 4\n"
    " 0.000000e+00 1.000000e+00 0.000000e+00 0.000000e+00\n"
    " 0.000000e+00 6.000000e-01 4.000000e-01 0.000000e+00\n"
    " 0.000000e+00 0.000000e+00 7.000000e-01 3.000000e-01\n"
    " 0.000000e+00 0.000000e+00 0.000000e+00 0.000000e+00\n"
    "~u \"middle\"\n<MEAN> 2\n 1.000000e+00 -2.500000e+00\n"
    "~v \"varFloor1\"\n<VARIANCE> 2\n 1.000000e-02 2.000000e-02\n"
    "~m \"wide\"\n~u \"middle\"\n<VARIANCE> 2\n 4.000000e+00 5.000000e+00\n"
    "<GCONST> 6.671486e+00\n"
    "~s \"begin\"\n<NUMMIXES> 3\n<MIXTURE> 1 2.500000e-01\n~m \"wide\"\n<MIXTURE> 3 7.500000e-01\n"
    "<MEAN> 2\n 0.000000e+00 1.000000e+00\n~v \"varFloor1\"\n"
    "~h \"one\"\n<BEGINHMM>\n<NUMSTATES> 4\n<STATE> 2\n~s \"begin\"\n<STATE> 3\n"
    "<MEAN> 2\n 3.000000e+00 4.000000e+00\n<VARIANCE> 2\n 1.000000e+00 2.000000e+00\n"
    "~t \"steps\"\n<ENDHMM>\n";

std::string refusal_of_definitions(const std::string& text) {
  ModelSet set;
  try {
    set.parse(text, "models");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

GaussianMixtureHmm model(int num_states, int num_mixtures) {
  Topology topology;
  topology.num_states = num_states;
  MatrixD weights = MatrixD::Constant(num_states, num_mixtures, 1.0 / num_mixtures);
  MatrixD means = MatrixD::Random(num_states * num_mixtures, 3);
  MatrixD variances = MatrixD::Random(num_states * num_mixtures, 3).array().abs() + 0.1;
  return {MarkovChain::initial(topology), MixtureBank(weights, means, variances)};
}

// Two Gaussians that all states share.
std::string tied_mixture(const std::string& weights) {
  return "~o\n<STREAMINFO> 1 1\n<VECSIZE> 1<NULLD><USER><DIAGC>\n"
         "~m \"mix1\"\n<MEAN> 1\n 0.000000e+00\n<VARIANCE> 1\n 1.000000e+00\n"
         "~m \"mix2\"\n<MEAN> 1\n 4.000000e+00\n<VARIANCE> 1\n 1.000000e+00\n"
         "~m \"mix3\"\n<MEAN> 1\n 9.000000e+00\n<VARIANCE> 1\n 1.000000e+00\n"
         "~h \"x\"\n<BEGINHMM>\n<NUMSTATES> 3\n<STATE> 2\n<NUMMIXES> 3\n<TMIX> \"mix\"\n " +
         weights +
         "\n<TRANSP> 3\n 0.000000e+00 1.000000e+00 0.000000e+00\n 0.000000e+00 5.000000e-01 "
         "5.000000e-01\n 0.000000e+00 0.000000e+00 0.000000e+00\n<ENDHMM>\n";
}

TEST(ModelSet, ReadsAndWritesTiedMixtures) {
  const std::string text = tied_mixture("5.000000e-01 2.500000e-01*2");
  ModelSet set;
  set.parse(text, "models");
  EXPECT_EQ(set.to_text(), text);
  const StateDefinition& state = set.find('h', "x")->hmm.states[0];
  ASSERT_EQ(state.components.size(), 3U);
  EXPECT_EQ(state.components[2].weight, 0.25);
  EXPECT_EQ(state.components[2].component.mean.values[0], 9);
  EXPECT_EQ(to_hmm(set.find('h', "x")->hmm).bank().num_mixtures(), 3);

  // Without one of them it is a mixture as others.
  set.macros.back().hmm.states[0].components.pop_back();
  set.macros.back().hmm.states[0].components[0].weight = 0.75;
  EXPECT_EQ(set.to_text().find("<TMIX>"), std::string::npos);
  EXPECT_NE(set.to_text().find("<MIXTURE> 2 2.500000e-01\n~m \"mix2\""), std::string::npos);
}

TEST(ModelSet, RefusesDamagedTiedMixturesByNameAndLine) {
  const auto refusal = [](const std::string& weights) {
    return refusal_of_definitions(tied_mixture(weights));
  };
  EXPECT_EQ(refusal("0.5 0.25 0.25"), "nothing thrown");
  EXPECT_EQ(refusal("0.5 0.25*3"), "models: line 25: there are more values than <NUMMIXES> says");
  EXPECT_EQ(refusal("0.5*1.5 0.5"), "models: line 25: there are more values than <NUMMIXES> says");
  EXPECT_EQ(refusal("0.5 0.5"), "models: line 26: expected a value, or value*times");
  EXPECT_EQ(refusal("0.5 2 0.5"), "models: line 25: a weight is outside 0..1");
  EXPECT_EQ(refusal("0.5*3"), "models: line 25: the weights of a state do not sum to 1");
  EXPECT_EQ(refusal_of_definitions(replaced(tied_mixture("0.5 0.25*2"), "mix3", "mix4")),
            "models: line 25: ~m \"mix3\" is not defined above");
  EXPECT_EQ(
      refusal_of_definitions(replaced(tied_mixture("0.5 0.25*2"), "<TMIX> \"mix\"", "<DPROB>")),
      "models: line 24: a discrete state, where the others have Gaussians");
}

TEST(ModelSet, WritesFilesOfHtkByteForByte) {
  ModelSet set;
  set.parse(kShared, "models");
  EXPECT_EQ(set.to_text(), kShared);
  EXPECT_EQ(set.hmm_names(), std::vector<std::string>{"one"});
  EXPECT_EQ(set.kind.text(), "MFCC_D");
}

TEST(ModelSet, TakesKeywordsOfAnyCaseAndOptionsInModels) {
  ModelSet set;
  set.parse(
      "~h one\n<BeginHMM> <VecSize> 1 <USER> <nullD> <DiagC>\n<NumStates> 3 <State> 2 <NumMixes> "
      "1\n"
      "<Stream> 1 <Mixture> 1 1.0 <Mean> 1 0.5 <Variance> 1 2.0\n<TransP> 3 0 1 0 0 0.5 0.5 0 0 0 "
      "<EndHMM>",
      "models");
  EXPECT_EQ(set.vector_size, 1);
  EXPECT_EQ(set.find('h', "one")->hmm.states[0].components[0].component.variance.values[0], 2);
}

TEST(ModelSet, ResolvesMacrosInModels) {
  ModelSet set;
  set.parse(kShared, "models");
  const GaussianMixtureHmm hmm = to_hmm(set.find('h', "one")->hmm);
  ASSERT_EQ(hmm.num_states(), 2);
  ASSERT_EQ(hmm.bank().num_mixtures(), 2);
  EXPECT_EQ(hmm.bank().weights()(0, 0), 0.25);
  EXPECT_EQ(hmm.bank().weights()(1, 1), 0);
  EXPECT_EQ(hmm.bank().means()(0, 1), -2.5);
  EXPECT_EQ(hmm.bank().variances()(1, 0), 0.01);
  EXPECT_EQ(hmm.chain().topology().kind, Topology::Kind::left_right);
  EXPECT_EQ(hmm.chain().transition()(0, 0), 0.6);
  EXPECT_EQ(hmm.chain().transition()(1, 1), 1);
  double log_skip = 0;
  const WordChain chain = to_chain(set.find('h', "one")->hmm, &log_skip);
  EXPECT_EQ(log_skip, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(std::exp(chain.log_exit[1]), 0.3, 1e-12);
  EXPECT_NEAR(std::exp(chain.log_transition(0, 1)), 0.4, 1e-12);
}

TEST(ModelSet, KeepsModelsToTheBit) {
  ModelSet set;
  set.kind = ParameterKind::parse("USER");
  for (const auto& [name, mixtures] : {std::pair{"one", 1}, std::pair{"two words", 3}})
    set.add(name, model(4, mixtures), 0.8);
  const std::string text = set.to_text();
  ModelSet read;
  read.parse(text, "models");
  EXPECT_EQ(read.to_text(), text);
  for (std::size_t i = 0; i < 2; ++i) {
    const GaussianMixtureHmm before = to_hmm(set.macros[i].hmm);
    const GaussianMixtureHmm after = to_hmm(read.macros[i].hmm);
    EXPECT_EQ(before.bank().means(), after.bank().means());
    EXPECT_EQ(before.bank().variances(), after.bank().variances());
    EXPECT_EQ(before.chain().transition(), after.chain().transition());
    const ComponentDefinition& one = read.macros[i].hmm.states[0].components[0].component;
    EXPECT_NEAR(one.gconst,
                3 * std::log(2 * 3.14159265358979) + one.variance.values.array().log().sum(), 1e-9);
  }
}

TEST(ModelSet, RefusesModelsThatDoNotFit) {
  ModelSet set;
  set.add("one", model(2, 1), 0.5);
  EXPECT_THROW(set.add("one", model(2, 1), 0.5), InvalidArgument);
  EXPECT_THROW(set.add("two", model(2, 1), 1), InvalidArgument);
  Topology topology;
  topology.kind = Topology::Kind::ergodic;
  topology.num_states = 1;
  const MixtureBank bank(MatrixD::Ones(1, 1), MatrixD::Zero(1, 2), MatrixD::Ones(1, 2));
  EXPECT_THROW(set.add("two", {MarkovChain::initial(topology), bank}, 0.5), InvalidArgument);
}

TEST(ModelSet, RefusesDamagedFilesByNameAndLine) {
  EXPECT_EQ(refusal_of_definitions(kShared + kShared),
            "models: line 44: ~t \"steps\" is defined already");
  EXPECT_EQ(refusal_of_definitions("<BEGINHMM>"), "models: line 1: expected a macro, such as ~h");
  EXPECT_EQ(
      refusal_of_definitions(replaced(kShared, "~s \"begin\"\n<STATE> 3", "~s \"end\"\n<STATE> 3")),
      "models: line 33: ~s \"end\" is not defined above");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "<MEAN> 2\n 3", "<MEAN> 3\n 3")),
            "models: line 35: vectors had 2 values above");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "<NUMSTATES> 4", "<NUMSTATES> 5")),
            "models: line 38: 2 states are defined, <NUMSTATES> says 3 beside entry and exit");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "<STATE> 3", "<STATE> 2")),
            "models: line 38: state 2 is defined twice");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "7.500000e-01", "6.500000e-01")),
            "models: line 28: the weights of a state do not sum to 1");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, " 1.000000e-02", " 0.000000e+00")),
            "models: line 15: a variance is not above 0");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "6.000000e-01", "5.000000e-01")),
            "models: line 7: the transitions from state 2 do not sum to 1");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "6.000000e-01", "nan")),
            "models: line 7: expected a number");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "<NULLD>", "<FULLC>")),
            "models: line 3: <FULLC> is not read");
  EXPECT_EQ(refusal_of_definitions(replaced(kShared, "<STREAMINFO> 1", "<STREAMINFO> 3")),
            "models: line 2: models of several streams are not read");
  EXPECT_EQ(refusal_of_definitions("~h \"a\" <BEGINHMM> <NUMSTATES> 999999999"),
            "models: line 1: expected a whole number in 3..4098");
  EXPECT_EQ(refusal_of_definitions("~h \"a\n\" <BEGINHMM>"),
            "models: line 1: a quotation does not end");
  EXPECT_EQ(refusal_of_definitions("~h \"a\" :\x02"),
            "models: line 1: binary definitions are not read; HHEd writes them as text");
}

TEST(ModelSet, RefusesEveryCutFile) {
  for (std::size_t size = kShared.find("~h") + 3; size + 3 < kShared.size(); size += 7)
    EXPECT_NE(refusal_of_definitions(kShared.substr(0, size)), "nothing thrown") << size;
}

TEST(ModelSet, WritesWhatOneOfSeveralFilesDefines) {
  const std::size_t at = kShared.find("~s");
  const std::string header = kShared.substr(0, kShared.find("~t"));
  ModelSet set;
  set.parse(kShared.substr(0, at), "first");
  const std::size_t middle = set.macros.size();
  set.parse(header + kShared.substr(at), "second");
  EXPECT_EQ(set.to_text(0, middle), kShared.substr(0, at));
  EXPECT_EQ(set.to_text(middle, set.macros.size()), header + kShared.substr(at));
  EXPECT_EQ(set.to_text(0, set.macros.size()), kShared);
  EXPECT_THROW((void)set.to_text(2, 1), InvalidArgument);
  EXPECT_THROW((void)set.to_text(0, set.macros.size() + 1), InvalidArgument);
}

TEST(ModelSet, RenamesModels) {
  ModelSet set;
  set.parse(kShared, "models");
  set.rename_hmm("one", "uno");
  set.rename_hmm("uno", "uno");
  EXPECT_EQ(set.to_text(), replaced(kShared, "~h \"one\"", "~h \"uno\""));
  EXPECT_THROW(set.rename_hmm("one", "two"), InvalidArgument);
  set.macros.push_back(*set.find('h', "uno"));
  set.macros.back().name = "two";
  EXPECT_THROW(set.rename_hmm("uno", "two"), InvalidArgument);
}

TEST(ModelSet, StaysAsItWasWhenAFileIsRefused) {
  ModelSet set;
  set.parse(kShared, "models");
  EXPECT_THROW(set.parse("~u \"more\" <MEAN> 2 1 2 ~h", "more"), FormatError);
  EXPECT_EQ(set.to_text(), kShared);
}

}  // namespace
}  // namespace hri::htk
