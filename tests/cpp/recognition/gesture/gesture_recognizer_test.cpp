// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_recognizer.hpp"

#include <gtest/gtest.h>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using hand_testing::hand;

// Stills of hands with one, three and five fingers by three signers, four takes each.
std::vector<GestureSample> stills() {
  std::vector<GestureSample> result;
  for (const int signer : {0, 1, 2}) {
    for (const int fingers : {1, 3, 5}) {
      for (int take = 0; take < 4; ++take) {
        const GreyImage mask =
            hand(fingers, 95 + 3 * take + signer, 115 + 2 * take, 0.85 + 0.07 * signer);
        const GreyImage image = hand_testing::grey(mask);
        result.push_back({GestureRecognizer::features({{image.view(), mask.view()}}, {}),
                          std::to_string(fingers), "signer" + std::to_string(signer)});
      }
    }
  }
  return result;
}

// A hand that goes right or down.
GestureSample movement(bool right, int take) {
  std::vector<GreyImage> masks;
  std::vector<GreyImage> images;
  for (int t = 0; t < 12; ++t) {
    const double way = 4.0 * t + take;
    masks.push_back(hand(2, right ? 70 + way : 100, right ? 120 : 95 + way));
    images.push_back(hand_testing::grey(masks.back()));
  }
  std::vector<HandImage> frames;
  for (std::size_t i = 0; i < masks.size(); ++i)
    frames.push_back({images[i].view(), masks[i].view()});
  return {GestureRecognizer::features(frames, {}), right ? "right" : "down",
          "signer" + std::to_string(take % 2)};
}

class GestureRecognizerOf : public ::testing::TestWithParam<GestureModel> {
 protected:
  static GestureRecognizerOptions options() {
    GestureRecognizerOptions o;
    o.model = GetParam();
    o.num_components = 8;
    o.num_states = 3;
    o.num_codewords = 16;
    return o;
  }
  static bool of_movements() {
    return GetParam() == GestureModel::hmm || GetParam() == GestureModel::ptbhmm ||
           GetParam() == GestureModel::trajectory;
  }
  static std::vector<GestureSample> samples() {
    if (!of_movements()) return stills();
    std::vector<GestureSample> result;
    for (int take = 0; take < 6; ++take) {
      result.push_back(movement(true, take));
      result.push_back(movement(false, take));
    }
    return result;
  }
};

TEST_P(GestureRecognizerOf, RecognisesASignerItHasNotSeen) {
  std::vector<GestureSample> train;
  for (const GestureSample& s : samples()) {
    if (s.group != "signer1") train.push_back(s);
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(train, options());
  int right = 0;
  int tested = 0;
  for (const GestureSample& s : samples()) {
    const Decision d = recognizer.recognise_features(s.features);
    ASSERT_EQ(d.nbest.size(), recognizer.labels().size());
    if (s.group != "signer1") continue;
    ++tested;
    right += d.nbest[0].label == s.label ? 1 : 0;
  }
  EXPECT_EQ(right, tested);
}

TEST_P(GestureRecognizerOf, LoadsWhatItSavedToTheBit) {
  const GestureRecognizer recognizer = GestureRecognizer::train(samples(), options());
  const ModelFile file = recognizer.to_model_file();
  const GestureRecognizer again =
      GestureRecognizer::from_model_file(ModelFile::parse(file.serialise(), "x"));
  for (const GestureSample& s : samples()) {
    EXPECT_EQ(again.scores(s.features), recognizer.scores(s.features));
  }
  EXPECT_EQ(again.to_model_file().serialise(), file.serialise());
}

TEST_P(GestureRecognizerOf, RefusesAModelThatWasDamaged) {
  const std::vector<std::uint8_t> bytes =
      GestureRecognizer::train(samples(), options()).to_model_file().serialise();
  std::vector<std::uint8_t> broken = bytes;
  broken.back() ^= 1U;
  EXPECT_THROW(ModelFile::parse(broken, "x"), FormatError);
  ModelFile file = ModelFile::parse(bytes, "x");
  file.set_text_list("labels", {"a", "b", "c", "d", "e", "f"});
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
}

std::string model_name(const ::testing::TestParamInfo<GestureModel>& test) {
  constexpr const char* kNames[] = {"svm", "bayes", "knn", "hmm", "ptbhmm", "trajectory", "rbf"};
  return kNames[static_cast<std::size_t>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Models, GestureRecognizerOf,
                         ::testing::Values(GestureModel::svm, GestureModel::bayes,
                                           GestureModel::knn, GestureModel::hmm,
                                           GestureModel::ptbhmm, GestureModel::trajectory,
                                           GestureModel::rbf),
                         model_name);

TEST(GestureRecognizer, SeesNothingWithoutAHand) {
  const GestureRecognizer recognizer = GestureRecognizer::train(stills(), {});
  const GreyImage empty(200, 200);
  const std::vector<HandObservation> seen = {{empty, empty, 1.0, false, false}};
  EXPECT_EQ(recognizer.recognise(seen).status, DecisionStatus::no_input);
  EXPECT_EQ(recognizer.recognise({}).status, DecisionStatus::no_input);
  EXPECT_THROW((void)recognizer.scores(MatrixF(0, 10)), InvalidArgument);
}

TEST(GestureRecognizer, SavesHowItsHandsAreFound) {
  GestureRecognizerOptions options;
  options.hands.learning = ColourLearning::never;
  options.hands.silhouette.method = SilhouetteMethod::grey_otsu;
  options.hands.smoothing.max_gap = 1;
  options.min_quality = 0.5;
  const GestureRecognizer recognizer = GestureRecognizer::train(stills(), options);
  const ModelFile file = recognizer.to_model_file();
  const GestureRecognizer again =
      GestureRecognizer::from_model_file(ModelFile::parse(file.serialise(), "x"));
  EXPECT_EQ(again.options().hands.learning, ColourLearning::never);
  EXPECT_EQ(again.options().hands.silhouette.method, SilhouetteMethod::grey_otsu);
  EXPECT_EQ(again.options().hands.smoothing.max_gap, 1);
  EXPECT_EQ(again.options().min_quality, 0.5);
  // Observations below the gate show no hand.
  const GreyImage mask = hand(3);
  std::vector<HandObservation> seen = {{hand_testing::grey(mask), mask, 0.49, false, false}};
  EXPECT_EQ(again.recognise(seen).status, DecisionStatus::no_input);
  seen[0].quality = 0.5;
  EXPECT_EQ(again.recognise(seen).nbest.size(), 3U);
  ModelFile broken = ModelFile::parse(file.serialise(), "x");
  broken.set_integer("hands.smoothing.max_gap", 11);
  EXPECT_THROW(GestureRecognizer::from_model_file(broken), FormatError);
}

// A hand that goes right at another rate of frames, and stands still for a while on its way.
TEST(GestureRecognizer, FollowsATrajectoryAtAnotherTempo) {
  GestureRecognizerOptions options;
  options.model = GestureModel::trajectory;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 6; ++take) {
    samples.push_back(movement(true, take));
    samples.push_back(movement(false, take));
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, options);
  for (const bool right : {true, false}) {
    const MatrixF rows = movement(right, 2).features;
    MatrixF slow(3 * rows.rows(), rows.cols());
    for (Eigen::Index t = 0; t < slow.rows(); ++t) {
      const Eigen::Index with_pause =
          std::min<Eigen::Index>(t, 5) + std::max<Eigen::Index>(t - 25, 0);
      slow.row(t) = rows.row(std::min(with_pause, rows.rows() - 1));
    }
    EXPECT_EQ(recognizer.recognise_features(slow).nbest[0].label, right ? "right" : "down");
    EXPECT_EQ(recognizer.recognise_features(rows.topRows(1)).nbest.size(), 2U);
  }
  EXPECT_THROW((void)recognizer.scores(MatrixF::Zero(3, 9)), InvalidArgument);
}

// A hand that rests before it moves; the rest alone is no trained gesture.
TEST(GestureRecognizer, TurnsDownAHandThatOnlyRests) {
  constexpr Eigen::Index kRest = 12;
  GestureRecognizerOptions options;
  options.model = GestureModel::trajectory;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 6; ++take) {
    for (const bool right : {true, false}) {
      samples.push_back(movement(right, take));
      MatrixF& rows = samples.back().features;
      MatrixF with_rest(kRest + rows.rows(), rows.cols());
      with_rest << rows.row(0).replicate(kRest, 1), rows;
      for (Eigen::Index t = 0; t < with_rest.rows(); ++t)  // hands are never quite still
        with_rest(t, rows.cols() - 3) += 1e-4F * static_cast<float>((t * 7 + take) % 5);
      rows = with_rest;
    }
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, options);
  const ModelFile file = recognizer.to_model_file();
  const GestureRecognizer again = GestureRecognizer::from_model_file(file);
  for (const GestureSample& s : samples) {
    EXPECT_EQ(recognizer.recognise_features(s.features).label, s.label);
    const Decision rest = again.recognise_features(s.features.topRows(kRest));
    EXPECT_EQ(rest.status, DecisionStatus::unknown);
    EXPECT_LT(rest.score, again.recognise_features(s.features).score);
  }
  ModelFile broken = file;
  broken.set_vector("path.movement.weights", VectorD(VectorD::Ones(2)));
  EXPECT_THROW(GestureRecognizer::from_model_file(broken), FormatError);
}

// Rows around one centre a class, and track columns; what is unlike all of them lies apart.
std::vector<GestureSample> around(int num_classes, int takes) {
  Random random(3);
  std::vector<GestureSample> result;
  for (int take = 0; take < takes; ++take) {
    for (int c = 0; c < num_classes; ++c) {
      MatrixF row = MatrixF::Zero(1, 9);
      for (Eigen::Index i = 0; i < 6; ++i) row(0, i) = static_cast<float>(random.uniform());
      row(0, c) += 2;
      result.push_back({row, "sign" + std::to_string(c), "signer" + std::to_string(take % 10)});
    }
  }
  return result;
}

// With enough signers it is learned how signs outside the vocabulary look to the classifier.
TEST(GestureRecognizer, LearnsToTurnDownSignsThatItWasNotTaught) {
  std::vector<GestureSample> known = around(6, 60);
  std::vector<GestureSample> unknown;
  for (auto it = known.begin(); it != known.end();) {
    if (it->label != "sign5") {
      ++it;
      continue;
    }
    unknown.push_back(*it);
    it = known.erase(it);
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(known, {});
  ModelFile file = recognizer.to_model_file();
  ASSERT_EQ(file.vector_d("verifier.weights").size(), 5);
  const GestureRecognizer again = GestureRecognizer::from_model_file(file);
  int accepted = 0;
  for (const GestureSample& s : unknown) {
    const Decision d = recognizer.recognise_features(s.features);
    EXPECT_EQ(d.score, again.recognise_features(s.features).score);
    accepted += d.status == DecisionStatus::recognised ? 1 : 0;
  }
  EXPECT_LE(accepted, static_cast<int>(unknown.size()) / 10);
  int rejected = 0;
  for (const GestureSample& s : known)
    rejected += recognizer.recognise_features(s.features).status == DecisionStatus::unknown ? 1 : 0;
  EXPECT_LE(rejected, static_cast<int>(known.size()) / 20);

  file.set_vector("verifier.weights", VectorD(VectorD::Ones(3)));
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
  // Weights from a few gestures would be chance.
  EXPECT_FALSE(GestureRecognizer::train(around(6, 3), {}).to_model_file().has("verifier.weights"));
}

// A movement on the right side of every plane, but far from all training clips.
TEST(GestureRecognizer, DoubtsMovementsFarFromTheMeanOfTheirClass) {
  GestureRecognizerOptions options;
  options.model = GestureModel::trajectory;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 6; ++take) {
    samples.push_back(movement(true, take));
    samples.push_back(movement(false, take));
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, options);
  MatrixF far = samples.front().features;
  const float usual = recognizer.recognise_features(far).score;
  const Eigen::Index x = far.cols() - 3;
  const float start = far(0, x);
  far.col(x) = (start + 6 * (far.col(x).array() - start)).matrix();
  const Decision decision = recognizer.recognise_features(far);
  EXPECT_EQ(decision.nbest.front().label, "right");
  EXPECT_LT(decision.score, usual);
  ModelFile broken = recognizer.to_model_file();
  broken.set_number("path.usual_distance", 0);
  EXPECT_THROW(GestureRecognizer::from_model_file(broken), FormatError);
  broken = recognizer.to_model_file();
  broken.set_matrix("path.centres", MatrixF(MatrixF::Ones(3, 2)));
  EXPECT_THROW(GestureRecognizer::from_model_file(broken), FormatError);
}

// A hand whose shape changes in one of several ways, after a rest, while it goes to the right; its
// place and its light differ from take to take.
MatrixF folding(int fingers, int take) {
  Random random(static_cast<std::uint64_t>(100 * fingers + take));
  constexpr Eigen::Index kFoldingFrames = 24;
  MatrixF rows(kFoldingFrames, 12);
  const auto own = [&] { return static_cast<float>(random.uniform()) - 0.5F; };
  VectorF start(12);
  for (float& v : start) v = 1 + 0.3F * own();
  const float amount = 1 + 0.4F * own();
  for (Eigen::Index t = 0; t < kFoldingFrames; ++t) {
    const float done = std::max(0.0F, static_cast<float>(t) - 8) / (kFoldingFrames - 9);
    rows.row(t) = start.transpose();
    for (Eigen::Index c = 0; c < 9; ++c) rows(t, c) += 0.02F * own();
    rows(t, fingers) += amount * done;
    rows(t, 9) += 0.2F * done;
  }
  return rows;
}

// The planes between three movements know nothing of a fourth; the verifier does.
TEST(GestureRecognizer, LearnsToTurnDownMovementsThatItWasNotTaught) {
  GestureRecognizerOptions options;
  options.model = GestureModel::trajectory;
  options.turn_degrees = 0;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 10; ++take) {
    for (int c = 0; c < 4; ++c) samples.push_back({folding(c, take), std::string(1, 'a' + c), ""});
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, options);
  ModelFile file = recognizer.to_model_file();
  ASSERT_EQ(file.vector_d("verifier.weights").size(), 6);
  const GestureRecognizer again = GestureRecognizer::from_model_file(file);
  int right = 0;
  int accepted = 0;
  for (int take = 20; take < 40; ++take) {
    const MatrixF known = folding(take % 4, take);
    const Decision d = recognizer.recognise_features(known);
    EXPECT_EQ(d.score, again.recognise_features(known).score);
    right += d.label == std::string(1, 'a' + take % 4) ? 1 : 0;
    const Decision rest = again.recognise_features(known.topRows(8));
    EXPECT_EQ(rest.status, DecisionStatus::unknown) << rest.score;
    EXPECT_LT(rest.score, d.score);
    for (const int other : {5, 6, 7, 8}) {
      const Decision of_other = recognizer.recognise_features(folding(other, take));
      accepted += of_other.status == DecisionStatus::recognised ? 1 : 0;
    }
  }
  EXPECT_GE(right, 18);
  EXPECT_LE(accepted, 8);  // of 80
  file.set_vector("verifier.weights", VectorD(VectorD::Ones(5)));
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
}

TEST(GestureRecognizer, ChoosesItsModelByTheLengthOfTheClips) {
  EXPECT_EQ(GestureRecognizer::train(stills(), {}).options().model, GestureModel::rbf);
  const std::vector<GestureSample> movements{movement(true, 0), movement(true, 1),
                                             movement(false, 0), movement(false, 1)};
  EXPECT_EQ(GestureRecognizer::train(movements, {}).options().model, GestureModel::trajectory);
}

TEST(GestureRecognizer, RemembersWhatItsFeaturesAreMadeFrom) {
  GestureRecognizerOptions options;
  options.source = GestureSource::landmarks;
  ModelFile file = GestureRecognizer::train(stills(), options).to_model_file();
  EXPECT_EQ(GestureRecognizer::from_model_file(file).options().source, GestureSource::landmarks);
  file.set_integer("source", 2);
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
}

TEST(GestureRecognizer, OfLandmarksRefusesSilhouettes) {
  GestureRecognizerOptions options;
  options.source = GestureSource::landmarks;
  const auto recognizer = GestureRecognizer::train(stills(), options);
  EXPECT_THROW(static_cast<void>(recognizer.recognise(Span<const HandObservation>{})), Error);
  const MatrixF features = stills().front().features;
  static_cast<void>(recognizer.recognise_features(features));
  MatrixF wider = MatrixF::Zero(features.rows(), features.cols() + 1);
  EXPECT_THROW(static_cast<void>(recognizer.recognise_features(wider)), Error);
}

TEST(GestureRecognizer, RemembersItsDescriptors) {
  GestureRecognizerOptions options;
  options.features.use_fourier = options.features.use_moments = true;
  options.features.fourier.use_phase = true;
  options.features.wavelet.source = WaveletDescriptorSource::contour;
  options.features.chain_code.num_parts = 5;
  options.features.descriptor_weight = 0.25;
  ModelFile file = GestureRecognizer::train(stills(), options).to_model_file();
  const HandFeatureOptions found = GestureRecognizer::from_model_file(file).options().features;
  EXPECT_TRUE(found.use_fourier && found.use_moments && found.fourier.use_phase);
  EXPECT_FALSE(found.use_wavelet || found.use_chain_code);
  EXPECT_EQ(found.wavelet.source, WaveletDescriptorSource::contour);
  EXPECT_EQ(found.chain_code.num_parts, 5);
  EXPECT_EQ(found.descriptor_weight, 0.25);
  file.set_integer("features.fourier.num_points", 17);
  EXPECT_THROW(GestureRecognizer::from_model_file(file), FormatError);
}

TEST(GestureRecognizer, HoldsRecordingsOutWhereEachSignerHasASignAlone) {
  std::vector<GestureSample> samples = stills();
  for (GestureSample& sample : samples) sample.group = sample.label;
  EXPECT_TRUE(GestureRecognizer::train(samples, {}).calibration().is_fitted());
  const std::vector<GestureSample> one_each{samples[0], samples[4], samples[8]};
  EXPECT_FALSE(GestureRecognizer::train(one_each, {}).calibration().is_fitted());
}

TEST(GestureRecognizer, RefusesBadSets) {
  std::vector<GestureSample> samples = stills();
  samples[3].features(0, 5) = std::nanf("");
  EXPECT_THROW(GestureRecognizer::train(samples, {}), InvalidArgument);
  samples = stills();
  samples.push_back({MatrixF(0, samples[0].features.cols()), "unseen", "signer0"});
  try {
    GestureRecognizer::train(samples, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("unseen"), std::string::npos);
  }
  EXPECT_THROW(GestureRecognizer::train({}, {}), InvalidArgument);
}

}  // namespace
}  // namespace hri
