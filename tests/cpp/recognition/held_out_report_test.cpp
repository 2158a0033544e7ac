// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/held_out_report.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::Clips;
using testing_data::tone_clips;

HeldOutReport three_classes() {
  HeldOutReport report;
  report.labels = {"go", "no", "up"};
  report.confusion.resize(3, 3);
  report.confusion << 8, 2, 0,  //
      1, 9, 0,                  //
      1, 0, 19;
  report.false_reject_rate = 0.25;
  report.false_accept_rate = 0.5;
  return report;
}

TEST(HeldOutReport, CountsWhatIsRight) {
  EXPECT_EQ(three_classes().num_samples(), 40);
  EXPECT_DOUBLE_EQ(three_classes().accuracy(), 36.0 / 40);
  EXPECT_TRUE(HeldOutReport().empty());
  EXPECT_EQ(HeldOutReport().accuracy(), 0);
}

TEST(HeldOutReport, NamesPairsThatAreConfusedOftenAndMoreThanOnce) {
  const std::vector<ConfusedPair> pairs = three_classes().confused_pairs();
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].first, 0);
  EXPECT_EQ(pairs[0].second, 1);
  EXPECT_DOUBLE_EQ(pairs[0].rate, 3.0 / 20);

  HeldOutReport worse = three_classes();
  worse.confusion(2, 1) = 19;
  ASSERT_EQ(worse.confused_pairs().size(), 2U);
  EXPECT_EQ(worse.confused_pairs()[0].second, 2);

  HeldOutReport once;  // one of two, but a single recording
  once.confusion.resize(2, 2);
  once.confusion << 1, 1, 0, 0;
  EXPECT_TRUE(once.confused_pairs().empty());
}

TEST(HeldOutReport, LeavesOutALabel) {
  const HeldOutReport report = three_classes().without("no");
  EXPECT_EQ(report.labels, (std::vector<std::string>{"go", "up"}));
  MatrixF left(2, 2);
  left << 8, 0, 1, 19;
  EXPECT_EQ(report.confusion, left);
  EXPECT_EQ(three_classes().without("left").confusion, three_classes().confusion);
}

TEST(HeldOutReport, ReadsWhatItWroteAndNothingElse) {
  ModelFile file;
  HeldOutReport().write(file);
  EXPECT_TRUE(HeldOutReport::read(file).empty());
  three_classes().write(file);
  const HeldOutReport again = HeldOutReport::read(file);
  EXPECT_EQ(again.confusion, three_classes().confusion);
  EXPECT_EQ(again.false_reject_rate, 0.25);
  EXPECT_EQ(again.false_accept_rate, 0.5);
  const auto damaged = [&](const auto& damage) {
    HeldOutReport report = three_classes();
    damage(&report);
    ModelFile bad;
    report.write(bad);
    return bad;
  };
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->confusion(0, 0) = -1; })),
               FormatError);
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->confusion(0, 0) = 1e9F; })),
               FormatError);
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->labels.pop_back(); })),
               FormatError);
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->confusion.setZero(); })),
               FormatError);
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->false_accept_rate = 2; })),
               FormatError);
}

TEST(HeldOutReport, CountsEveryRecordingOnceThatTrainingHeldOut) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, {});
  const HeldOutReport& report = recognizer.held_out();
  EXPECT_EQ(report.num_samples(), static_cast<int>(all.samples.size()));
  EXPECT_EQ(report.confusion.rowwise().sum()[0], 9);
  EXPECT_EQ(report.false_accept_rate, 0);  // two words: neither can be left out
  const WordRecognizer loaded = WordRecognizer::from_model_file(
      ModelFile::parse(recognizer.to_model_file().serialise(), "x"));
  EXPECT_EQ(loaded.held_out().confusion, report.confusion);
  const std::vector<float> audio = testing_data::tone(700, 100, 60);
  const WordRecognizer more = recognizer.with_word({{audio, testing_data::kRateHz, "flat", ""}});
  EXPECT_EQ(more.held_out().labels, report.labels);
  EXPECT_EQ(more.without_word("fall").held_out().num_samples(),
            static_cast<int>(report.confusion(1, 1)));
}

}  // namespace
}  // namespace hri
