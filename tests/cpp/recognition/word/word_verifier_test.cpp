// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_verifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri {
namespace {

constexpr int kToneRateHz = 16000;
constexpr double kTwoPi = 6.283185307179586;

// Words of two tones, one after the other, spoken by several persons at different pitch and pace.
std::vector<float> two_tones(double first_hz, double second_hz, double pitch, Random* random) {
  const double seconds = 0.4 * (0.9 + 0.2 * random->uniform());
  std::vector<float> x(static_cast<std::size_t>((seconds + 0.4) * kToneRateHz));
  double phase = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double t = static_cast<double>(n) / kToneRateHz - 0.2;
    const bool sounds = t >= 0 && t < seconds;
    phase += kTwoPi * pitch * (t < seconds / 2 ? first_hz : second_hz) / kToneRateHz;
    x[n] = static_cast<float>((sounds ? 0.3 * std::sin(phase) : 0.0) + 0.002 * random->normal());
  }
  return x;
}

const std::map<std::string, std::pair<double, double>> kTones{
    {"low-high", {500, 1500}}, {"high-low", {1500, 500}}, {"middle", {900, 1000}},
    {"wide", {400, 2500}},     {"edge", {2500, 2400}},
};

struct VerifiedClips {
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
};

VerifiedClips clips(int num_persons = 3, int takes = 5) {
  VerifiedClips result;
  result.audio.reserve(kTones.size() * static_cast<std::size_t>(num_persons * takes));
  Random random(11);
  for (int person = 0; person < num_persons; ++person) {
    const double pitch = 0.97 + 0.03 * (person % 3);
    for (const auto& [label, tones] : kTones) {
      for (int take = 0; take < takes; ++take) {
        result.audio.push_back(two_tones(tones.first, tones.second, pitch, &random));
        const std::string name(1, static_cast<char>('a' + person));
        result.samples.push_back({result.audio.back(), kToneRateHz, label, name});
      }
    }
  }
  return result;
}

using Kind = VerifierExample::Kind;

std::vector<VerifierExample> examples(double distance) {
  Random random(2);
  std::vector<VerifierExample> result;
  for (int i = 0; i < 300; ++i) {
    const auto kind = static_cast<Kind>(i % 3);
    VectorD features(2);
    features << random.normal() + (kind == Kind::word ? distance : 0), random.normal();
    result.push_back({features, kind});
  }
  return result;
}

TEST(WordVerifier, WeighsTheFeatureThatSeparatesWords) {
  const WordVerifier verifier = WordVerifier::fit(examples(3), {0, 1});
  EXPECT_GT(verifier.word_weights()[0], 1);
  EXPECT_NEAR(verifier.word_weights()[1], 0, 0.3);
  EXPECT_GT(verifier.sound_weights()[0], 1);
  VectorD features(2);
  features << 3, 0;
  EXPECT_GT(verifier.verification_score(features), 0);
  features << 0, 0;
  EXPECT_LT(verifier.verification_score(features), 0);
}

TEST(WordVerifier, TakesTheRatioWhenUntrained) {
  VectorD features(2);
  features << 0.25, 9;
  EXPECT_EQ(WordVerifier().verification_score(features), 0.25F);
  std::vector<VerifierExample> words_only = examples(3);
  for (VerifierExample& e : words_only) e.kind = Kind::word;
  EXPECT_EQ(WordVerifier::fit(words_only, {0, 1}).word_weights().size(), 0);
  EXPECT_EQ(WordVerifier::fit({}, {0, 1}).verification_score(features), 0.25F);
}

// A model with two states, of frames near 0 and then near 5, and one of frames near 5 and then 0.
std::vector<GaussianMixtureHmm> steps() {
  std::vector<GaussianMixtureHmm> result;
  for (const bool rises : {true, false}) {
    Topology topology;
    topology.num_states = 2;
    MatrixD transition(2, 2);
    transition << 0.75, 0.25, 0, 1;  // the first state lasts four frames
    VectorD start(2);
    start << 1, 0;
    MatrixD means(2, 1);
    means << (rises ? 0 : 5), (rises ? 5 : 0);
    result.emplace_back(MarkovChain(topology, start, transition),
                        MixtureBank(MatrixD::Ones(2, 1), means, MatrixD::Ones(2, 1)));
  }
  return result;
}

TEST(WordVerifier, FilesBelongToAKindOfModels) {
  const WordVerifier verifier = WordVerifier::fit(examples(3), {0, 1});
  SequenceModelOptions options;
  options.num_states = 2;
  options.num_codewords = 2;
  options.garbage_mixtures = 1;
  const auto scorer_of = [&](SequenceModelKind kind, const FillerModels& fillers = {}) {
    options.model = kind;
    const ClassSequences sequences{{MatrixF::Random(8, 1)}, {MatrixF::Random(8, 1)}};
    return MultiStreamScorer({train_sequence_scorer(sequences, options, {}, fillers)});
  };
  const MultiStreamScorer ptbhmm = scorer_of(SequenceModelKind::ptbhmm);
  ModelFile file;
  verifier.write(file, ptbhmm);
  EXPECT_EQ(WordVerifier::read(file, ptbhmm).word_weights(), verifier.word_weights());
  const MultiStreamScorer hmm = scorer_of(SequenceModelKind::hmm);
  EXPECT_THROW(WordVerifier::read(file, hmm), FormatError);
  const MultiStreamScorer with_fillers = scorer_of(SequenceModelKind::hmm, steps());
  EXPECT_EQ(WordVerifier::read(ModelFile(), with_fillers).word_weights().size(), 0);
  // The names in files stay those of format version 1.
  ModelFile names;
  WordVerifier::fit(examples(3), {1}).write(names, with_fillers);
  EXPECT_EQ(names.text_list("verifier.features").back(), "background");
  EXPECT_EQ(WordVerifier::feature_names(with_fillers).back(), "fillers");
}

// The features of models like steps() with fillers: ratio, rivals, states, length, pace, fillers.
std::vector<VerifierExample> examples_with_fillers() {
  Random random(3);
  std::vector<VerifierExample> result;
  for (int i = 0; i < 300; ++i) {
    const auto kind = static_cast<Kind>(i % 3);
    VectorD features(6);
    for (double& x : features) x = random.normal() + (kind == Kind::word ? 2 : 0);
    result.push_back({features, kind});
  }
  return result;
}

MultiStreamScorer scorer_with_fillers() {
  SequenceModelOptions options;
  options.num_states = 2;
  options.garbage_mixtures = 1;
  const ClassSequences sequences{{MatrixF::Random(8, 1)}, {MatrixF::Random(8, 1)}};
  return MultiStreamScorer({train_sequence_scorer(sequences, options, {}, steps())});
}

TEST(WordVerifier, ManyWordsLetRivalsAndStatesDecideToo) {
  const MultiStreamScorer scorer = scorer_with_fillers();
  const int many = WordVerifier::kManyWords;
  EXPECT_EQ(WordVerifier::features_of_words(scorer, many - 1), std::vector<int>{5});
  EXPECT_EQ(WordVerifier::features_of_words(scorer, many), (std::vector<int>{1, 2, 5}));
  for (const int num_words : {many - 1, many}) {
    const WordVerifier verifier = WordVerifier::fit(
        examples_with_fillers(), WordVerifier::features_of_words(scorer, num_words));
    ModelFile file;
    verifier.write(file, scorer);
    const WordVerifier read = WordVerifier::read(file, scorer);
    EXPECT_EQ(read.word_weights(), verifier.word_weights());
    VectorD features(6);
    features << 0.1, 0.9, -0.4, 0.2, 0.3, 0.7;
    EXPECT_EQ(read.verification_score(features), verifier.verification_score(features));
    // Fillers decide in both; the states in the second alone.
    VectorD other = features;
    other[2] = 3;
    other[0] = -1;  // of sounds alone
    const WordVerifier words_alone = WordVerifier::fit(
        [] {
          std::vector<VerifierExample> result = examples_with_fillers();
          for (VerifierExample& e : result) {
            if (e.kind == Kind::sound) e.kind = Kind::other_word;
          }
          return result;
        }(),
        WordVerifier::features_of_words(scorer, num_words));
    const bool same =
        words_alone.verification_score(features) == words_alone.verification_score(other);
    EXPECT_EQ(same, num_words < many);
  }
}

std::string message_of_reading(const ModelFile& file, const MultiStreamScorer& scorer) {
  try {
    WordVerifier::read(file, scorer);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

TEST(WordVerifier, FilesWithOtherNumbersOfWeightsAreRefused) {
  const MultiStreamScorer scorer = scorer_with_fillers();
  ModelFile damaged;
  WordVerifier::fit(examples_with_fillers(), {0, 1}).write(damaged, scorer);
  EXPECT_NE(message_of_reading(damaged, scorer).find("has 2 values, expected 1 or 3"),
            std::string::npos);
  for (const char* kind : {"words", "sounds"}) {
    for (const Eigen::Index size : {0, 2}) {
      ModelFile file;
      WordVerifier::fit(examples_with_fillers(), {5}).write(file, scorer);
      ASSERT_EQ(message_of_reading(file, scorer), "");
      const std::string prefix = std::string("verifier.") + kind + ".";
      file.set_vector(prefix + "weights", VectorD(VectorD::Ones(size)));
      EXPECT_NE(message_of_reading(file, scorer), "") << kind << size;
    }
  }
}

TEST(WordRecognizer, CountsTheWordsOfEverySpeaker) {
  WordRecognizerOptions options;
  options.num_vtlp_factors = 1;
  options.num_noisy_copies = 0;
  options.max_iterations = 2;
  Random random(8);
  std::vector<std::vector<float>> audio;
  for (int take = 0; take < 4; ++take) audio.push_back(two_tones(700, 2000, 1, &random));
  std::vector<WordSample> fillers;
  for (const auto& x : audio) fillers.push_back({x, kToneRateHz, "filler", ""});
  for (const int num_persons : {9, 10}) {  // of five words each, twice
    const VerifiedClips all = clips(num_persons, 2);
    const WordRecognizer recognizer = WordRecognizer::train(all.samples, options, {}, {}, fillers);
    EXPECT_EQ(recognizer.verifier().word_weights().size(), num_persons < 10 ? 1 : 3);
  }
  // Of two words neither is scored without its own model.
  VerifiedClips two = clips(26, 1);
  const auto third = [](const WordSample& s) { return s.label != "edge" && s.label != "wide"; };
  two.samples.erase(std::remove_if(two.samples.begin(), two.samples.end(), third),
                    two.samples.end());
  const WordRecognizer recognizer = WordRecognizer::train(two.samples, options, {}, {}, fillers);
  EXPECT_EQ(recognizer.verifier().word_weights().size(), 1);
}

// As features() finds them from a file of such models, of frames that fit the first one.
VectorD features_of(int first_frames, int second_frames, int left_out) {
  SequenceModelOptions options;
  options.num_states = 2;
  ModelFile file;
  const auto hmms = steps();
  for (std::size_t c = 0; c < 2; ++c) hmms[c].write(file, "hmm." + std::to_string(c) + ".");
  GaussianMixtureOptions garbage;
  garbage.num_mixtures = 1;
  MatrixF spread(4, 1);
  spread << 0, 5, 1, 4;
  GaussianMixture::train(spread, garbage).write(file, "garbage.");
  file.set_integer("num_background", 0);
  const MultiStreamScorer scorer({read_sequence_scorer(file, "", options, 2, 1)});
  MatrixF frames(first_frames + second_frames, 1);
  frames.topRows(first_frames).setZero();
  frames.bottomRows(second_frames).setConstant(5);
  const WordEvidence evidence = WordVerifier::evidence(scorer, {frames}, scorer.scores({frames}));
  return WordVerifier::features(scorer, {frames}, evidence, left_out);
}

TEST(WordVerifier, FeaturesAreThoseOfTheAlignment) {
  const VectorD usual = features_of(4, 4, -1);
  const VectorD slow = features_of(40, 4, -1);
  ASSERT_EQ(usual.size(), 5);
  EXPECT_GT(usual[0], 0);
  EXPECT_GT(usual[1], 1);  // the other model has both states the wrong way round
  // The four states of both models: two fit a frame at their mean, two lie five deviations off.
  EXPECT_NEAR(usual[2], 0.5 * 12.5, 1e-4);
  EXPECT_NEAR(usual[3], std::log(0.006), 1e-6);  // as long as it should be
  EXPECT_NEAR(usual[4], std::log(0.06), 1e-6);
  const double late = std::log(40.5 / 4.5);
  EXPECT_NEAR(slow[3], std::log(late * late + 0.006), 1e-6);
  EXPECT_NEAR(slow[4], std::log(late + 0.06), 1e-6);
  // Without the word that was said, the other one has no rival and does not fit.
  const VectorD without = features_of(4, 4, 0);
  EXPECT_EQ(without[1], 0);
  EXPECT_LT(without[0], usual[0]);
  EXPECT_LT(without[2], usual[2]);
}

TEST(WordRecognizer, RejectsWordsOutsideTheVocabularyAndBurstsOfNoise) {
  const VerifiedClips all = clips();
  std::vector<WordSample> train;
  for (const WordSample& s : all.samples) {
    if (s.group != "b" && s.label != "wide" && s.label != "edge") train.push_back(s);
  }
  WordRecognizerOptions options;
  options.min_snr_db = 10;  // these few sounds are all alike in more noise
  const WordRecognizer recognizer = WordRecognizer::train(train, options);
  int words = 0;
  int accepted = 0;
  int strangers_accepted = 0;
  for (const WordSample& s : all.samples) {
    if (s.group != "b") continue;
    const Decision d = recognizer.recognise(s.samples, kToneRateHz);
    const bool yes = d.status == DecisionStatus::recognised;
    if (s.label == "wide" || s.label == "edge") {
      strangers_accepted += yes ? 1 : 0;
    } else {
      ++words;
      accepted += yes && d.label == s.label ? 1 : 0;
    }
  }
  EXPECT_GT(2 * accepted, words);  // trained on two speakers, spoken by a third
  EXPECT_LE(strangers_accepted, 1);
  Random random(9);
  for (int i = 0; i < 10; ++i) {
    std::vector<float> burst(kToneRateHz);
    for (std::size_t n = 0; n < burst.size(); ++n) {
      const bool on = n > 4000 && n < 8000 + 500 * static_cast<std::size_t>(i);
      burst[n] = static_cast<float>((on ? 0.1 : 0.001) * random.normal());
    }
    EXPECT_NE(recognizer.recognise(burst, kToneRateHz).status, DecisionStatus::recognised) << i;
  }
}

}  // namespace
}  // namespace hri
