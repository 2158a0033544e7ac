// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

// Three takes of a tone of the given slope.
struct Takes {
  Takes(const std::string& label, double slope_hz_per_s, double base_hz, std::uint64_t seed) {
    for (std::uint64_t take = 0; take < 3; ++take)
      audio.push_back(tone(base_hz, slope_hz_per_s, seed + take));
    for (const auto& clip : audio) samples.push_back({clip, kRateHz, label, ""});
  }
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
};

std::string what_of(const WordRecognizer& recognizer, const std::vector<WordSample>& samples) {
  try {
    (void)recognizer.with_word(samples);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

class WordAddition : public ::testing::TestWithParam<SequenceModelKind> {
 protected:
  WordAddition()
      : known_(testing_data::tone_clips()),
        flat_("flat", 0, 600, 100),
        recognizer_(trained(known_)) {}

  static WordRecognizer trained(const testing_data::Clips& clips) {
    WordRecognizerOptions options;
    options.model = GetParam();
    return WordRecognizer::train(clips.samples, options);
  }

  testing_data::Clips known_;
  Takes flat_;
  WordRecognizer recognizer_;
};

TEST_P(WordAddition, KnowsTheNewWordAndTheOthers) {
  const WordRecognizer more = recognizer_.with_word(flat_.samples);
  EXPECT_EQ(more.labels(), (std::vector<std::string>{"fall", "flat", "rise"}));
  EXPECT_EQ(recognizer_.labels().size(), 2U);
  for (const double base_hz : {570.0, 630.0})
    EXPECT_EQ(more.recognise(tone(base_hz, 0, 200), kRateHz).nbest.front().label, "flat");
  for (const WordSample& s : known_.samples)
    EXPECT_EQ(more.recognise(s.samples, kRateHz).nbest.front().label, s.label);
}

TEST_P(WordAddition, LeavesTheModelsOfTheOthersToTheBit) {
  const WordRecognizer more = recognizer_.with_word(flat_.samples);
  // "flat" stands between "fall" (0) and "rise" (1), which becomes 2.
  const ModelFile before = recognizer_.to_model_file();
  const ModelFile after = more.to_model_file();
  const bool hmm = GetParam() == SequenceModelKind::hmm;
  for (const char* stream : {"stream.0.", "stream.1."}) {
    for (const auto& [old_index, index] : {std::pair{0, 0}, std::pair{1, 2}}) {
      const std::string kind = std::string(stream) + (hmm ? "hmm." : "ptbhmm.");
      const char* emission = hmm ? ".means" : ".emission";
      EXPECT_EQ(after.matrix_d(kind + std::to_string(index) + emission),
                before.matrix_d(kind + std::to_string(old_index) + emission));
      EXPECT_EQ(after.matrix_d(kind + std::to_string(index) + ".transition"),
                before.matrix_d(kind + std::to_string(old_index) + ".transition"));
    }
  }
  for (const WordSample& s : known_.samples) {
    const VectorF old_scores = recognizer_.scores(s.samples, kRateHz);
    const VectorF scores = more.scores(s.samples, kRateHz);
    if (hmm) {
      EXPECT_EQ(scores[0], old_scores[0]);
      EXPECT_EQ(scores[2], old_scores[1]);
    } else {  // possibilities are scaled over all classes: all of the others fall alike
      EXPECT_NEAR(scores[0] - scores[2], old_scores[0] - old_scores[1], 1e-3);
      EXPECT_LE(scores[0], old_scores[0] + 1e-3);
    }
  }
}

TEST_P(WordAddition, RemovedWordsLeaveNoTrace) {
  const WordRecognizer more = recognizer_.with_word(flat_.samples);
  EXPECT_EQ(more.without_word("flat").to_model_file().serialise(),
            recognizer_.to_model_file().serialise());
  EXPECT_EQ(more.without_word("fall").labels(), (std::vector<std::string>{"flat", "rise"}));
  EXPECT_THROW((void)more.without_word("fly"), InvalidArgument);
  EXPECT_THROW((void)recognizer_.without_word("fall"), InvalidArgument);
}

TEST_P(WordAddition, LoadsWhatItSavedToTheBit) {
  const WordRecognizer more = recognizer_.with_word(flat_.samples);
  const std::vector<std::uint8_t> bytes = more.to_model_file().serialise();
  const WordRecognizer again = WordRecognizer::from_model_file(ModelFile::parse(bytes, "x"));
  EXPECT_EQ(again.to_model_file().serialise(), bytes);
  EXPECT_EQ(again.scores(flat_.audio[0], kRateHz), more.scores(flat_.audio[0], kRateHz));
}

TEST_P(WordAddition, OneRecordingIsEnough) {
  const WordRecognizer more = recognizer_.with_word({flat_.samples.front()});
  EXPECT_EQ(more.recognise(flat_.audio[1], kRateHz).nbest.front().label, "flat");
}

TEST_P(WordAddition, StopsWhenAsked) {
  int polls = 0;
  EXPECT_THROW((void)recognizer_.with_word(flat_.samples, [&] { return ++polls == 5; }),
               Interrupted);
  EXPECT_EQ(polls, 5);
}

std::string name_of_model(const ::testing::TestParamInfo<SequenceModelKind>& test) {
  return test.param == SequenceModelKind::hmm ? "hmm" : "ptbhmm";
}

INSTANTIATE_TEST_SUITE_P(Models, WordAddition,
                         ::testing::Values(SequenceModelKind::hmm, SequenceModelKind::ptbhmm),
                         name_of_model);

TEST(WordAdditionOf, BadRecordingsIsRefusedByName) {
  const testing_data::Clips known = testing_data::tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(known.samples, {});
  const Takes flat("flat", 0, 600, 100);
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(what_of(recognizer, {}), "at least one recording"));

  std::vector<WordSample> samples = flat.samples;
  samples[1].label = "other";
  EXPECT_TRUE(has(what_of(recognizer, samples), "samples[1]: label 'other'"));
  for (const char* label : {"rise", "unknown", ""}) {
    for (WordSample& s : samples) s.label = label;
    EXPECT_TRUE(has(what_of(recognizer, samples), "label")) << label;
  }

  samples = flat.samples;
  const std::vector<float> silence(8000, 0.0F);
  samples[2].samples = silence;
  EXPECT_TRUE(has(what_of(recognizer, samples), "samples[2]: audio has no speech"));
  samples[2].samples = samples[2].samples.subspan(0, 20);
  EXPECT_TRUE(has(what_of(recognizer, samples), "samples[2]: audio is too short"));
  std::vector<float> broken = flat.audio[0];
  broken[123] = std::numeric_limits<float>::quiet_NaN();
  samples[2].samples = broken;
  samples[2].name = "dance_3.wav";
  EXPECT_TRUE(has(what_of(recognizer, samples), "dance_3.wav: audio is not finite at index 123"));
}

TEST(WordAdditionOf, ModelFilesWithWildCopiesIsRefused) {
  const testing_data::Clips known = testing_data::tone_clips();
  const ModelFile sound = WordRecognizer::train(known.samples, {}).to_model_file();
  for (const auto& [option, value] :
       {std::pair{"num_vtlp_factors", 2000000000}, std::pair{"num_noisy_copies", 2000000000}}) {
    ModelFile file = sound;
    file.set_integer(option, value);
    try {
      WordRecognizer::from_model_file(file);
      FAIL() << option;
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
    }
  }
}

// Added classes raise what possibilities are scaled by: the ratio to the garbage model stays.
TEST(PtbhmmScorer, KeepsTheRatiosOfOtherClassesWhenOneIsAdded) {
  const auto steps = [](float level, std::uint64_t seed) {
    Random random(seed);
    MatrixF frames(24, 2);
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
      frames(t, 0) = static_cast<float>((t < 12 ? level : -level) + 0.7 * random.normal());
      frames(t, 1) = static_cast<float>(random.normal());
    }
    return frames;
  };
  SequenceModelOptions options;
  options.model = SequenceModelKind::ptbhmm;
  options.num_states = 3;
  options.num_codewords = 16;
  ClassSequences sequences(2);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    sequences[0].push_back(steps(2, seed));
    sequences[1].push_back(steps(-2, seed + 50));
  }
  const auto plain = train_sequence_scorer(sequences, options, {});
  const MatrixF heard = steps(2, 99);
  EXPECT_EQ(plain->garbage_score(heard), 0);
  const auto more = plain->with_class(1, {heard.topRows(3)}, 100, {});
  ASSERT_LT(more->scores(heard)[0], plain->scores(heard)[0] - 1);
  const auto ratio = [&](const SequenceScorer& scorer, Eigen::Index c) {
    return scorer.scores(heard)[c] - scorer.garbage_score(heard);
  };
  EXPECT_NEAR(ratio(*more, 0), ratio(*plain, 0), 1e-3);
  EXPECT_NEAR(ratio(*more, 2), ratio(*plain, 1), 1e-3);
  ModelFile file;
  more->write(file, "x.");
  const auto read = read_sequence_scorer(file, "x.", options, 3, 2);
  EXPECT_EQ(read->garbage_score(heard), more->garbage_score(heard));
  const auto less = more->without_class(1);
  EXPECT_EQ(less->garbage_score(heard), 0);
  EXPECT_EQ(less->scores(heard), plain->scores(heard));
  file.set_number("x.ptbhmm.trained_transition", -1);
  EXPECT_THROW(read_sequence_scorer(file, "x.", options, 3, 2), FormatError);
}

}  // namespace
}  // namespace hri
