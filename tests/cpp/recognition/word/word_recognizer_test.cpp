// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_recognizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"
#include "hri/io/wav.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::Clips;
using testing_data::kRateHz;
using testing_data::tone;
using testing_data::tone_clips;

class WordRecognizerOf : public ::testing::TestWithParam<SequenceModelKind> {
 protected:
  static WordRecognizerOptions options() {
    WordRecognizerOptions o;
    o.model = GetParam();
    return o;
  }
};

TEST_P(WordRecognizerOf, RecognisesASpeakerItWasNotTrainedOn) {
  const Clips all = tone_clips();
  std::vector<WordSample> train;
  for (const WordSample& s : all.samples) {
    if (s.group != "middle") train.push_back(s);
  }
  const WordRecognizer recognizer = WordRecognizer::train(train, options());
  EXPECT_EQ(recognizer.labels(), (std::vector<std::string>{"fall", "rise"}));
  for (const WordSample& s : all.samples) {
    const Decision d = recognizer.recognise(s.samples, kRateHz);
    ASSERT_EQ(d.nbest.size(), 2U);
    EXPECT_EQ(d.nbest[0].label, s.label) << s.group;
    EXPECT_NEAR(d.nbest[0].probability + d.nbest[1].probability, 1, 1e-5);
  }
}

TEST_P(WordRecognizerOf, LoadsWhatItSavedToTheBit) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, options());
  const ModelFile file = recognizer.to_model_file();
  const WordRecognizer again =
      WordRecognizer::from_model_file(ModelFile::parse(file.serialise(), "x"));
  for (const WordSample& s : all.samples) {
    EXPECT_EQ(again.scores(s.samples, kRateHz), recognizer.scores(s.samples, kRateHz));
    EXPECT_EQ(again.recognise(s.samples, kRateHz).confidence,
              recognizer.recognise(s.samples, kRateHz).confidence);
  }
  EXPECT_EQ(again.to_model_file().serialise(), file.serialise());
}

TEST_P(WordRecognizerOf, StopsWhenAsked) {
  const Clips all = tone_clips();
  int polls = 0;
  EXPECT_THROW(WordRecognizer::train(all.samples, options(), {}, [&] { return ++polls == 3; }),
               Interrupted);
  EXPECT_EQ(polls, 3);
}

std::string model_name(const ::testing::TestParamInfo<SequenceModelKind>& test) {
  constexpr const char* kNames[] = {"hmm", "ptbhmm"};
  return kNames[static_cast<std::size_t>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Models, WordRecognizerOf,
                         ::testing::Values(SequenceModelKind::hmm, SequenceModelKind::ptbhmm),
                         model_name);

TEST(WordRecognizer, ReportsEveryStepOfTraining) {
  const Clips all = tone_clips();  // of three speakers, so that there are three folds
  const std::vector<float> audio = tone(700, 100, 60);
  const std::vector<WordSample> fillers(2, {audio, kRateHz, "flat", ""});
  for (const bool with_fillers : {false, true}) {
    std::vector<int> steps;
    // Recordings of both kinds, then models of three folds and those that are kept.
    const auto num_samples = static_cast<int>(all.samples.size());
    const int total = num_samples + (with_fillers ? 2 : 0) + 4 * (1 + num_samples / 2);
    const auto report = [&](int done, int of) {
      EXPECT_EQ(of, total);
      steps.push_back(done);
    };
    WordRecognizer::train(all.samples, {}, report, {},
                          with_fillers ? fillers : std::vector<WordSample>{});
    // Recordings that other threads read are reported with the next of this one.
    EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
    EXPECT_EQ(steps.front(), 0);
    EXPECT_EQ(steps.back(), total);
    EXPECT_GT(std::count_if(steps.begin(), steps.end(),
                            [num_samples](int done) { return done > 0 && done < num_samples; }),
              0);
  }
}

TEST(WordRecognizer, HoldsRecordingsOutWhereEachSpeakerAloneSaidAWord) {
  std::vector<std::vector<float>> audio;
  std::vector<std::pair<std::string, std::string>> names;
  std::uint64_t seed = 0;
  const auto say = [&](const char* word, const char* person, double base_hz, double slope) {
    for (int take = 0; take < 3; ++take) {
      audio.push_back(tone(base_hz, slope, seed++));
      names.emplace_back(word, person);
    }
  };
  for (const char* person : {"asha", "ravi"}) {
    say("rise", person, 500, 800);
    say("fall", person, 500, -350);
  }
  say("flat", "asha", 900, 0);
  say("high", "ravi", 1500, 0);
  std::vector<WordSample> samples;
  for (std::size_t i = 0; i < audio.size(); ++i)
    samples.push_back({audio[i], kRateHz, names[i].first, names[i].second});
  const WordRecognizer recognizer = WordRecognizer::train(samples, {});
  EXPECT_TRUE(recognizer.calibration().is_fitted());
  EXPECT_EQ(recognizer.held_out().num_samples(), 18);
  // One recording of a word leaves nothing to hold out.
  const WordRecognizer of_one =
      WordRecognizer::train({samples[0], samples[3], samples[12], samples[15]}, {});
  EXPECT_FALSE(of_one.calibration().is_fitted());
  EXPECT_TRUE(of_one.held_out().empty());
  const ModelFile file = ModelFile::parse(of_one.to_model_file().serialise(), "x");
  EXPECT_FALSE(WordRecognizer::from_model_file(file).calibration().is_fitted());
}

TEST(WordRecognizer, ReportsNoInputForSilence) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, {});
  for (const float level : {0.0F, 0.3F}) {
    const Decision d = recognizer.recognise(std::vector<float>(8000, level), kRateHz);
    EXPECT_EQ(d.status, DecisionStatus::no_input);
    EXPECT_TRUE(d.nbest.empty());
  }
}

TEST(WordRecognizer, RefusesBadAudioAndBadSets) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, {});
  std::vector<float> broken = all.audio[0];
  broken[123] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)recognizer.recognise(broken, kRateHz), InvalidArgument);
  EXPECT_THROW((void)recognizer.recognise(std::vector<float>(5), kRateHz), InvalidArgument);
  EXPECT_THROW((void)recognizer.recognise(all.audio[0], 10), InvalidArgument);
  EXPECT_THROW(WordRecognizer::train({}, {}), InvalidArgument);
  EXPECT_THROW(WordRecognizer::train({all.samples[0]}, {}), InvalidArgument);
  std::vector<WordSample> with_click = all.samples;
  with_click[4].samples = with_click[4].samples.subspan(0, 20);
  try {
    WordRecognizer::train(with_click, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("samples[4]: audio is too short"), std::string::npos);
  }
  std::vector<WordSample> with_silence = all.samples;
  const std::vector<float> silence(8000, 0.0F);
  with_silence.push_back({silence, kRateHz, "quiet", "low"});
  try {
    WordRecognizer::train(with_silence, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("quiet"), std::string::npos);
  }
}

TEST(WordRecognizer, RefusesModelsOfAnotherKindOrWithHoles) {
  const Clips all = tone_clips();
  ModelFile file = WordRecognizer::train(all.samples, {}).to_model_file();
  ModelFile other = file;
  other.set_kind("gesture_recognizer");
  EXPECT_THROW(WordRecognizer::from_model_file(other), FormatError);
  ModelFile fewer = file;
  fewer.set_text_list("labels", {"only one"});
  EXPECT_THROW(WordRecognizer::from_model_file(fewer), FormatError);
  file.set_integer("cepstra.num_filters", -3);
  EXPECT_THROW(WordRecognizer::from_model_file(file), FormatError);
}

TEST(WordRecognizer, AnswersTheSameInEveryThread) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, {});
  const VectorF expected = recognizer.scores(all.audio[0], kRateHz);
  std::vector<VectorF> found(4);
  std::vector<std::thread> threads;
  for (VectorF& f : found)
    threads.emplace_back([&] { f = recognizer.scores(all.audio[0], kRateHz); });
  for (std::thread& t : threads) t.join();
  for (const VectorF& f : found) EXPECT_EQ(f, expected);
}

TEST(WordRecognizer, IsTheSameFromAnyNumberOfThreads) {
  const Clips all = tone_clips();
  const std::vector<WordSample> fillers(all.samples.begin(), all.samples.begin() + 2);
  std::vector<std::vector<std::uint8_t>> models;
  for (const int count : {1, 2, 3}) {
    set_num_threads(count);
    WordRecognizerOptions options;
    options.num_noisy_copies = 1;
    models.push_back(
        WordRecognizer::train(all.samples, options, {}, {}, fillers).to_model_file().serialise());
  }
  set_num_threads(0);
  EXPECT_EQ(models[0], models[1]);
  EXPECT_EQ(models[0], models[2]);
}

}  // namespace
}  // namespace hri
