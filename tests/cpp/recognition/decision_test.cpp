// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/gesture/key_frames.hpp"
#include "hri/recognition/training.hpp"
#include "models/model_testing.hpp"
#include "recognition/recording_folds.hpp"

namespace hri {
namespace {

// Scores that are `sharpness` times too sure of themselves, and score that grows with them.
std::vector<HeldOut> held_out(double sharpness, int count) {
  Random random(3);
  std::vector<HeldOut> result;
  for (int i = 0; i < count; ++i) {
    VectorF scores(3);
    for (float& s : scores) s = static_cast<float>(random.normal());
    // The truth is drawn from the softmax of the plain scores: those would be calibrated.
    double u = random.uniform() * scores.array().exp().sum();
    int truth = 0;
    while (truth < 2 && (u -= std::exp(static_cast<double>(scores[truth]))) > 0) ++truth;
    scores *= static_cast<float>(sharpness);
    result.push_back({scores, truth, scores.maxCoeff()});
  }
  return result;
}

TEST(Calibration, FindsHowMuchTooSureScoresAre) {
  for (const double sharpness : {0.2, 1.0, 20.0}) {
    const Calibration c = Calibration::fit(held_out(sharpness, 3000), RejectionRates{});
    EXPECT_NEAR(c.scale() * sharpness, 1.0, 0.15) << sharpness;
  }
}

// The likelihood alone would make all decisions certain, those for other words, too.
TEST(Calibration, IsNoSurerThanItsSamplesAllowWhereAllAreRight) {
  for (const int count : {4, 100}) {
    std::vector<HeldOut> samples(static_cast<std::size_t>(count));
    for (HeldOut& s : samples) {
      s.scores = VectorF::Zero(3);
      s.scores[s.truth] = s.score = 5;
    }
    const Calibration c = Calibration::fit(samples, RejectionRates{});
    EXPECT_NEAR(c.posterior(samples[0].scores)[0], (count + 1.0) / (count + 2.0), 1e-4);
    // What is nearly as like another class is far less sure.
    VectorF between = VectorF::Zero(3);
    between << 5, 4.9F, 0;
    EXPECT_LT(c.posterior(between)[0], 0.6F);
  }
}

// Decisions between two classes that are right `num_right` times of `count`, all by the margin.
std::vector<HeldOut> by_margin(int num_right, int count, float margin) {
  std::vector<HeldOut> result;
  for (int i = 0; i < count; ++i) {
    VectorF scores = VectorF::Zero(2);
    scores[i % 2] = margin;
    result.push_back({scores, i < num_right ? i % 2 : 1 - i % 2, margin});
  }
  return result;
}

// Of the share p of right decisions by a margin m the likelihood p log s(am) + (1 - p) log s(-am),
// s the logistic function, is largest at a = log(p / (1 - p)) / m.
TEST(Calibration, FindsTheScaleOfTheLargestLikelihood) {
  struct Case {
    int num_right, count;
  };
  for (const Case& c : {Case{3, 4}, Case{9, 10}, Case{51, 100}, Case{999, 1000}}) {
    const double odds = static_cast<double>(c.num_right) / (c.count - c.num_right);
    for (const float margin : {0.0078125F, 0.5F, 1.0F, 37.0F, 4096.0F}) {
      const double expected = std::log(odds) / static_cast<double>(margin);
      if (expected < 1.1e-4 || expected > 900) continue;
      const Calibration found = Calibration::fit(by_margin(c.num_right, c.count, margin), {});
      // A likelihood in double is flat within the square root of its rounding.
      EXPECT_NEAR(found.scale() / expected, 1, 1e-5) << c.num_right << " by " << margin;
    }
  }
}

// Its logarithm lies in -4..3; what lies beyond is at the border.
TEST(Calibration, KeepsTheScaleWithinItsBorders) {
  const auto log_scale = [](const std::vector<HeldOut>& samples) {
    return std::log10(Calibration::fit(samples, {}).scale());
  };
  EXPECT_NEAR(log_scale(by_margin(3, 4, 1e-5F)), 3, 1e-9);    // wants 1e5
  EXPECT_NEAR(log_scale(by_margin(3, 4, 4e5F)), -4, 1e-9);    // wants 3e-6
  EXPECT_NEAR(log_scale(by_margin(1, 4, 100.0F)), -4, 1e-9);  // is more often wrong than right
  EXPECT_NEAR(log_scale(by_margin(4, 4, 1e-5F)), 3, 1e-9);    // all are right, too
  EXPECT_NEAR(log_scale(by_margin(4, 4, 4e5F)), -4, 1e-9);
  // Just within them.
  const auto at = [](double scale) { return static_cast<float>(std::log(3.0) / scale); };
  EXPECT_NEAR(log_scale(by_margin(3, 4, at(990))), std::log10(990), 1e-5);
  EXPECT_NEAR(log_scale(by_margin(3, 4, at(1.01e-4))), std::log10(1.01e-4), 1e-5);
}

// s(am) = (n + 1) / (n + 2) at a = log(n + 1) / m.
TEST(Calibration, FindsTheScaleOfLaplacesRuleWhereAllAreRight) {
  for (const int count : {1, 2, 50}) {
    for (const float margin : {0.015625F, 1.0F, 1024.0F}) {
      const double expected = std::log(count + 1.0) / static_cast<double>(margin);
      EXPECT_NEAR(Calibration::fit(by_margin(count, count, margin), {}).scale() / expected, 1,
                  1e-9);
    }
  }
}

TEST(Calibration, NeverRecognisesWhatIsNoNumber) {
  const Calibration c = Calibration::fit(held_out(1.0, 3000), RejectionRates{});
  const float nan = std::nanf("");
  const float infinity = std::numeric_limits<float>::infinity();
  const auto decide = [&c](float a, float b, float score) {
    VectorF scores(2);
    scores << a, b;
    return c.decide(scores, score, {"a", "b"});
  };
  EXPECT_EQ(decide(3, -infinity, 9).status, DecisionStatus::recognised);  // one is impossible
  for (const Decision& d :
       {decide(nan, 1, 9), decide(1, nan, 9), decide(1, infinity, 9),
        decide(-infinity, -infinity, 9), decide(1, 2, nan), decide(1, 2, infinity)}) {
    EXPECT_EQ(d.status, DecisionStatus::unknown);
    EXPECT_EQ(d.label, "unknown");
    EXPECT_EQ(d.confidence, 0);
    EXPECT_TRUE(d.nbest.empty());
  }
}

TEST(Calibration, RefusesScalesThatNoTrainingGives) {
  ModelFile file;
  Calibration::fit(held_out(1.0, 300), RejectionRates{}).write(file);
  for (const char* scale : {"0", "-1", "1e7", "1e308", "nan"}) {
    file.set_text("calibration.scale", scale);
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "field 'calibration.scale'",
                        testing_data::message_of<FormatError>([&] { Calibration::read(file); }));
  }
}

TEST(Calibration, RejectsTheShareOfRightAnswersItWasAllowed) {
  const auto samples = held_out(1.0, 3000);
  for (const double rate : {0.0, 0.1, 0.3}) {
    const Calibration c = Calibration::fit(samples, {rate});
    int right = 0;
    int rejected = 0;
    for (const HeldOut& s : samples) {
      Eigen::Index best = 0;
      s.scores.maxCoeff(&best);
      if (best != s.truth) continue;
      ++right;
      if (c.decide(s.scores, s.score, {"a", "b", "c"}).status == DecisionStatus::unknown)
        ++rejected;
    }
    EXPECT_NEAR(static_cast<double>(rejected) / right, rate, 0.01);
  }
  EXPECT_THROW(Calibration::fit(samples, {0.9}), InvalidArgument);
}

// With scores 0..23, a share of 0.04 is (24 + 1/3) 0.04 - 2/3 = 0.30667 of the way to the second.
TEST(Calibration, SetsThresholdsBetweenFewScores) {
  std::vector<HeldOut> samples;
  VectorF scores = VectorF::Zero(2);
  scores[0] = 1;
  for (int i = 0; i < 24; ++i) samples.push_back({scores, 0, static_cast<float>(i)});
  const auto threshold = [&](double rate) {
    RejectionRates rates{rate};
    rates.interpolate = true;
    return Calibration::fit(samples, rates).threshold();
  };
  EXPECT_NEAR(threshold(0.04), 0.30667, 1e-4);
  EXPECT_EQ(threshold(0), 0);
  EXPECT_NEAR(threshold(0.5), 11.5, 1e-4);
  EXPECT_EQ(Calibration::fit(samples, {0.05}).threshold(), 1);
}

// Of `count` samples of class 0 and as many of class 1, all decided with margin `right`, but
// `num_wrong` of class 1 that are misrecognised as class 0 with margin `wrong`.
std::vector<HeldOut> with_false_alarms(int count, int num_wrong, float right, float wrong) {
  std::vector<HeldOut> result;
  for (int i = 0; i < 2 * count; ++i) {
    const int truth = i % 2;
    const bool mistaken = truth == 1 && i / 2 < num_wrong;
    const int best = mistaken ? 0 : truth;
    VectorF scores = VectorF::Zero(2);
    scores[best] = mistaken ? wrong : right;
    result.push_back({scores, truth, 1});
  }
  return result;
}

TEST(Calibration, PutsEachClassAboveItsFalseAlarms) {
  // Class 0 has 5 % of false alarms, all less sure than right decisions; class 1 has none.
  const std::vector<HeldOut> samples = with_false_alarms(1000, 50, 4, 2);
  const Calibration c = Calibration::fit(samples, RejectionRates{});
  const std::vector<std::string> labels{"stop", "go"};
  int false_alarms = 0;
  int hits = 0;
  for (const HeldOut& s : samples) {
    const Decision d = c.decide(s.scores, s.score, labels);
    if (d.label != "stop") {
      EXPECT_EQ(d.class_threshold, Calibration::kMinClassThreshold);
      continue;
    }
    const bool sure = d.confidence >= d.class_threshold;
    (s.truth == 0 ? hits : false_alarms) += static_cast<int>(sure);
  }
  EXPECT_EQ(false_alarms, 0);
  EXPECT_EQ(hits, 1000);
}

TEST(Calibration, MissesFewOfAClassEvenIfItsFalseAlarmsAreSurer) {
  const Calibration c = Calibration::fit(with_false_alarms(1000, 50, 3, 6), RejectionRates{});
  VectorF right(2);
  right << 3, 0;
  const Decision d = c.decide(right, 1, {"stop", "go"});
  EXPECT_GE(d.confidence, d.class_threshold);
  EXPECT_GT(d.class_threshold, Calibration::kMinClassThreshold);
}

TEST(Calibration, KeepsClassThresholdsWithTheirClasses) {
  const Calibration two = Calibration::fit(with_false_alarms(1000, 50, 4, 2), RejectionRates{});
  const float stop = two.class_thresholds()[0];
  const Calibration three = two.with_class(1);
  EXPECT_EQ(three.class_thresholds()[0], stop);
  EXPECT_EQ(three.class_thresholds()[1], stop);
  EXPECT_EQ(three.class_thresholds()[2], two.class_thresholds()[1]);
  EXPECT_EQ(three.without_class(1).class_thresholds(), two.class_thresholds());
  EXPECT_EQ(two.without_class(0).class_thresholds()[0], two.class_thresholds()[1]);
  EXPECT_EQ(Calibration().with_class(0).class_thresholds().size(), 0);
}

TEST(Calibration, ReadsClassThresholdsBackAndDoesWithout) {
  ModelFile file;
  file.set_text_list("labels", {"go", "stop"});
  const Calibration saved = Calibration::fit(with_false_alarms(1000, 50, 4, 2), RejectionRates{});
  saved.write(file);
  EXPECT_EQ(Calibration::read(file).class_thresholds(), saved.class_thresholds());

  ModelFile older;
  older.set_number("calibration.scale", 1);
  older.set_number("calibration.threshold", 0);
  EXPECT_EQ(Calibration::read(older).class_thresholds().size(), 0);

  for (const std::vector<float>& wrong : {std::vector<float>{0.5F}, {0.5F, 1.5F}, {-0.1F, 0.5F}}) {
    file.set_vector(
        "calibration.class_thresholds",
        VectorF(Eigen::Map<const VectorF>(wrong.data(), static_cast<Eigen::Index>(wrong.size()))));
    EXPECT_THROW(Calibration::read(file), FormatError);
  }
}

TEST(Calibration, DecidesWithAnNBestListThatFallsAndSumsToOne) {
  VectorF scores(3);
  scores << 1, 3, 2;
  const Decision d = Calibration().decide(scores, 0, {"a", "b", "c"});
  EXPECT_EQ(d.label, "b");
  EXPECT_EQ(d.nbest[1].label, "c");
  EXPECT_EQ(d.nbest[2].label, "a");
  EXPECT_NEAR(d.nbest[0].probability + d.nbest[1].probability + d.nbest[2].probability, 1, 1e-6);
  EXPECT_EQ(d.confidence, d.nbest[0].probability);
  const Calibration untrained = Calibration::fit({}, RejectionRates{});
  EXPECT_EQ(untrained.scale(), 1.0);
  EXPECT_FALSE(untrained.is_fitted());
  EXPECT_EQ(untrained.decide(scores, -1e20F, {"a", "b", "c"}).status, DecisionStatus::recognised);
  EXPECT_THROW(static_cast<void>(Calibration().decide({}, 0, {})), Error);
  EXPECT_THROW(static_cast<void>(Calibration().decide(scores, 0, {"a", "b", "c", "d"})), Error);
}

TEST(Training, LabelsAreSortedAndTwoAtLeast) {
  EXPECT_EQ(sorted_labels({"b", "a", "b"}), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(label_index({"a", "b"}, "b"), 1);
  EXPECT_THROW(sorted_labels({"a", "a"}), InvalidArgument);
  EXPECT_THROW(sorted_labels({"a", ""}), InvalidArgument);
  EXPECT_THROW(sorted_labels({"a", "unknown"}), InvalidArgument);
  EXPECT_THROW(sorted_labels({"a", "no_input"}), InvalidArgument);
}

TEST(Training, FoldsShareNoGroup) {
  const std::vector<int> classes{0, 1, 0, 1, 0, 1, 0, 1};
  const std::vector<std::string> groups{"p", "p", "q", "q", "r", "r", "s", "s"};
  const std::vector<int> folds = held_out_folds(classes, groups, 3);
  std::map<std::string, std::set<int>> of_group;
  for (std::size_t i = 0; i < folds.size(); ++i) of_group[groups[i]].insert(folds[i]);
  for (const auto& [group, set] : of_group) EXPECT_EQ(set.size(), 1U) << group;
  EXPECT_EQ(std::set<int>(folds.begin(), folds.end()), (std::set<int>{0, 1, 2}));
  // Without groups every label is dealt out.
  const std::vector<int> dealt = held_out_folds(classes, std::vector<std::string>(8, ""), 2);
  for (const int label : {0, 1}) {
    std::set<int> seen;
    for (std::size_t i = 0; i < dealt.size(); ++i) {
      if (classes[i] == label) seen.insert(dealt[i]);
    }
    EXPECT_EQ(seen, (std::set<int>{0, 1}));
  }
}

TEST(Training, RecordingsAreDealtOutWhereNoPersonCanBeHeldOut) {
  // Two words by both, and one by each alone.
  const std::vector<int> classes{0, 0, 1, 1, 2, 2, 0, 0, 1, 1, 3, 3};
  const std::vector<std::string> groups{"p", "p", "p", "p", "p", "p", "q", "q", "q", "q", "q", "q"};
  EXPECT_FALSE(detail::any_fold_is_usable(classes, held_out_folds(classes, groups, 4)));
  const std::vector<int> dealt = detail::usable_folds(classes, groups, 4);
  EXPECT_EQ(dealt, held_out_folds(classes, std::vector<std::string>(12, ""), 4));
  EXPECT_TRUE(detail::any_fold_is_usable(classes, dealt));
  // One fold that can be held out is enough for persons to stay apart.
  std::vector<int> shared = classes;
  shared[10] = shared[11] = 0;
  EXPECT_EQ(detail::usable_folds(shared, groups, 4), held_out_folds(shared, groups, 4));
  EXPECT_FALSE(detail::any_fold_is_usable({0, 1}, detail::usable_folds({0, 1}, {"p", "q"}, 4)));
}

// A hand that moves for 12 frames, is held for 16, and moves again for 12.
MatrixF raised_and_lowered() {
  Random random(1);
  MatrixF rows(40, 6);
  for (int t = 0; t < 40; ++t) {
    const int moved = t < 12 ? t : (t < 28 ? 12 : t - 16);
    for (int c = 0; c < 6; ++c) {
      rows(t, c) = static_cast<float>(moved * (c + 1) + 0.05 * random.normal());
    }
  }
  return rows;
}

TEST(KeyFrames, AreWhereTheHandIsHeld) {
  const FrameRange held = key_frames(raised_and_lowered(), 3);
  EXPECT_NEAR(static_cast<double>(held.first), 12, 3);
  EXPECT_NEAR(static_cast<double>(held.last), 29, 3);
}

TEST(KeyFrames, AreAllOfAShortOrSteadyClip) {
  const MatrixF rows = raised_and_lowered();
  EXPECT_EQ(key_frames(rows.topRows(5), 3).last, 5);
  EXPECT_EQ(key_frames(MatrixF::Constant(30, 4, 2), 3).last, 30);
  EXPECT_EQ(key_frames(MatrixF(0, 4), 3).last, 0);
  EXPECT_THROW(key_frames(rows, 9), InvalidArgument);
}

}  // namespace
}  // namespace hri
