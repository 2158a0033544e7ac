// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Discrete models: their files, training and recognition.
#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "hri/htk/embedded_trainer.hpp"
#include "hri/htk/flat_start.hpp"
#include "hri/htk/recognizer.hpp"
#include "hri/htk/viterbi_trainer.hpp"
#include "test_folder.hpp"

namespace hri::htk {
namespace {

const std::string kDiscreteOptions = "~o\n<STREAMINFO> 1 1\n<VECSIZE> 1<NULLD><DISCRETE><DIAGC>\n";
const std::string kDiscreteSteps =
    "<TRANSP> 3\n 0.000000e+00 1.000000e+00 0.000000e+00\n"
    " 0.000000e+00 7.500000e-01 2.500000e-01\n"
    " 0.000000e+00 0.000000e+00 0.000000e+00\n";

// A model of one state; `logs` as files have them.
std::string discrete_model(const std::string& name, int num_codewords, const std::string& logs) {
  return "~h \"" + name + "\"\n<BEGINHMM>\n<NUMSTATES> 3\n<STATE> 2\n<NUMMIXES> " +
         std::to_string(num_codewords) + "\n<DPROB> " + logs + "\n" + kDiscreteSteps + "<ENDHMM>\n";
}

ModelSet discrete_models(const std::string& text) {
  ModelSet set;
  set.parse(text, "models");
  return set;
}

std::string refusal_of_discrete(const std::string& text) {
  try {
    (void)discrete_models(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

MatrixF codeword_frames(const std::vector<float>& codewords) {
  return Eigen::Map<const MatrixF>(codewords.data(), static_cast<Eigen::Index>(codewords.size()),
                                   1);
}

const VectorD& discrete_of(const ModelSet& set, const std::string& name) {
  return set.find('h', name)->hmm.states.front().discrete;
}

TEST(DiscreteModels, AreReadAndWrittenByteForByte) {
  // 5461 stands for a tenth, 32767 for nothing.
  const std::string text = kDiscreteOptions + "~s \"any\"\n<NUMMIXES> 10\n<DPROB> 5461*10\n" +
                           discrete_model("a", 10, "1644*2 32767*8") +
                           "~h \"b\"\n<BEGINHMM>\n<NUMSTATES> 3\n<STATE> 2\n~s \"any\"\n" +
                           kDiscreteSteps + "<ENDHMM>\n";
  const ModelSet set = discrete_models(text);
  EXPECT_EQ(set.to_text(), text);
  EXPECT_EQ(set.num_codewords(), 10);
  EXPECT_EQ(set.vector_size, 1);
  EXPECT_NEAR(discrete_of(set, "a")[1], 0.5, 1e-4);
  EXPECT_EQ(discrete_of(set, "a")[2], 0);
  EXPECT_NEAR(discrete_of(set, "b").sum(), 1, 1e-3);
}

TEST(DiscreteModels, AreReadInOtherLayouts) {
  const ModelSet set = discrete_models(
      "~o <Discrete> <StreamInfo> 1 1\n~h a <BeginHMM> <NumStates> 3 <State> 2 <NumMixes> 4\n"
      "<SWeights> 1 1\n<Stream> 1 <dprob> 3288 3288\n3288*2\n<TransP> 3 0 1 0 0 .5 .5 0 0 0 "
      "<EndHMM>");
  EXPECT_NEAR(discrete_of(set, "a")[3], 0.25, 1e-4);
  EXPECT_EQ(discrete_models(set.to_text()).to_text(), set.to_text());
}

TEST(DiscreteModels, RefuseDamageWithFileAndLine) {
  EXPECT_EQ(refusal_of_discrete(kDiscreteOptions + discrete_model("a", 3, "2606*4")),
            "models: line 9: there are more values than <NUMMIXES> says");
  EXPECT_EQ(refusal_of_discrete(kDiscreteOptions + discrete_model("a", 3, "2606 2606")),
            "models: line 10: expected a value, or value*times");
  for (const char* wrong : {"2606.5", "-1", "32768"}) {
    EXPECT_EQ(refusal_of_discrete(kDiscreteOptions + discrete_model("a", 1, wrong)),
              "models: line 9: a scaled log probability is no whole number in 0..32767");
  }
  EXPECT_EQ(refusal_of_discrete(kDiscreteOptions + discrete_model("a", 3, "0*3")),
            "models: line 9: the probabilities of a state do not sum to 1");
  EXPECT_EQ(refusal_of_discrete(kDiscreteOptions + discrete_model("a", 2, "1644*2") +
                                discrete_model("b", 3, "2606*3")),
            "models: line 20: the states above have 2 codewords, not 3");
  EXPECT_EQ(refusal_of_discrete("~o <MFCC>\n" + discrete_model("a", 2, "1644*2")),
            "models: line 7: a discrete state, where the parameter kind is MFCC");
  EXPECT_EQ(refusal_of_discrete(discrete_model("a", 2, "1644*2") + "~v floor <VARIANCE> 1 1"),
            "models: line 12: a Gaussian, where the models are discrete");
  EXPECT_EQ(refusal_of_discrete("~u middle <MEAN> 1 0\n" + discrete_model("a", 2, "1644*2")),
            "models: line 7: a discrete state, where the others have Gaussians");
  EXPECT_EQ(refusal_of_discrete("~o <STREAMINFO> 2 1 1 <DISCRETE>\n"),
            "models: line 1: models of several streams are not read");
  EXPECT_EQ(refusal_of_discrete("~h a <BEGINHMM> <NUMSTATES> 3 <STATE> 2\n<SWEIGHTS> 2 1 1"),
            "models: line 2: models of several streams are not read");
  for (const char* streams : {"<NUMMIXES> 4 4", "<STREAM> 2 <DPROB> 0", "<SWEIGHTS> 1 0.5"}) {
    EXPECT_EQ(
        refusal_of_discrete("~h a <BEGINHMM> <NUMSTATES> 3 <STATE> 2\n" + std::string(streams)),
        "models: line 2: models of several streams are not read");
  }
}

TEST(DiscreteModels, TwoFilesMustAgree) {
  ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 2, "1644*2"));
  EXPECT_THROW(set.parse(discrete_model("b", 3, "2606*3"), "more"), FormatError);
  EXPECT_THROW(set.parse("~u middle <MEAN> 1 0", "more"), FormatError);
  set.parse(discrete_model("b", 2, "0 32767"), "more");
  EXPECT_EQ(set.hmm_names().size(), 2u);
}

TEST(DiscreteModels, AreCountedAlongTheBestPath) {
  const ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 4, "3288*4"));
  const std::vector<MatrixF> recordings{codeword_frames({1, 1, 1, 2}),
                                        codeword_frames({1, 1, 4, 4})};
  ViterbiTraining made = train_by_viterbi(set, "a", recordings);
  const VectorD expected = (VectorD(4) << 5, 1, 0, 2).finished() / 8;
  EXPECT_TRUE(discrete_of(made.models, "a").isApprox(expected, 1e-12));
  EXPECT_NEAR(made.models.find('h', "a")->hmm.transitions.values(1, 1), 6.0 / 8, 1e-12);
  EXPECT_TRUE(made.converged);

  ViterbiTrainerOptions floored;
  floored.weight_floor = 1000;  // 0.01
  made = train_by_viterbi(set, "a", recordings, floored);
  EXPECT_NEAR(discrete_of(made.models, "a")[2], 0.01, 1e-12);
  EXPECT_NEAR(discrete_of(made.models, "a").sum(), 1, 1e-12);
}

TEST(DiscreteModels, BaumWelchMakesRecordingsMoreLikely) {
  ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 3, "1250 3000 4800") +
                                 discrete_model("b", 3, "4800 3000 1250"));
  const MatrixF frames = codeword_frames({1, 1, 2, 1, 3, 3, 2, 3});
  double before = -HUGE_VAL;
  for (int pass = 0; pass < 5; ++pass) {
    EmbeddedTrainerOptions options;
    options.min_examples = 1;
    EmbeddedTrainer trainer(set, options);
    EXPECT_EQ(trainer.add(frames, {"a", "b"}), EmbeddedOutcome::added);
    EXPECT_GT(trainer.log_likelihood(), before - 1e-9);
    before = trainer.log_likelihood();
    set = trainer.estimate();
    EXPECT_NEAR(discrete_of(set, "a").sum(), 1, 1e-12);
  }
  EXPECT_GT(discrete_of(set, "a")[0], 0.7);
  EXPECT_GT(discrete_of(set, "b")[2], 0.7);
  EXPECT_NO_THROW((void)set.to_text());
}

TEST(DiscreteModels, SumsOfPartsAddUp) {
  const ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 3, "2606*3"));
  EmbeddedTrainerOptions options;
  options.min_examples = 1;
  EmbeddedTrainer whole(set, options);
  EmbeddedTrainer first(set, options);
  EmbeddedTrainer second(set, options);
  const MatrixF one = codeword_frames({1, 1, 2});
  const MatrixF other = codeword_frames({3, 1, 2});
  whole.add(one, {"a"});
  whole.add(other, {"a"});
  first.add(one, {"a"});
  second.add(other, {"a"});
  const TestFolder folder;
  const std::string path = folder / "sums";
  first.write_sums(path);
  second.add_sums(path);
  EXPECT_TRUE(
      discrete_of(second.estimate(), "a").isApprox(discrete_of(whole.estimate(), "a"), 1e-12));
}

TEST(DiscreteModels, AreRecognised) {
  const ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 3, "250 5461 32767") +
                                       discrete_model("b", 3, "32767 5461 250"));
  const Dictionary words = Dictionary::parse("one a\ntwo b\n", "dict");
  const Recognizer recognizer(set, words,
                              WordLattice::of_grammar("$w = one | two; ( < $w > )", "grammar"));
  EXPECT_EQ(recognizer.dim(), 1);
  const MatrixF frames = codeword_frames({1, 1, 2, 1, 3, 3, 2, 3});
  const RecognisedSentence found = recognizer.recognise(frames);
  ASSERT_EQ(found.words.size(), 2u);
  EXPECT_EQ(found.words[0].word, "one");
  EXPECT_EQ(found.words[1].word, "two");
  EXPECT_TRUE(found.complete);
  // Probabilities of the frames and of the steps, within what files round away.
  const double common = 5 * std::log(0.75) + 2 * std::log(0.25);
  const double logs = -(6 * 250 + 2 * 5461) / 2371.8;
  EXPECT_NEAR(found.log_score, logs + common + std::log(0.75), 1e-3);
  EXPECT_EQ(recognizer.align(frames, found).front().front().last_frame, found.words[0].last_frame);
  EXPECT_FALSE(recognizer.n_best(recognizer.lattice(frames), 2).empty());
  EXPECT_THROW((void)recognizer.recognise(codeword_frames({1, 4})), InvalidArgument);
  EXPECT_THROW((void)recognizer.recognise(codeword_frames({1.5F})), InvalidArgument);
  EXPECT_THROW((void)recognizer.recognise(MatrixF::Ones(3, 2)), InvalidArgument);
}

TEST(DiscreteModels, NoPathThroughAnImpossibleCodeword) {
  const ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 2, "0 32767"));
  const Recognizer recognizer(set, Dictionary::parse("one a\n", "dict"),
                              WordLattice::of_grammar("( one )", "grammar"));
  EXPECT_TRUE(recognizer.recognise(codeword_frames({1, 1})).complete);
  EXPECT_FALSE(recognizer.recognise(codeword_frames({1, 2})).complete);
  EXPECT_THROW((void)train_by_viterbi(set, "a", {codeword_frames({0, 1})}), InvalidArgument);
  EXPECT_THROW((void)train_by_viterbi(set, "a", {codeword_frames({3, 1})}), InvalidArgument);
  EXPECT_THROW((void)train_by_viterbi(set, "a", {codeword_frames({1, NAN})}), InvalidArgument);
}

TEST(DiscreteModels, HaveNoGaussians) {
  const ModelSet set = discrete_models(kDiscreteOptions + discrete_model("a", 2, "1644*2"));
  EXPECT_THROW((void)to_hmm(set.find('h', "a")->hmm), InvalidArgument);
  FlatStart start;
  start.add(codeword_frames({1, 2}));
  EXPECT_THROW((void)start.apply(set, true), InvalidArgument);
}

}  // namespace
}  // namespace hri::htk
