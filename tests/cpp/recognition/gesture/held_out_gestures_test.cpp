// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/held_out_gestures.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"

namespace hri {
namespace {

// A row holds the scores of two classes, what speaks for a gesture, and how it moves.
class RowScorer : public detail::GestureScorer {
 public:
  [[nodiscard]] VectorF scores(ConstMatrixRefF rows) const override {
    return rows.row(0).head(2).transpose();
  }
  [[nodiscard]] float verification_score(ConstMatrixRefF rows,
                                         const VectorF& /*scores*/) const override {
    return rows(0, 2);
  }
  [[nodiscard]] float movement_score(ConstMatrixRefF rows) const override { return rows(0, 3); }
  [[nodiscard]] Eigen::Index num_confidence_features() const override { return 1; }
  [[nodiscard]] VectorD confidence_features(ConstMatrixRefF rows,
                                            const VectorF& /*scores*/) const override {
    return VectorD::Constant(1, static_cast<double>(rows(0, 2)));
  }
  void write(ModelFile& /*file*/) const override {}
};

MatrixF row_of(int best, float evidence, float movement = 0) {
  MatrixF row(1, 4);
  row << (best == 0 ? 1.0F : 0.0F), (best == 1 ? 1.0F : 0.0F), evidence, movement;
  return row;
}

detail::HeldOutGestures right_ones(int count) {
  detail::HeldOutGestures held_out;
  for (int i = 0; i < count; ++i)
    held_out.add_gesture(row_of(i % 2, 5 + 0.1F * static_cast<float>(i % 7)), i % 2, RowScorer());
  return held_out;
}

HeldOutReport report_of(const detail::HeldOutGestures& held_out) {
  return held_out.judge({}, {"go", "no"}).report;
}

TEST(HeldOutGestures, CountWhatIsConfusedAndWhatIsRejected) {
  detail::HeldOutGestures held_out = right_ones(24);
  for (int i = 0; i < 6; ++i) held_out.add_gesture(row_of(1, 5), 0, RowScorer());
  const detail::GestureJudgement found = held_out.judge({}, {"go", "no"});
  MatrixF counts(2, 2);
  counts << 12, 6, 0, 12;
  EXPECT_EQ(found.report.confusion, counts);
  EXPECT_EQ(found.report.labels, (std::vector<std::string>{"go", "no"}));
  ASSERT_EQ(found.report.confused_pairs().size(), 1U);
  int below = 0;  // of the right ones
  for (int i = 0; i < 24; ++i)
    below += found.calibration.accepts(5 + 0.1F * static_cast<float>(i % 7)) ? 0 : 1;
  EXPECT_EQ(found.report.false_reject_rate, below / 24.0);
  EXPECT_EQ(found.report.num_others, 0);
  EXPECT_TRUE(report_of({}).empty());
}

// Without a verifier the score is the scorer's own, and what is known of rests is added.
TEST(HeldOutGestures, OfTooFewForAVerifierAreScoredAsRecognitionScoresThem) {
  detail::HeldOutGestures held_out = right_ones(24);
  held_out.add_unknown(row_of(0, 9), RowScorer());
  held_out.add_unknown(row_of(0, 1), RowScorer());
  held_out.add_unknown(row_of(0, 9, -8), RowScorer());
  const detail::GestureJudgement found = held_out.judge({}, {"go", "no"});
  EXPECT_EQ(found.verifier.dim(), 0);
  EXPECT_EQ(found.report.num_others, 3);
  EXPECT_EQ(found.report.false_accept_rate, 1.0 / 3);
}

// With one, a hand that rests is rejected, whatever the verifier says.
TEST(HeldOutGestures, ThatRestAreNotAcceptedAsUnknownOnes) {
  detail::HeldOutGestures held_out = right_ones(40);
  for (int i = 0; i < 30; ++i)
    held_out.add_unknown(row_of(0, 1 + 0.1F * static_cast<float>(i % 7)), RowScorer());
  const detail::GestureJudgement found = held_out.judge({}, {"go", "no"});
  EXPECT_EQ(found.verifier.dim(), 1);
  EXPECT_EQ(found.report.num_others, 30);
  EXPECT_EQ(found.report.false_accept_rate, 0);
  detail::HeldOutGestures moving = held_out;
  for (int i = 0; i < 10; ++i) moving.add_unknown(row_of(0, 9), RowScorer());
  EXPECT_EQ(report_of(moving).false_accept_rate, 10.0 / 40);
  detail::HeldOutGestures resting = held_out;
  for (int i = 0; i < 10; ++i) resting.add_unknown(row_of(0, 9, -1), RowScorer());
  EXPECT_EQ(report_of(resting).num_others, 40);
  EXPECT_EQ(report_of(resting).false_accept_rate, 0);
}

// Rows around one centre a sign; those of the last two signs are alike where `alike`.
std::vector<GestureSample> signs(int num_signs, int takes, bool alike = false) {
  Random random(5);
  std::vector<GestureSample> result;
  for (int take = 0; take < takes; ++take) {
    for (int c = 0; c < num_signs; ++c) {
      MatrixF row = MatrixF::Zero(1, 9);
      for (Eigen::Index i = 0; i < 6; ++i) row(0, i) = static_cast<float>(random.uniform());
      row(0, alike && c == num_signs - 1 ? c - 1 : c) += 2;
      result.push_back({row, "sign" + std::to_string(c), "signer" + std::to_string(take % 5)});
    }
  }
  return result;
}

TEST(GestureRecognizer, SaysHowItDidOnGesturesHeldOut) {
  const std::vector<GestureSample> samples = signs(5, 20, true);
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, {});
  const HeldOutReport& report = recognizer.held_out();
  EXPECT_EQ(report.labels, recognizer.labels());
  EXPECT_EQ(report.num_samples(), 100);
  for (Eigen::Index c = 0; c < 5; ++c) EXPECT_EQ(report.confusion.row(c).sum(), 20);
  const std::vector<ConfusedPair> pairs = report.confused_pairs();
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(std::pair(pairs[0].first, pairs[0].second), std::pair(3, 4));
  // The threshold lies between scores: at most one decision more than asked for.
  EXPECT_LE(report.false_reject_rate,
            recognizer.options().false_reject_rate + 1.0 / report.confusion.trace());
  // Each of five folds leaves two of five signs out, as 30 gestures must be unknown.
  EXPECT_EQ(report.num_others, 40);
  // Of the two that are alike one is mistaken for the other.
  EXPECT_GT(report.false_accept_rate, 0);
  EXPECT_LT(report.false_accept_rate, 1);
}

TEST(GestureRecognizer, KnowsNothingOfOthersWhereNoneWereLeftOut) {
  const GestureRecognizer of_two = GestureRecognizer::train(signs(2, 10), {});
  EXPECT_EQ(of_two.held_out().num_samples(), 20);
  EXPECT_EQ(of_two.held_out().num_others, 0);
  GestureRecognizerOptions options;
  options.model = GestureModel::svm;
  const GestureRecognizer by_svm = GestureRecognizer::train(signs(5, 10), options);
  EXPECT_EQ(by_svm.held_out().num_samples(), 50);
  EXPECT_EQ(by_svm.held_out().num_others, 0);
  const GestureRecognizer one_each = GestureRecognizer::train(signs(3, 1), {});
  EXPECT_TRUE(one_each.held_out().empty());
  EXPECT_FALSE(one_each.to_model_file().has("held_out.confusion"));
}

// Where each signer alone shows a sign, recordings are held out in place of signers.
TEST(GestureRecognizer, HoldsOutSignersWhereEverySignIsLeftWithoutThem) {
  std::vector<GestureSample> samples = signs(3, 10);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].group = std::to_string(i / 6);  // two takes each
    // No other signer shows the signs as this one does.
    if (i < 6) samples[i].features.leftCols(6).reverseInPlace();
  }
  const double by_signer = GestureRecognizer::train(samples, {}).held_out().accuracy();
  for (GestureSample& s : samples) s.group.clear();
  EXPECT_LT(by_signer, GestureRecognizer::train(samples, {}).held_out().accuracy());
  for (GestureSample& s : samples) s.group = s.label;
  const HeldOutReport by_recording = GestureRecognizer::train(samples, {}).held_out();
  EXPECT_EQ(by_recording.num_samples(), 30);
}

TEST(GestureRecognizer, KeepsWhatItSawHeldOutInItsFile) {
  const GestureRecognizer recognizer = GestureRecognizer::train(signs(4, 10), {});
  const HeldOutReport& report = recognizer.held_out();
  ModelFile file = ModelFile::parse(recognizer.to_model_file().serialise(), "x");
  const HeldOutReport again = GestureRecognizer::from_model_file(file).held_out();
  ASSERT_EQ(again.labels, report.labels);
  EXPECT_EQ(again.confusion, report.confusion);
  EXPECT_EQ(again.false_reject_rate, report.false_reject_rate);
  EXPECT_EQ(again.num_others, report.num_others);
  EXPECT_EQ(again.false_accept_rate, report.false_accept_rate);

  file.set_matrix("held_out.confusion", MatrixF(MatrixF::Constant(4, 4, -1)));
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
  file.set_matrix("held_out.confusion", MatrixF(MatrixF::Ones(3, 4)));
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
}

TEST(GestureRecognizer, KnowsNothingOfGesturesAddedSinceInWhatItSawHeldOut) {
  std::vector<GestureSample> known = signs(4, 10);
  std::vector<GestureSample> added;
  for (auto it = known.begin(); it != known.end();) {
    if (it->label != "sign1") {
      ++it;
      continue;
    }
    added.push_back(*it);
    it = known.erase(it);
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(known, {});
  const GestureRecognizer more = recognizer.with_gesture(added);
  EXPECT_EQ(more.labels().size(), 4U);
  ASSERT_EQ(more.held_out().labels, recognizer.labels());
  EXPECT_EQ(more.held_out().confusion, recognizer.held_out().confusion);
  EXPECT_EQ(GestureRecognizer::from_model_file(more.to_model_file()).held_out().labels,
            recognizer.labels());
}

}  // namespace
}  // namespace hri
