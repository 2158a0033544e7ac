// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/subword/subword_recognizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr int kRateHz = 8000;

// Words of three "phones", each a chord of its own.
std::vector<float> say(const std::string& phones, double pitch, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> x(kRateHz / 5);
  double phase = 0;
  double other = 0;
  for (const char phone : phones) {
    const double hz = pitch * (phone == 'a' ? 400 : phone == 'b' ? 900 : 1800);
    for (int n = 0; n < kRateHz * 3 / 25; ++n) {
      phase += 6.283185307 * hz / kRateHz;
      other += 6.283185307 * 1.6 * hz / kRateHz;
      x.push_back(static_cast<float>(0.2 * std::sin(phase) + 0.1 * std::sin(other)));
    }
  }
  x.resize(x.size() + kRateHz / 5);
  for (float& sample : x) sample += static_cast<float>(0.001 * random.normal());
  return x;
}

struct Recordings {
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
};

Recordings recordings(const std::vector<std::string>& words) {
  Recordings made;
  made.audio.reserve(words.size() * 6);
  std::uint64_t seed = 1;
  for (const char* person : {"low", "middle", "high"}) {
    const double pitch = 0.95 + 0.02 * static_cast<double>(seed % 3);
    for (const std::string& word : words) {
      for (int take = 0; take < 2; ++take) {
        made.audio.push_back(say(word, pitch, seed++));
        made.samples.push_back({made.audio.back(), kRateHz, word, person});
      }
    }
  }
  return made;
}

htk::Dictionary lexicon_of(const std::vector<std::string>& words) {
  htk::Dictionary lexicon;
  for (const std::string& word : words) {
    htk::Pronunciation entry;
    entry.word = word;
    for (const char phone : word) entry.models.emplace_back(1, phone);
    lexicon.entries.push_back(entry);
  }
  return lexicon;
}

const std::vector<std::string>& heard() {
  static const std::vector<std::string> words{"abc", "cab", "bca", "acb"};
  return words;
}

SubwordRecognizerOptions fast() {
  SubwordRecognizerOptions options;
  options.words.num_vtlp_factors = 1;
  options.num_passes = 2;
  options.num_folds = 2;
  options.num_word_folds = 2;
  return options;
}

const SubwordRecognizer& trained() {
  static const SubwordRecognizer recognizer =
      SubwordRecognizer::train(recordings(heard()).samples, lexicon_of(heard()), fast());
  return recognizer;
}

std::string heard_as(const SubwordRecognizer& words, const std::string& phones,
                     std::uint64_t seed) {
  const Decision decision = words.recognise(say(phones, 1, seed), kRateHz);
  return decision.nbest.empty() ? decision.label : decision.nbest.front().label;
}

TEST(SubwordRecognizer, RecognisesWordsByTheirUnits) {
  EXPECT_EQ(trained().labels(), (std::vector<std::string>{"abc", "acb", "bca", "cab"}));
  EXPECT_EQ(trained().units().names.size(), 4U);  // three, and silence
  for (const std::string& word : heard()) EXPECT_EQ(heard_as(trained(), word, 77), word);
}

TEST(SubwordRecognizer, HoldsRecordingsOutWhereEachSpeakerHasAUnitAlone) {
  std::vector<WordSample> samples;
  const std::vector<std::string> words{"abc", "bad", "eba"};
  const Recordings made = recordings(words);
  for (const WordSample& sample : made.samples) {
    const bool low = sample.group == "low";
    if (sample.group != "middle" && sample.label != (low ? "eba" : "bad"))
      samples.push_back(sample);
  }
  EXPECT_TRUE(
      SubwordRecognizer::train(samples, lexicon_of(words), fast()).calibration().is_fitted());
}

TEST(SubwordRecognizer, RecognisesAWordThatWasNeverRecorded) {
  const SubwordRecognizer more = trained().with_word("new", {{"b", "a", "c"}});
  EXPECT_EQ(heard_as(more, "bac", 91), "new");
  EXPECT_NE(heard_as(trained(), "bac", 91), "new");
  for (const std::string& word : heard()) EXPECT_EQ(heard_as(more, word, 78), word);
  EXPECT_EQ(more.unrecorded(), std::vector<std::string>{"new"});
  EXPECT_TRUE(more.without_word("new").unrecorded().empty());
  EXPECT_EQ(more.without_word("new").labels(), trained().labels());
}

TEST(SubwordRecognizer, TakesTheBestOfSeveralPronunciations) {
  const SubwordRecognizer more = trained().with_word("new", {{"b", "b", "b"}, {"b", "a", "c"}});
  EXPECT_EQ(heard_as(more, "bac", 92), "new");
  EXPECT_EQ(heard_as(more, "bbb", 93), "new");
}

TEST(SubwordRecognizer, AddsTheBonusToUnrecordedWordsAlone) {
  SubwordRecognizerOptions options = trained().options();
  options.unrecorded_bonus = 0;
  const std::vector<float> audio = say("bac", 1, 94);
  const auto at = [&](double bonus) {
    options.unrecorded_bonus = bonus;
    const SubwordRecognizer made(options, trained().lexicon(), trained().units(), {});
    return made.with_word("new", {{"b", "a", "c"}}).scores(audio, kRateHz);
  };
  const VectorF difference = at(2.5) - at(0);
  EXPECT_NEAR(difference[4], 2.5F, 1e-5F);  // "new" comes last
  EXPECT_EQ(difference.head(4).cwiseAbs().maxCoeff(), 0);
}

TEST(SubwordRecognizer, MovesTheUnitsOfAWordTowardsItsRecordings) {
  // A pronunciation that is wrong in one unit.
  const std::vector<std::vector<std::string>> wrong{{"b", "a", "a"}};
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> samples;
  audio.reserve(3);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    audio.push_back(say("bac", 1, 200 + seed));
    samples.push_back({audio.back(), kRateHz, "new", ""});
  }
  const std::vector<float> test = say("bac", 1, 300);
  const SubwordRecognizer without = trained().with_word("new", wrong);
  const SubwordRecognizer with = trained().with_word("new", wrong, samples);
  EXPECT_GT(with.scores(test, kRateHz)[4],
            without.scores(test, kRateHz)[4] -
                static_cast<float>(trained().options().unrecorded_bonus) + 0.5F);
  EXPECT_TRUE(with.unrecorded().empty());
  EXPECT_EQ(with.units().names.size(), trained().units().names.size() + 3);
  EXPECT_EQ(with.without_word("new").units().names, trained().units().names);
  // A word whose name begins alike keeps its units.
  const SubwordRecognizer both = with.with_word("new/0", wrong, samples);
  EXPECT_EQ(both.without_word("new").units().names.size(), with.units().names.size());
  // Other words keep their models.
  EXPECT_EQ(with.scores(test, kRateHz).head(4), without.scores(test, kRateHz).head(4));
}

TEST(SubwordRecognizer, ReadsBackWhatItWrote) {
  const SubwordRecognizer more = trained().with_word("new", {{"b", "a", "c"}, {"b", "a"}});
  const SubwordRecognizer read = SubwordRecognizer::from_model_file(
      ModelFile::parse(more.to_model_file().serialise(), "memory"));
  const std::vector<float> audio = say("bac", 1, 95);
  EXPECT_EQ(read.scores(audio, kRateHz), more.scores(audio, kRateHz));
  EXPECT_EQ(read.labels(), more.labels());
  EXPECT_EQ(read.unrecorded(), more.unrecorded());
  EXPECT_EQ(read.calibration().threshold(), more.calibration().threshold());
  ModelFile other = more.to_model_file();
  other.set_text_list("unrecorded", {"missing"});
  EXPECT_THROW(SubwordRecognizer::from_model_file(other), FormatError);
  other = more.to_model_file();
  other.set_text("lexicon", "abc a b\nacb a x\nbca b\ncab c\nnew b\n");
  EXPECT_THROW(SubwordRecognizer::from_model_file(other), FormatError);
  other = more.to_model_file();
  other.set_vector("final_stays", VectorD(VectorD::Constant(4, 1.5)));
  EXPECT_THROW(SubwordRecognizer::from_model_file(other), FormatError);
}

TEST(SubwordRecognizer, HearsNoInputInSilence) {
  EXPECT_EQ(trained().recognise(std::vector<float>(kRateHz), kRateHz).status,
            DecisionStatus::no_input);
  EXPECT_EQ(trained().scores(std::vector<float>(kRateHz), kRateHz).size(), 0);
}

TEST(SubwordRecognizer, RefusesBadInput) {
  const Recordings all = recordings(heard());
  EXPECT_THROW(SubwordRecognizer::train(all.samples, lexicon_of({"abc", "cab"}), fast()),
               InvalidArgument);
  htk::Dictionary reserved = lexicon_of(heard());
  reserved.entries[1].models[0] = UnitModels::kSilence;
  EXPECT_THROW(SubwordRecognizer::train(all.samples, reserved, fast()), InvalidArgument);
  reserved.entries[1].models[0] = "a/b";
  EXPECT_THROW(SubwordRecognizer::train(all.samples, reserved, fast()), InvalidArgument);
  EXPECT_THROW(SubwordRecognizer::train({}, lexicon_of(heard()), fast()), InvalidArgument);
  SubwordRecognizerOptions options = fast();
  options.variance_floor = 0;
  EXPECT_THROW(SubwordRecognizer::train(all.samples, lexicon_of(heard()), options),
               InvalidArgument);
  EXPECT_THROW(trained().with_word("new", {}), InvalidArgument);
  EXPECT_THROW(trained().with_word("new", {{}}), InvalidArgument);
  EXPECT_THROW(trained().with_word("new", {{"a", "x"}}), InvalidArgument);
  EXPECT_THROW(trained().with_word("abc", {{"a", "b"}}), InvalidArgument);
  EXPECT_THROW(trained().without_word("new"), InvalidArgument);
  const std::vector<float> silence(kRateHz);
  EXPECT_THROW(trained().with_word("new", {{"a"}}, {{silence, kRateHz, "new", ""}}),
               InvalidArgument);
  std::vector<float> bad = say("abc", 1, 1);
  bad[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(trained().recognise(bad, kRateHz)), InvalidArgument);
}

TEST(SubwordRecognizer, StopsWhenAsked) {
  EXPECT_THROW(SubwordRecognizer::train(recordings(heard()).samples, lexicon_of(heard()), fast(),
                                        {}, [] { return true; }),
               Interrupted);
}

}  // namespace
}  // namespace hri
