// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;
using testing_data::tone_clips;

constexpr double kFlat = 0;      // Hz a second
constexpr double kSteep = 2500;  // far steeper than the words of the vocabulary

struct OtherWords {
  std::vector<std::vector<float>> audio;
  std::vector<WordSample> words;
};

// Two words outside the vocabulary, by another voice than any in the training.
OtherWords other_words() {
  OtherWords result;
  result.audio.reserve(6);
  for (std::uint64_t take = 0; take < 3; ++take) {
    for (const double slope : {kFlat, kSteep}) {
      result.audio.push_back(tone(680, slope, 50 + take));
      result.words.push_back({result.audio.back(), kRateHz, slope == kFlat ? "flat" : "steep", ""});
    }
  }
  return result;
}

WordRecognizer trained_beside(const std::vector<WordSample>& others,
                              SequenceModelKind kind = SequenceModelKind::hmm) {
  WordRecognizerOptions options;
  options.model = kind;
  options.max_iterations = 4;
  options.min_snr_db = 10;  // gliding tones are all alike in more noise
  return WordRecognizer::train(tone_clips().samples, options, {}, {}, others);
}

TEST(FillerWords, RejectWordsOutsideTheVocabulary) {
  const OtherWords others = other_words();
  const WordRecognizer with = trained_beside(others.words);
  const WordRecognizer without = trained_beside({});
  ASSERT_EQ(with.verifier().word_weights().size(), 1);
  EXPECT_GT(with.verifier().word_weights()[0], 0);
  for (const double slope : {kFlat, kSteep}) {
    const std::vector<float> strange = tone(590, slope, 90);
    EXPECT_EQ(with.recognise(strange, kRateHz).status, DecisionStatus::unknown) << slope;
    // The scores of the vocabulary are what they were: only rejection uses other_words.
    EXPECT_EQ(with.scores(strange, kRateHz), without.scores(strange, kRateHz));
  }
  const Decision known = with.recognise(tone(560, 800, 91), kRateHz);
  EXPECT_EQ(known.label, "rise");
  EXPECT_GT(known.score, 0);
}

TEST(FillerWords, AreSavedInTheFile) {
  const OtherWords others = other_words();
  const WordRecognizer before = trained_beside(others.words);
  ModelFile file = before.to_model_file();
  EXPECT_EQ(file.integer("stream.0.num_background"), 2);
  const std::vector<float> clip = tone(590, kFlat, 92);
  EXPECT_EQ(WordRecognizer::from_model_file(file).recognise(clip, kRateHz).score,
            before.recognise(clip, kRateHz).score);
  for (const int number : {-1, 1, 3, 1000000}) {
    file.set_integer("stream.0.num_background", number);
    EXPECT_THROW(WordRecognizer::from_model_file(file), FormatError) << number;
  }
}

TEST(FillerWords, AdaptToTheSpeakerAsTheVocabularyDoes) {
  SequenceModelOptions options;
  options.num_states = 2;
  options.garbage_mixtures = 2;
  Random random(3);
  const auto near = [&](double mean) {
    std::vector<MatrixF> sequences(3, MatrixF(8, 2));
    for (MatrixF& m : sequences) {
      for (Eigen::Index i = 0; i < m.size(); ++i)
        m.data()[i] = static_cast<float>(mean + random.normal());
    }
    return sequences;
  };
  const FillerModels other_words = train_fillers(ClassSequences{near(8)}, options, {});
  const auto scorer = train_sequence_scorer({near(0), near(4)}, options, {}, other_words);
  ASSERT_EQ(scorer->num_fillers(), 1);
  AdaptationOptions adaptation;
  adaptation.shared_frames = 1;
  adaptation.each_class = false;
  // Everything of this speaker lies two higher, the word outside the vocabulary too.
  const auto adapted = scorer->adapted({near(2), near(6)}, adaptation);
  const MatrixF strange = near(10).front();
  EXPECT_GT(adapted->filler_scores(strange)[0], scorer->filler_scores(strange)[0] + 5);
}

TEST(FillerWords, AreIgnoredByPossibilityTheory) {
  const OtherWords others = other_words();
  const WordRecognizer with = trained_beside(others.words, SequenceModelKind::ptbhmm);
  const WordRecognizer without = trained_beside({}, SequenceModelKind::ptbhmm);
  const std::vector<float> clip = tone(560, 800, 93);
  EXPECT_EQ(with.recognise(clip, kRateHz).score, without.recognise(clip, kRateHz).score);
  SequenceModelOptions options;
  options.model = SequenceModelKind::ptbhmm;
  const ClassSequences sequences{{MatrixF::Zero(8, 2)}, {MatrixF::Ones(8, 2)}};
  const FillerModels other_words = train_fillers(sequences, {}, {});
  EXPECT_THROW(train_sequence_scorer(sequences, options, {}, other_words), InvalidArgument);
}

TEST(FillerWords, RefuseAudioThatIsNotFinite) {
  OtherWords others = other_words();
  others.audio[1][5] = std::numeric_limits<float>::quiet_NaN();
  try {
    trained_beside(others.words);
    FAIL() << "took a sample that is not a number";
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("fillers[1]: audio is not finite at index 5"),
              std::string::npos)
        << error.what();
  }
  // A filler without speech is left out.
  const std::vector<float> silence(kRateHz, 0.0F);
  const WordRecognizer silent = trained_beside({{silence, kRateHz, "nothing", ""}});
  EXPECT_EQ(silent.to_model_file().integer("stream.0.num_background"), 0);
}

}  // namespace
}  // namespace hri
