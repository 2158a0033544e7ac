// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/speaker_adapter.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;
using testing_data::tone_clips;

WordRecognizer trained_to_adapt(SequenceModelKind kind = SequenceModelKind::hmm) {
  WordRecognizerOptions options;
  options.model = kind;
  options.max_iterations = 4;
  return WordRecognizer::train(tone_clips().samples, options);
}

// A voice far above those of the training.
std::vector<float> strange(bool rises, std::uint64_t seed) {
  return tone(1100, rises ? 800 : -350, seed);
}

TEST(SpeakerAdapter, BeginsAsTheRecogniser) {
  const WordRecognizer recognizer = trained_to_adapt();
  SpeakerAdapter adapter(recognizer);
  const std::vector<float> clip = strange(true, 1);
  EXPECT_EQ(adapter.recognizer().scores(clip, kRateHz), recognizer.scores(clip, kRateHz));
  EXPECT_EQ(adapter.recognise(clip, kRateHz).nbest.front().log_score,
            recognizer.recognise(clip, kRateHz).nbest.front().log_score);
  EXPECT_EQ(adapter.num_words(), 1);
}

TEST(SpeakerAdapter, AdaptsSupervised) {
  SpeakerAdapterOptions options;
  options.words_per_label = 0;
  SpeakerAdapter adapter(trained_to_adapt(), options);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    adapter.learn(strange(true, seed), kRateHz, "rise");
    adapter.learn(strange(false, seed), kRateHz, "fall");
  }
  const WordRecognizer before = adapter.recognizer();
  EXPECT_TRUE(adapter.update_due());
  adapter.update();
  EXPECT_FALSE(adapter.update_due());
  EXPECT_EQ(adapter.num_learned(), 6);
  const auto margin = [](const WordRecognizer& r, bool rises) {  // labels: fall, rise
    const VectorF s = r.scores(strange(rises, 9), kRateHz);
    return rises ? s[1] - s[0] : s[0] - s[1];
  };
  EXPECT_GT(margin(adapter.recognizer(), true), margin(before, true));
  EXPECT_GT(margin(adapter.recognizer(), false), margin(before, false));
}

TEST(SpeakerAdapter, AdaptsUnsupervised) {
  SpeakerAdapterOptions options;
  options.trusted_share = 1;
  WordRecognizerOptions lax;
  lax.false_reject_rate = 0;
  lax.max_iterations = 4;
  const WordRecognizer recognizer = WordRecognizer::train(tone_clips().samples, lax);
  SpeakerAdapter adapter(recognizer, options);
  // The voices of the training at another level of noise are accepted for certain.
  for (std::uint64_t seed = 100; seed < 112; ++seed) {
    adapter.recognise(tone(560, seed % 2 == 0 ? 800 : -350, seed), kRateHz);
    if (adapter.update_due()) adapter.update();
  }
  const std::vector<float> clip = tone(560, 800, 200);
  EXPECT_GT(adapter.recognizer().scores(clip, kRateHz)[1], recognizer.scores(clip, kRateHz)[1]);
  adapter.reset();
  EXPECT_EQ(adapter.num_words(), 0);
  EXPECT_EQ(adapter.recognizer().scores(clip, kRateHz), recognizer.scores(clip, kRateHz));
}

TEST(SpeakerAdapter, RemembersSoManyWordsOnly) {
  SpeakerAdapterOptions options;
  options.max_words = 3;
  SpeakerAdapter adapter(trained_to_adapt(), options);
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    adapter.learn(strange(true, seed), kRateHz, "rise");
  EXPECT_EQ(adapter.num_words(), 3);
}

TEST(SpeakerAdapter, RemembersNothingWithoutSpeech) {
  SpeakerAdapter adapter(trained_to_adapt());
  const std::vector<float> silence(kRateHz, 0.0F);
  EXPECT_EQ(adapter.recognise(silence, kRateHz).status, DecisionStatus::no_input);
  EXPECT_EQ(adapter.num_words(), 0);
  EXPECT_THROW(adapter.learn(silence, kRateHz, "rise"), InvalidArgument);
}

TEST(SpeakerAdapter, AdaptedModelsAreKeptInTheFile) {
  SpeakerAdapterOptions options;
  options.words_per_label = 0;
  SpeakerAdapter adapter(trained_to_adapt(), options);
  adapter.learn(strange(true, 1), kRateHz, "rise");
  adapter.update();
  const WordRecognizer again =
      WordRecognizer::from_model_file(adapter.recognizer().to_model_file());
  const std::vector<float> clip = strange(false, 2);
  EXPECT_EQ(again.scores(clip, kRateHz), adapter.recognizer().scores(clip, kRateHz));
}

TEST(SpeakerAdapter, StopsWhenAskedAndStaysAsItWas) {
  SpeakerAdapter adapter(trained_to_adapt());
  adapter.learn(strange(true, 1), kRateHz, "rise");
  const std::vector<float> clip = strange(false, 2);
  const VectorF before = adapter.recognizer().scores(clip, kRateHz);
  EXPECT_THROW(adapter.update([] { return true; }), Interrupted);
  EXPECT_EQ(adapter.recognizer().scores(clip, kRateHz), before);
  EXPECT_TRUE(adapter.update_due());
}

TEST(SpeakerAdapter, RefusesWhatItCannotDo) {
  EXPECT_THROW(SpeakerAdapter{trained_to_adapt(SequenceModelKind::ptbhmm)}, InvalidArgument);
  SpeakerAdapter adapter(trained_to_adapt());
  EXPECT_THROW(adapter.learn(strange(true, 1), kRateHz, "sideways"), InvalidArgument);
  SpeakerAdapterOptions options;
  options.trusted_share = 1.5;
  EXPECT_THROW(SpeakerAdapter(trained_to_adapt(), options), InvalidArgument);
}

}  // namespace
}  // namespace hri
