// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kNumColumns = 9;  // six of shape, and the track
constexpr int kNumFrames = 12;

// A hand of one of three shapes, or one that goes right, down or to the left.
GestureSample sample(const std::string& label, int kind, bool moves, std::uint64_t seed) {
  Random random(seed);
  MatrixF rows = MatrixF::Zero(moves ? kNumFrames : 1, kNumColumns);
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    rows(t, moves ? 0 : kind) = 1;
    const auto way = 0.03F * static_cast<float>(t);
    if (moves) rows(t, kNumColumns - 3) = 0.5F + (kind == 0 ? way : kind == 2 ? -way : 0);
    if (moves) rows(t, kNumColumns - 2) = 0.3F + (kind == 1 ? way : 0);
    for (Eigen::Index c = 0; c < kNumColumns; ++c)
      rows(t, c) += 0.02F * static_cast<float>(random.normal());
  }
  return {rows, label, "p" + std::to_string(seed % 3)};
}

std::vector<GestureSample> samples(const std::string& label, int kind, bool moves, int count,
                                   std::uint64_t seed) {
  std::vector<GestureSample> result;
  result.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    result.push_back(sample(label, kind, moves, seed + static_cast<std::uint64_t>(i)));
  return result;
}

class GestureAddition : public ::testing::TestWithParam<GestureModel> {
 protected:
  static GestureRecognizerOptions options() {
    GestureRecognizerOptions o;
    o.model = GetParam();
    o.num_components = 6;
    o.num_states = 3;
    o.num_codewords = 16;
    o.false_reject_rate = 0;
    return o;
  }
  static bool moves() { return GetParam() != GestureModel::rbf && GetParam() != GestureModel::knn; }
  static GestureRecognizer recognizer() {
    std::vector<GestureSample> known = samples("a", 0, moves(), 6, 10);
    for (GestureSample& s : samples("c", 2, moves(), 6, 20)) known.push_back(std::move(s));
    return GestureRecognizer::train(known, options());
  }
  static std::string error_of(const std::vector<GestureSample>& given) {
    try {
      (void)recognizer().with_gesture(given);
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "";
  }
};

TEST_P(GestureAddition, KnowsTheNewGestureAndTheOthers) {
  const GestureRecognizer before = recognizer();
  const GestureRecognizer more = before.with_gesture(samples("b", 1, moves(), 3, 30));
  EXPECT_EQ(more.labels(), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(before.labels().size(), 2U);
  for (const auto& [label, kind] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 2)}) {
    for (const GestureSample& s : samples(label, kind, moves(), 4, 40))
      EXPECT_EQ(more.recognise_features(s.features).nbest.front().label, label);
  }
}

TEST_P(GestureAddition, IsSavedAndLoadedToTheBit) {
  const GestureRecognizer more = recognizer()
                                     .with_gesture(samples("b", 1, moves(), 3, 30))
                                     .with_gesture(samples("d", 0, moves(), 1, 60));
  const std::vector<std::uint8_t> bytes = more.to_model_file().serialise();
  const GestureRecognizer again = GestureRecognizer::from_model_file(ModelFile::parse(bytes, "x"));
  EXPECT_EQ(again.to_model_file().serialise(), bytes);
  const MatrixF rows = sample("b", 1, moves(), 70).features;
  EXPECT_EQ(again.scores(rows), more.scores(rows));
}

TEST_P(GestureAddition, RefusesWhatIsNoNewGestureAndSaysWhy) {
  const std::vector<GestureSample> good = samples("b", 1, moves(), 3, 30);
  const auto with = [&](auto change) {
    std::vector<GestureSample> given = good;
    change(&given);
    return error_of(given);
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(error_of(good), "");
  EXPECT_TRUE(contains(error_of({}), "at least one sample"));
  EXPECT_TRUE(contains(error_of(samples("a", 1, moves(), 3, 30)), "'a' is in the vocabulary"));
  EXPECT_TRUE(contains(error_of(samples("", 1, moves(), 3, 30)), "must not be empty"));
  EXPECT_TRUE(contains(error_of(samples("unknown", 1, moves(), 3, 30)), "'unknown'"));
  EXPECT_TRUE(contains(with([](auto* s) { (*s)[1].label = "e"; }), "samples[1]: label 'e'"));
  EXPECT_TRUE(contains(with([](auto* s) { (*s)[2].features.resize(0, kNumColumns); }),
                       "samples[2]: no frame shows a hand"));
  EXPECT_TRUE(contains(
      with([](auto* s) { (*s)[0].features(0, 0) = std::numeric_limits<float>::quiet_NaN(); }),
      "samples[0]"));
  EXPECT_TRUE(contains(with([](auto* s) {
                         for (GestureSample& one : *s)
                           one.features = MatrixF(one.features.leftCols(kNumColumns - 1));
                       }),
                       "columns"));
  const std::string few =
      with([](auto* s) { (*s)[1].features = MatrixF(s->front().features.topRows(1)); });
  EXPECT_EQ(contains(few, "samples[1]: 1 frames show a hand"), moves());
}

std::string name_of_model(const ::testing::TestParamInfo<GestureModel>& test) {
  return enum_names(GestureModel{})[static_cast<std::size_t>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Models, GestureAddition,
                         ::testing::Values(GestureModel::knn, GestureModel::hmm,
                                           GestureModel::ptbhmm, GestureModel::trajectory,
                                           GestureModel::rbf),
                         name_of_model);

TEST(GestureAdditionToRbf, IsTrainingOnAllRows) {
  GestureRecognizerOptions options;
  options.model = GestureModel::rbf;
  std::vector<GestureSample> known = samples("a", 0, false, 6, 10);
  for (GestureSample& s : samples("b", 1, false, 6, 20)) known.push_back(std::move(s));
  const std::vector<GestureSample> added = samples("c", 2, false, 3, 30);
  std::vector<GestureSample> all = known;
  all.insert(all.end(), added.begin(), added.end());
  const GestureRecognizer more = GestureRecognizer::train(known, options).with_gesture(added);
  const GestureRecognizer anew = GestureRecognizer::train(all, options);
  for (const GestureSample& s : all)
    EXPECT_LT((more.scores(s.features) - anew.scores(s.features)).cwiseAbs().maxCoeff(), 1e-5F);
}

TEST(GestureAdditionToSvm, IsRefused) {
  for (const GestureModel model : {GestureModel::svm, GestureModel::bayes}) {
    GestureRecognizerOptions options;
    options.model = model;
    options.num_components = 4;
    std::vector<GestureSample> known = samples("a", 0, false, 6, 10);
    for (GestureSample& s : samples("b", 1, false, 6, 20)) known.push_back(std::move(s));
    const GestureRecognizer recognizer = GestureRecognizer::train(known, options);
    EXPECT_THROW((void)recognizer.with_gesture(samples("c", 2, false, 3, 30)), InvalidArgument);
  }
}

}  // namespace
}  // namespace hri
