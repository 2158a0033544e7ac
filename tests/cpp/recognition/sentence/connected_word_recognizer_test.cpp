// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/connected_word_recognizer.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

// Tones last from 0.25 to 0.75 s of each clip.
const testing_data::Clips& clips() {
  static const testing_data::Clips made = testing_data::tone_clips();
  return made;
}

ConnectedWordRecognizerOptions small_options() {
  ConnectedWordRecognizerOptions options;
  options.words.num_states = 5;
  options.words.num_vtlp_factors = 1;
  options.words.num_noisy_copies = 1;
  options.words.min_snr_db = 10;
  options.max_words = 4;
  return options;
}

const ConnectedWordRecognizer& trained() {
  static const ConnectedWordRecognizer recognizer =
      ConnectedWordRecognizer::train(clips().samples, small_options());
  return recognizer;
}

// Words of a speaker who was not trained on, with `pause_s` between their tones.
std::vector<float> sentence(const std::vector<std::string>& words, double pause_s) {
  std::vector<float> audio(kRateHz / 5, 0.0F);
  std::uint64_t seed = 1000;
  for (const std::string& word : words) {
    const std::vector<float> clip = tone(575, word == "rise" ? 800 : -350, seed++);
    audio.insert(audio.end(), clip.begin() + kRateHz / 4, clip.begin() + 3 * kRateHz / 4);
    Random random(seed);
    for (int n = 0; n < static_cast<int>(pause_s * kRateHz); ++n)
      audio.push_back(static_cast<float>(0.001 * random.normal()));
  }
  audio.insert(audio.end(), kRateHz / 5, 0.0F);
  return audio;
}

std::vector<std::string> labels_of(const Transcript& transcript) {
  std::vector<std::string> labels;
  for (const TranscribedWord& word : transcript.words) labels.push_back(word.label);
  return labels;
}

const std::vector<std::string> kWords{"rise", "fall", "fall", "rise", "rise"};

TEST(ConnectedWordRecognizer, FindsWordsAndTheirTimes) {
  for (const double pause_s : {0.1, 0.3}) {
    const Transcript found = trained().recognise(sentence(kWords, pause_s), kRateHz);
    ASSERT_EQ(labels_of(found), kWords) << found.text();
    EXPECT_TRUE(found.complete);
    double first_s = 0.2;
    for (const TranscribedWord& word : found.words) {
      EXPECT_NEAR(word.first_s, first_s, 0.05);
      EXPECT_NEAR(word.last_s, first_s + 0.5, 0.05);
      first_s += 0.5 + pause_s;
    }
  }
}

TEST(ConnectedWordRecognizer, HearsWhereWordsBesidePausesBeginAndEnd) {
  // Hiss that no word was trained with leads to the first and the third tone and away from the
  // last.
  std::vector<float> audio = sentence({"rise", "fall", "rise"}, 0.3);
  Random random(3);
  const auto hiss = [&](double first_s, double last_s) {
    for (auto n = static_cast<std::size_t>(first_s * kRateHz); n < last_s * kRateHz; ++n)
      audio[n] += static_cast<float>(0.02 * random.normal());
  };
  hiss(0.1, 0.2);
  hiss(1.7, 1.8);
  hiss(2.3, 2.4);
  const ScoredRecording heard = trained().score(audio, kRateHz);
  ScoredRecording unheard = heard;
  unheard.activity.clear();
  const Transcript found = trained().recognise(heard, {0, 3});
  const Transcript decoded = trained().recognise(unheard, {0, 3});
  ASSERT_EQ(labels_of(found), (std::vector<std::string>{"rise", "fall", "rise"})) << found.text();
  EXPECT_NEAR(found.words[0].first_s, 0.1, 0.03);
  EXPECT_NEAR(found.words[2].first_s, 1.7, 0.03);
  EXPECT_NEAR(found.words[2].last_s, 2.4, 0.03);
  const auto no_later = [](const TranscribedWord& outer, const TranscribedWord& inner) {
    EXPECT_LE(outer.first_s, inner.first_s);
    EXPECT_GE(outer.last_s, inner.last_s);
    EXPECT_EQ(outer.label, inner.label);
    EXPECT_EQ(outer.log_score, inner.log_score);
    EXPECT_EQ(outer.confidence, inner.confidence);
  };
  // Nothing but times depends on it.
  EXPECT_EQ(found.log_score, decoded.log_score);
  ASSERT_EQ(found.words.size(), decoded.words.size());
  for (std::size_t i = 0; i < found.words.size(); ++i) no_later(found.words[i], decoded.words[i]);
  ASSERT_EQ(found.alternatives.size(), decoded.alternatives.size());
  for (std::size_t a = 0; a < found.alternatives.size(); ++a) {
    EXPECT_EQ(found.alternatives[a].log_score, decoded.alternatives[a].log_score);
    ASSERT_EQ(found.alternatives[a].words.size(), decoded.alternatives[a].words.size());
    for (std::size_t i = 0; i < found.alternatives[a].words.size(); ++i)
      no_later(found.alternatives[a].words[i], decoded.alternatives[a].words[i]);
  }
  EXPECT_EQ(found.alternatives[0].words[2].last_s, found.words[2].last_s);
  std::size_t num_decided = 0;
  const Transcript begun = trained().recognise_begun(heard, &num_decided);
  EXPECT_EQ(begun.words[0].first_s, found.words[0].first_s);
}

TEST(ConnectedWordRecognizer, FindsSoManyWordsAsThereAre) {
  const std::vector<float> audio = sentence(kWords, 0);
  const Transcript found = trained().recognise(audio, kRateHz, {5});
  EXPECT_EQ(labels_of(found), kWords) << found.text();
  EXPECT_EQ(trained().recognise(audio, kRateHz, {3}).words.size(), 3U);
  const Transcript too_many = trained().recognise(audio, kRateHz, {500});
  EXPECT_FALSE(too_many.complete);
}

TEST(ConnectedWordRecognizer, AlignsTheWordsItWouldFindAsItFindsThem) {
  const Grammar other =
      Grammar::parse("#JSGF V1.0;\ngrammar g;\npublic <s> = fall fall fall;", "g.jsgf");
  for (const double pause_s : {0.0, 0.3}) {
    const ScoredRecording recording = trained().score(sentence(kWords, pause_s), kRateHz);
    const Transcript found = trained().recognise(recording);
    ASSERT_EQ(labels_of(found), kWords) << found.text();
    // What it holds has no say.
    const Transcript same = trained().with_grammar(other).align(recording, kWords);
    EXPECT_TRUE(same.complete);
    EXPECT_EQ(same.log_score, found.log_score);
    ASSERT_EQ(labels_of(same), kWords);
    for (std::size_t i = 0; i < kWords.size(); ++i) {
      EXPECT_EQ(same.words[i].first_s, found.words[i].first_s);
      EXPECT_EQ(same.words[i].last_s, found.words[i].last_s);
      EXPECT_EQ(same.words[i].log_score, found.words[i].log_score);
      EXPECT_EQ(same.words[i].confidence, found.words[i].confidence);
    }
  }
}

TEST(ConnectedWordRecognizer, AlignsWordsThatWereNotSaidAndIsNotSureOfThem) {
  ConnectedWordRecognizerOptions options = small_options();
  options.min_confidence = 0.5;
  const auto recognizer = ConnectedWordRecognizer::train(clips().samples, options);
  const std::vector<std::string> wrong{"rise", "rise", "fall", "rise", "rise"};
  const Transcript transcript = recognizer.align(sentence(kWords, 0.1), kRateHz, wrong);
  EXPECT_TRUE(transcript.complete);
  ASSERT_EQ(labels_of(transcript), wrong);
  EXPECT_LT(*transcript.words[1].confidence, 0.5);
  EXPECT_GT(*transcript.words[2].confidence, 0.5);
  for (const TranscribedWord& word : transcript.words) EXPECT_FALSE(word.unknown);
  const Transcript unasked = recognizer.align(sentence(kWords, 0.1), kRateHz, wrong, false);
  EXPECT_EQ(unasked.log_score, transcript.log_score);
  EXPECT_FALSE(unasked.words[1].confidence.has_value());
}

TEST(ConnectedWordRecognizer, AlignsNoMoreWordsThanARecordingHasRoomFor) {
  const std::vector<float> audio = sentence({"rise"}, 0.1);
  const Transcript short_of =
      trained().align(audio, kRateHz, std::vector<std::string>(100, "rise"));
  EXPECT_FALSE(short_of.complete);
  EXPECT_LT(short_of.words.size(), 100U);
  const Transcript silent = trained().align(std::vector<float>(kRateHz, 0.0F), kRateHz, {"rise"});
  EXPECT_FALSE(silent.complete);
  EXPECT_TRUE(silent.words.empty());
}

TEST(ConnectedWordRecognizer, RefusesToAlignWhatIsNoWord) {
  const ScoredRecording recording = trained().score(sentence(kWords, 0.1), kRateHz);
  EXPECT_THROW((void)trained().align(recording, {}), InvalidArgument);
  EXPECT_THROW((void)trained().align(recording, std::vector<std::string>(1001, "rise")),
               InvalidArgument);
  EXPECT_THROW((void)trained().align(recording, {"rise", TranscribedWord::kUnknown}),
               InvalidArgument);
  try {
    (void)trained().align(recording, {"rise", "sink"});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "words: there is no word 'sink'; the words are fall rise");
  }
}

TEST(ConnectedWordRecognizer, IsSureOfClearWordsAndKnowsOtherSentences) {
  const Transcript found = trained().recognise(sentence(kWords, 0.1), kRateHz, {0, 3});
  ASSERT_EQ(labels_of(found), kWords);
  for (const TranscribedWord& word : found.words) {
    ASSERT_TRUE(word.confidence.has_value());
    EXPECT_GT(*word.confidence, 0.9);
    EXPECT_LE(*word.confidence, 1);
    EXPECT_FALSE(word.unknown);
  }
  ASSERT_FALSE(found.alternatives.empty());
  EXPECT_NEAR(found.alternatives[0].log_score, found.log_score, 1e-6);
  ASSERT_EQ(found.alternatives[0].words.size(), found.words.size());
  for (std::size_t i = 1; i < found.alternatives.size(); ++i)
    EXPECT_LE(found.alternatives[i].log_score, found.alternatives[i - 1].log_score);
  const auto plain = trained().recognise(sentence(kWords, 0.1), kRateHz, {0, 0, false});
  EXPECT_FALSE(plain.words[0].confidence.has_value());
}

TEST(ConnectedWordRecognizer, IsLessSureOfWordsBetweenTwo) {
  // A tone that neither rises nor falls.
  std::vector<float> audio(kRateHz / 5, 0.0F);
  const std::vector<float> clip = tone(575, 225, 7);
  audio.insert(audio.end(), clip.begin() + kRateHz / 4, clip.begin() + 3 * kRateHz / 4);
  audio.insert(audio.end(), kRateHz / 5, 0.0F);
  ConnectedWordRecognizerOptions options = small_options();
  options.min_confidence = 1;
  options.choose_penalty = false;
  options.confidence_scale = 0.001;
  options.lattice.beam = 1e4;
  const auto doubting = ConnectedWordRecognizer::train(clips().samples, options);
  const Transcript found = doubting.recognise(audio, kRateHz);
  ASSERT_FALSE(found.words.empty());
  EXPECT_TRUE(found.words[0].unknown);
  EXPECT_NE(found.words[0].label, TranscribedWord::kUnknown);
  EXPECT_EQ(found.text().substr(0, 5), "<unk>");
  EXPECT_LT(*found.words[0].confidence,
            *doubting.recognise(sentence({"rise"}, 0), kRateHz).words[0].confidence);
  // Words that are unknown fill no slot.
  const auto following = doubting.with_grammar(Grammar::parse(
      "#JSGF V1.0;\ngrammar tones;\npublic <s> = ( rise | fall )+ {tones};", "tones.jsgf"));
  const Transcript filling = following.recognise(audio, kRateHz);
  EXPECT_TRUE(filling.complete && filling.words[0].unknown);
  EXPECT_TRUE(filling.slots.empty());
}

TEST(ConnectedWordRecognizer, MarksSoundsThatAreNoWord) {
  ConnectedWordRecognizerOptions options = small_options();
  options.unknown_words = true;
  options.unknown_margin = 0.5;
  const auto rejecting = ConnectedWordRecognizer::train(clips().samples, options);
  EXPECT_EQ(labels_of(rejecting.recognise(sentence(kWords, 0.1), kRateHz)), kWords);
  // Two known words, and between them a tone far above those of both.
  std::vector<float> audio = sentence({"rise"}, 0.1);
  const std::vector<float> other = tone(2600, 30, 9);
  audio.insert(audio.end(), other.begin() + kRateHz / 4, other.begin() + 3 * kRateHz / 4);
  const std::vector<float> after = sentence({"fall"}, 0);
  audio.insert(audio.end(), after.begin(), after.end());
  const Transcript found = rejecting.recognise(audio, kRateHz);
  EXPECT_EQ(labels_of(found), (std::vector<std::string>{"rise", "<unk>", "fall"})) << found.text();
  const Transcript aligned = rejecting.align(audio, kRateHz, labels_of(found));
  EXPECT_EQ(aligned.text(), found.text());
  EXPECT_EQ(aligned.log_score, found.log_score);
  const Transcript without = trained().recognise(audio, kRateHz);
  for (const TranscribedWord& word : without.words) EXPECT_FALSE(word.unknown);
  const std::vector<std::uint8_t> bytes = rejecting.to_model_file().serialise();
  const auto loaded = ConnectedWordRecognizer::from_model_file(ModelFile::parse(bytes, "m.hri"));
  EXPECT_EQ(loaded.recognise(audio, kRateHz).text(), found.text());
}

TEST(ConnectedWordRecognizer, HearsNothingInSilence) {
  const std::vector<float> silence(kRateHz, 0.0F);
  const Transcript found = trained().recognise(silence, kRateHz);
  EXPECT_TRUE(found.words.empty());
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.text(), "");
}

TEST(ConnectedWordRecognizer, ResamplesAndSaysSo) {
  const std::vector<float> audio = sentence(kWords, 0.2);
  std::vector<float> twice;
  for (const float x : audio) twice.insert(twice.end(), 2, x);
  const Transcript found = trained().recognise(twice, 2 * kRateHz);
  EXPECT_EQ(labels_of(found), kWords);
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_EQ(found.notes[0], "resampled from 32000 to 16000 Hz");
}

TEST(ConnectedWordRecognizer, FollowsItsLanguageModel) {
  const std::vector<float> audio = sentence({"rise", "fall"}, 0.2);
  ConnectedDecoderOptions decoder = trained().options().decoder;
  decoder.language_scale = 1e5;
  const auto forced = [&](const Sentence& only) {
    const NGramModel language =
        NGramModel::train(std::vector<Sentence>(1000, only), {2}, {"rise", "fall"});
    return labels_of(
        trained().with_decoder(decoder).with_language(language).recognise(audio, kRateHz));
  };
  EXPECT_EQ(forced({"fall"}), (std::vector<std::string>{"fall"}));
  EXPECT_EQ(forced({"rise"}), (std::vector<std::string>{"rise"}));
  EXPECT_THROW((void)trained().with_language(NGramModel::train({{"rise"}})), InvalidArgument);
  EXPECT_THROW((void)trained().with_language(NGramModel::train({{"rise", "fall"}}, {3})),
               InvalidArgument);
}

TEST(ConnectedWordRecognizer, FollowsItsGrammarAndFillsItsSlots) {
  const Grammar grammar = Grammar::parse(
      "#JSGF V1.0;\ngrammar tones;\npublic <s> = rise {first} ( rise | fall ) {second} [rise];",
      "tones.jsgf");
  const auto following = trained().with_grammar(grammar);
  const Transcript found = following.recognise(sentence({"rise", "fall"}, 0.2), kRateHz);
  EXPECT_EQ(labels_of(found), (std::vector<std::string>{"rise", "fall"}));
  EXPECT_EQ(found.slots, (Slots{{"first", "rise"}, {"second", "fall"}}));
  // What is no sentence becomes the nearest that is one.
  const Transcript forced = following.recognise(sentence({"fall", "fall"}, 0.2), kRateHz);
  EXPECT_EQ(forced.words.front().label, "rise");
  const std::vector<std::uint8_t> bytes = following.to_model_file().serialise();
  const auto loaded = ConnectedWordRecognizer::from_model_file(ModelFile::parse(bytes, "m.hri"));
  EXPECT_EQ(loaded.recognise(sentence({"rise", "fall"}, 0.2), kRateHz).slots, found.slots);
  EXPECT_THROW((void)trained().with_grammar(Grammar::parse(
                   "#JSGF V1.0;\ngrammar g;\npublic <s> = rise | stop;", "other.jsgf")),
               InvalidArgument);
}

TEST(ConnectedWordRecognizer, IsTheSameFromItsFile) {
  const ConnectedWordRecognizer with_language =
      trained().with_language(NGramModel::train({{"rise", "fall"}, {"fall", "rise"}}));
  const std::vector<float> audio = sentence(kWords, 0.1);
  for (const ConnectedWordRecognizer& saved : {trained(), with_language}) {
    const std::vector<std::uint8_t> bytes = saved.to_model_file().serialise();
    const auto loaded = ConnectedWordRecognizer::from_model_file(ModelFile::parse(bytes, "m.hri"));
    EXPECT_EQ(loaded.to_model_file().serialise(), bytes);
    EXPECT_EQ(loaded.recognise(audio, kRateHz).log_score,
              saved.recognise(audio, kRateHz).log_score);
  }
}

TEST(ConnectedWordRecognizer, RefusesFilesWhosePartsDoNotFit) {
  const auto refused = [](const auto& change) {
    ModelFile file = trained().to_model_file();
    change(&file);
    EXPECT_THROW((void)ConnectedWordRecognizer::from_model_file(file), FormatError);
  };
  refused([](ModelFile* file) { file->set_kind("word_recognizer"); });
  refused([](ModelFile* file) { file->set_text_list("labels", {"fall"}); });
  refused([](ModelFile* file) { file->set_text_list("labels", {"rise", "fall"}); });
  refused([](ModelFile* file) { file->set_text_list("labels", {"fall", "rise", "stop"}); });
  refused([](ModelFile* file) { file->set_vector("final_stays", VectorD::Zero(2).eval()); });
  refused([](ModelFile* file) { file->set_vector("final_stays", VectorD::Ones(3).eval()); });
  refused([](ModelFile* file) { file->set_text("language", "\\data\\\n"); });
  refused([](ModelFile* file) { file->set_text("words.model", "ptbhmm"); });
  refused([](ModelFile* file) { file->set_integer("words.cepstra.num_cepstra", 5); });
  refused([](ModelFile* file) { file->set_text("more", "than is known"); });
}

TEST(ConnectedWordRecognizer, RefusesWhatItCannotTrainOn) {
  std::vector<WordSample> samples = clips().samples;
  const std::vector<float> silence(kRateHz, 0.0F);
  samples.push_back({silence, kRateHz, "nothing", "low"});
  EXPECT_THROW(ConnectedWordRecognizer::train(samples, small_options()), InvalidArgument);
  EXPECT_THROW(ConnectedWordRecognizer::train({}, small_options()), InvalidArgument);
  ConnectedWordRecognizerOptions options = small_options();
  options.words.false_reject_rate = 0.01;  // which isolated words alone are rejected by
  EXPECT_THROW(ConnectedWordRecognizer::train(clips().samples, options), InvalidArgument);
  const std::vector<float> audio = sentence(kWords, 0);
  EXPECT_THROW((void)trained().recognise(audio, 10), InvalidArgument);
  EXPECT_THROW((void)trained().recognise(audio, kRateHz, {-1}), InvalidArgument);
  EXPECT_THROW((void)trained().recognise(audio, kRateHz, {1001}), InvalidArgument);
  EXPECT_THROW((void)trained().recognise({}, kRateHz), InvalidArgument);
}

// A codeword more or less changes no word, and what is scored are possibilities.
std::string refusal_of(const std::vector<WordSample>& samples) {
  return testing_data::message_of<InvalidArgument>(
      [&] { (void)ConnectedWordRecognizer::train(samples, small_options()); });
}

TEST(ConnectedWordRecognizer, NamesTheRecordingItCannotTrainOn) {
  std::vector<WordSample> samples = clips().samples;
  const std::vector<float> one_sample{0.1F};
  samples[2].samples = one_sample;
  EXPECT_EQ(refusal_of(samples).find("samples[2]: "), 0U);
  samples[2].name = "anna.wav";
  std::vector<float> not_finite(kRateHz, 0.1F);
  not_finite[5] = std::numeric_limits<float>::quiet_NaN();
  samples[2].samples = not_finite;
  EXPECT_EQ(refusal_of(samples), "anna.wav: audio is not finite at sample 5");
}

TEST(ConnectedWordRecognizer, RefusesLabelsThatStandForNoWord) {
  for (const char* label : {"<unk>", "<sil>"}) {
    std::vector<WordSample> samples = clips().samples;
    samples.front().label = label;
    EXPECT_NE(refusal_of(samples).find(label), std::string::npos);
  }
}

TEST(ConnectedWordRecognizer, DecodesByPossibilities) {
  ConnectedWordRecognizerOptions options = small_options();
  options.words.model = SequenceModelKind::ptbhmm;
  options.words.num_codewords = 32;
  const auto possibilistic = ConnectedWordRecognizer::train(clips().samples, options);
  const std::vector<float> audio = sentence(kWords, 0.1);
  const Transcript found = possibilistic.recognise(audio, kRateHz);
  EXPECT_EQ(labels_of(found), kWords);
  const Transcript aligned = possibilistic.align(audio, kRateHz, kWords);
  EXPECT_EQ(aligned.log_score, found.log_score);
  EXPECT_EQ(aligned.words[2].first_s, found.words[2].first_s);
  const ScoredRecording scored = possibilistic.score(audio, kRateHz);
  // In every column the state that fits best has possibility 1; columns join by the product.
  EXPECT_LE(scored.log_emissions.maxCoeff(), 0);
  EXPECT_NE(trained().score(audio, kRateHz).log_emissions, scored.log_emissions);
  for (const WordChain& chain : possibilistic.chains()) {
    EXPECT_EQ(chain.log_start.maxCoeff(), 0);
    for (Eigen::Index i = 0; i < chain.log_exit.size(); ++i)
      EXPECT_EQ(std::max(chain.log_transition.row(i).maxCoeff(), chain.log_exit[i]), 0);
  }
  const std::vector<std::uint8_t> bytes = possibilistic.to_model_file().serialise();
  const auto loaded = ConnectedWordRecognizer::from_model_file(ModelFile::parse(bytes, "m.hri"));
  EXPECT_EQ(loaded.to_model_file().serialise(), bytes);
  EXPECT_EQ(loaded.recognise(audio, kRateHz).log_score,
            possibilistic.recognise(audio, kRateHz).log_score);
  ModelFile without_rule = possibilistic.to_model_file();
  without_rule.set_text("words.model", "hmm");
  EXPECT_THROW((void)ConnectedWordRecognizer::from_model_file(without_rule), FormatError);
}

TEST(ConnectedWordRecognizer, IsInterrupted) {
  EXPECT_THROW(
      ConnectedWordRecognizer::train(clips().samples, small_options(), {}, [] { return true; }),
      Interrupted);
}

}  // namespace
}  // namespace hri
