// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

std::vector<float> noise(std::size_t count, double level = 0.1) {
  Random random(4);
  std::vector<float> x(count);
  for (float& v : x) v = static_cast<float>(level * random.normal());
  return x;
}

TEST(CepstraComputer, CountsFramesAndFeatures) {
  const CepstraComputer computer({});
  EXPECT_EQ(computer.num_features(), 39);
  EXPECT_EQ(computer.num_frames(399), 0);
  EXPECT_EQ(computer.num_frames(400), 1);
  const MatrixF features = computer.compute(noise(16000));
  EXPECT_EQ(features.rows(), 98);
  EXPECT_EQ(features.cols(), 39);
}

TEST(CepstraComputer, IsDeafToLoudnessWhereItSaysSo) {
  for (const Normalisation kind :
       {Normalisation::level, Normalisation::mean, Normalisation::mean_variance}) {
    CepstraOptions options;
    options.normalisation = kind;
    const CepstraComputer computer(options);
    const MatrixF loud = computer.compute(noise(8000, 0.5));
    const MatrixF quiet = computer.compute(noise(8000, 0.005));
    EXPECT_LT((loud - quiet).cwiseAbs().maxCoeff(), 1e-2F);
  }
}

TEST(CepstraComputer, GivesFiniteFeaturesForStrangeAudio) {
  for (const float level : {0.0F, 0.5F, 1e18F, -1e-30F}) {
    CepstraOptions options;
    options.normalisation = Normalisation::mean_variance;
    EXPECT_TRUE(CepstraComputer(options).compute(std::vector<float>(4000, level)).allFinite())
        << level;
  }
}

TEST(CepstraComputer, RefusesWithThePlace) {
  const CepstraComputer computer({});
  std::vector<float> x = noise(4000);
  x[1234] = std::numeric_limits<float>::infinity();
  try {
    (void)computer.compute(x);
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("1234"), std::string::npos);
  }
  try {
    (void)computer.compute(noise(10));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("too short"), std::string::npos);
  }
  MatrixF wrong(3, 39);
  EXPECT_THROW(computer.compute(noise(4000), wrong), InvalidArgument);
}

// The weights of 512 filters over a frame of a second at 384 kHz would take half a gigabyte.
TEST(CepstraComputer, RefusesFramesOfMoreSamplesThanAnFft) {
  CepstraOptions options;
  options.sample_rate_hz = 384000;
  options.frame_length_ms = 170;
  EXPECT_EQ(CepstraComputer(options).frame_length(), 65280);
  options.frame_length_ms = 1000;
  EXPECT_THROW(CepstraComputer{options}, InvalidArgument);
}

TEST(CepstraComputer, GivesEveryThreadTheSame) {
  const CepstraComputer computer({});
  const std::vector<float> x = noise(8000);
  const MatrixF expected = computer.compute(x);
  std::vector<MatrixF> found(4);
  std::vector<std::thread> threads;
  for (MatrixF& f : found) threads.emplace_back([&] { f = computer.compute(x); });
  for (std::thread& t : threads) t.join();
  for (const MatrixF& f : found) EXPECT_EQ(f, expected);
}

TEST(CepstraComputer, KeepsTheChannelWhereOnlyTheLevelGoes) {
  CepstraOptions options;
  options.normalisation = Normalisation::none;
  const std::vector<float> x = noise(8000);
  const MatrixF plain = CepstraComputer(options).compute(x);
  options.normalisation = Normalisation::level;
  const MatrixF level = CepstraComputer(options).compute(x);
  EXPECT_NEAR(level.col(0).mean(), 0, 1e-4);
  EXPECT_GT(std::abs(plain.col(0).mean()), 1);
  EXPECT_EQ(level.middleCols(1, 12), plain.middleCols(1, 12));
}

TEST(CepstraComputer, NormalisesEveryStaticCoefficient) {
  CepstraOptions options;
  const std::vector<float> x = noise(16000);
  const MatrixF centred = CepstraComputer(options).compute(x);
  options.normalisation = Normalisation::mean_variance;
  const MatrixF scaled = CepstraComputer(options).compute(x);
  for (int c = 0; c < 13; ++c) {
    EXPECT_NEAR(centred.col(c).mean(), 0, 1e-4) << c;
    EXPECT_NEAR(scaled.col(c).mean(), 0, 1e-4) << c;
    EXPECT_NEAR(scaled.col(c).squaredNorm() / static_cast<float>(scaled.rows()), 1, 1e-3) << c;
  }
}

TEST(CepstraComputer, ComputesTheSameIntoACallersBuffer) {
  const CepstraComputer computer({});
  const std::vector<float> x = noise(5000);
  const MatrixF expected = computer.compute(x);
  MatrixF larger = MatrixF::Constant(expected.rows() + 2, expected.cols(), 7);
  computer.compute(x, larger.middleRows(1, expected.rows()));
  EXPECT_EQ(larger.middleRows(1, expected.rows()), expected);
  EXPECT_EQ(larger.row(0), MatrixF::Constant(1, expected.cols(), 7));
  EXPECT_EQ(larger.bottomRows(1), MatrixF::Constant(1, expected.cols(), 7));
}

TEST(CepstraComputer, KeepsNothingOfTheAudioBefore) {
  const CepstraComputer wide({});
  CepstraOptions options;
  options.frame_length_ms = 10;
  const CepstraComputer narrow(options);
  const std::vector<float> x = noise(5000);
  const MatrixF expected = narrow.compute(x);
  (void)wide.compute(noise(6000, 0.9));
  EXPECT_EQ(narrow.compute(x), expected);
}

TEST(CepstraComputer, FollowsItsOptionsInWidthAndCount) {
  CepstraOptions options;
  options.sample_rate_hz = 8000;
  options.use_c0 = false;
  options.num_cepstra = 7;
  options.delta_orders = 1;
  options.frame_length_ms = 32;
  options.frame_shift_ms = 8;
  const CepstraComputer computer(options);
  EXPECT_EQ(computer.num_static(), 7);
  EXPECT_EQ(computer.num_features(), 14);
  EXPECT_EQ(computer.frame_length(), 256);
  EXPECT_EQ(computer.frame_shift(), 64);
  EXPECT_EQ(computer.num_frames(0), 0);
  EXPECT_EQ(computer.num_frames(319), 1);
  EXPECT_EQ(computer.num_frames(320), 2);
  EXPECT_TRUE(computer.compute(noise(4000)).allFinite());
}

TEST(CepstraComputer, NamesTheFieldThatIsOutOfRange) {
  const auto names = [](const char* field, const std::function<void(CepstraOptions&)>& change) {
    CepstraOptions options;
    change(options);
    const std::string message =
        testing_data::message_of<InvalidArgument>([&] { CepstraComputer{options}; });
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, std::string(field) + " ", message);
  };
  constexpr double kNan = testing_data::kNan;
  for (const int v : {0, 999, 384001})
    names("sample_rate_hz", [v](auto& o) { o.sample_rate_hz = v; });
  for (const double v : {0.0, -5.0, 0.99, 1001.0, kNan}) {
    names("frame_length_ms", [v](auto& o) { o.frame_length_ms = v; });
    names("frame_shift_ms", [v](auto& o) { o.frame_shift_ms = v; });
  }
  for (const double v : {-0.1, 1.1, kNan})
    names("pre_emphasis", [v](auto& o) { o.pre_emphasis = v; });
  for (const int v : {0, -1, 513}) names("num_filters", [v](auto& o) { o.num_filters = v; });
  for (const int v : {0, -3, 26}) names("num_cepstra", [v](auto& o) { o.num_cepstra = v; });
  for (const double v : {-1.0, kNan, testing_data::kInfinity})
    names("lifter", [v](auto& o) { o.lifter = v; });
  for (const int v : {-1, 3}) names("delta_orders", [v](auto& o) { o.delta_orders = v; });
  for (const int v : {0, 11}) names("delta_window", [v](auto& o) { o.delta_window = v; });
  for (const double v : {0.4, 2.1, kNan}) names("warp", [v](auto& o) { o.warp = v; });
  for (const double v : {-1.0, 8000.0, kNan}) names("low_hz", [v](auto& o) { o.low_hz = v; });
  for (const double v : {-1.0, 9000.0, kNan}) names("high_hz", [v](auto& o) { o.high_hz = v; });
}

}  // namespace
}  // namespace hri
