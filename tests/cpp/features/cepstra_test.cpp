// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/cepstra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

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

TEST(Deltas, OfARampAreItsSlope) {
  MatrixF frames = MatrixF::Zero(20, 2);
  for (int t = 0; t < 20; ++t) frames(t, 0) = 3.0F * static_cast<float>(t);
  append_deltas(frames, 0, 1, 2);
  for (int t = 2; t < 18; ++t) EXPECT_NEAR(frames(t, 1), 3, 1e-5);
}

TEST(Normalise, MakesConstantColumnsZero) {
  MatrixF frames = MatrixF::Constant(10, 2, 7);
  normalise(frames, 2, Normalisation::mean_variance, 0);
  EXPECT_EQ(frames, MatrixF::Zero(10, 2));
}

}  // namespace
}  // namespace hri
