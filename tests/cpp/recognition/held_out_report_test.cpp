// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/held_out_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
  report.num_others = 36;
  report.false_accept_rate = 0.5;
  return report;
}

// Of a threshold of 2.
Calibration calibration() {
  VectorF scores(2);
  scores << 1, 0;
  RejectionRates rates;
  rates.false_reject = 0;
  return Calibration::fit({{scores, 0, 2}, {scores, 0, 4}, {scores, 1, 0}}, rates);
}

TEST(HeldOutReport, IsMadeOfDecisionsAndOfThoseOnOthers) {
  VectorF go(2);
  go << 5, 3;
  VectorF no(2);
  no << 3, 5;
  const std::vector<HeldOut> decisions{
      {go, 0, 9}, {go, 0, 2}, {go, 0, 1.9F}, {no, 0, 9}, {no, 1, std::nanf("")}, {go, 1, 0}};
  const std::vector<float> others{1, 2, 3};
  ASSERT_EQ(calibration().threshold(), 2);
  const HeldOutReport report =
      HeldOutReport::from_decisions({"go", "no"}, decisions, others, calibration());
  EXPECT_EQ(report.labels, (std::vector<std::string>{"go", "no"}));
  MatrixF counts(2, 2);
  counts << 3, 1, 1, 1;
  EXPECT_EQ(report.confusion, counts);
  EXPECT_EQ(report.false_reject_rate, 2.0 / 4);  // what lies below, and what is no number
  EXPECT_EQ(report.num_others, 3);
  EXPECT_EQ(report.false_accept_rate, 2.0 / 3);
  const HeldOutReport alone =
      HeldOutReport::from_decisions({"go", "no"}, decisions, {}, calibration());
  EXPECT_EQ(alone.num_others, 0);
  EXPECT_EQ(alone.confusion, counts);
  EXPECT_TRUE(HeldOutReport::from_decisions({"go", "no"}, {}, {}, calibration()).empty());
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
  EXPECT_EQ(again.num_others, 36);
  EXPECT_EQ(again.false_accept_rate, 0.5);
  HeldOutReport untested = three_classes();
  untested.num_others = 0;
  ModelFile without_others;
  untested.write(without_others);
  EXPECT_FALSE(without_others.has("held_out.false_accept_rate"));
  EXPECT_EQ(HeldOutReport::read(without_others).num_others, 0);
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
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->num_others = -1; })),
               FormatError);
  EXPECT_THROW(HeldOutReport::read(damaged([](HeldOutReport* r) { r->num_others = 20000000; })),
               FormatError);
  without_others.set_integer("held_out.num_others", 4);  // and no rate
  EXPECT_THROW(HeldOutReport::read(without_others), FormatError);
}

// As words were written before there was a number of others.
TEST(HeldOutReport, KnowsHowManyOthersAnOlderFileIsOf) {
  const auto older = [](const HeldOutReport& report) {
    ModelFile file;
    file.set_text_list("held_out.labels", report.labels);
    file.set_matrix("held_out.confusion", ConstMatrixRefF(report.confusion));
    file.set_number("held_out.false_reject_rate", report.false_reject_rate);
    file.set_number("held_out.false_accept_rate", report.false_accept_rate);
    const HeldOutReport found = HeldOutReport::read(file);
    file.require_all_read();
    return found;
  };
  EXPECT_EQ(older(three_classes()).num_others, 40);
  EXPECT_EQ(older(three_classes()).false_accept_rate, 0.5);
  HeldOutReport two = three_classes().without("up");
  two.false_accept_rate = 0;
  EXPECT_EQ(older(two).num_others, 0);
  two.false_accept_rate = 2;
  EXPECT_THROW(older(two), FormatError);
}

TEST(HeldOutReport, CountsEveryRecordingOnceThatTrainingHeldOut) {
  const Clips all = tone_clips();
  const WordRecognizer recognizer = WordRecognizer::train(all.samples, {});
  const HeldOutReport& report = recognizer.held_out();
  EXPECT_EQ(report.num_samples(), static_cast<int>(all.samples.size()));
  EXPECT_EQ(report.confusion.rowwise().sum()[0], 9);
  EXPECT_EQ(report.num_others, 0);  // two words: neither can be left out
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
