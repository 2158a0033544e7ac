// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/network/sequence_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr int kDim = 10;
constexpr int kNumClasses = 3;
constexpr std::size_t kNumExamples = 96;

// A bump that rises over the bands, one that falls, or one that stays, at any time, in noise.
MatrixF sweep(int label, Random* random) {
  const int frames = 24 + static_cast<int>(random->below(8));
  MatrixF result(frames, kDim);
  const double begin = 2 + 6 * random->uniform();
  for (int t = 0; t < frames; ++t) {
    const double way = std::min(1.0, std::max(0.0, (t - begin) / 14));
    const double band = label == 0 ? 8 * way : label == 1 ? 8 * (1 - way) : 4;
    for (int b = 0; b < kDim; ++b) {
      result(t, b) =
          static_cast<float>(std::exp(-0.5 * (b - band) * (b - band)) + 0.3 * random->normal());
    }
  }
  return result;
}

std::vector<int> labels() {
  std::vector<int> result;
  for (std::size_t i = 0; i < kNumExamples; ++i) result.push_back(static_cast<int>(i % 3));
  return result;
}

void make_example(std::size_t index, Random* random, MatrixF* frames) {
  *frames = sweep(static_cast<int>(index % 3), random);
}

SequenceNetworkOptions quick() {
  SequenceNetworkOptions options;
  options.num_channels = 16;
  options.num_blocks = 1;
  options.num_epochs = 12;
  options.batch_size = 32;
  return options;
}

const SequenceNetwork& trained() {
  static const SequenceNetwork network =
      SequenceNetwork::train(make_example, labels(), kNumClasses, quick());
  return network;
}

int best_of(const VectorF& scores) {
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  return static_cast<int>(best);
}

TEST(SequenceNetwork, TellsSweepsApartThatItHasNotSeen) {
  Random random(99);
  int right = 0;
  for (int i = 0; i < 60; ++i)
    right += best_of(trained().log_posteriors(sweep(i % 3, &random))) == i % 3;
  EXPECT_GE(right, 55);
}

TEST(SequenceNetwork, GivesLogProbabilities) {
  Random random(1);
  const VectorF p = trained().log_posteriors(sweep(0, &random)).array().exp().matrix();
  EXPECT_NEAR(p.sum(), 1, 1e-5);
}

TEST(SequenceNetwork, TrainingIsTheSameAgainAndOnASingleThread) {
  SequenceNetworkOptions options = quick();
  options.num_epochs = 2;
  const auto once = [&] {
    return SequenceNetwork::train(make_example, labels(), kNumClasses, options);
  };
  Random random(1);
  const MatrixF frames = sweep(1, &random);
  const VectorF expected = once().log_posteriors(frames);
  VectorF found;
  // Within a task, everything runs on one thread.
  detail::parallel_for(
      1, {}, [&](std::size_t, const StopCheck&) { found = once().log_posteriors(frames); });
  EXPECT_EQ(found, expected);
}

TEST(SequenceNetwork, LearnsAClassFromFewSequencesAndForgetsIt) {
  Random random(5);
  // One that appears all at once on all bands.
  const auto flash = [&] {
    MatrixF frames = sweep(2, &random);
    frames.middleRows(10, 4).array() += 2.0F;
    return frames;
  };
  std::vector<MatrixF> few;
  for (int i = 0; i < 3; ++i) few.push_back(flash());
  const SequenceNetwork more = trained().with_class(1, few);
  EXPECT_EQ(more.num_classes(), 4);
  int right = 0;
  for (int i = 0; i < 20; ++i) right += best_of(more.log_posteriors(flash())) == 1;
  EXPECT_GE(right, 18);
  const MatrixF frames = sweep(0, &random);
  EXPECT_EQ(more.without_class(1).log_posteriors(frames), trained().log_posteriors(frames));
}

TEST(SequenceNetwork, ComesBackFromAFileToTheBit) {
  ModelFile file;
  trained().write(file, "net.");
  Random random(2);
  const MatrixF frames = sweep(1, &random);
  const SequenceNetwork read = SequenceNetwork::read(file, "net.");
  EXPECT_EQ(read.log_posteriors(frames), trained().log_posteriors(frames));
  EXPECT_EQ(read.dim(), kDim);
}

TEST(SequenceNetwork, RefusesFilesThatDoNotFit) {
  const auto broken = [](const auto& change) {
    ModelFile file;
    trained().write(file, "net.");
    change(file);
    return file;
  };
  const auto refuses = [](const ModelFile& file, const char* field) {
    try {
      SequenceNetwork::read(file, "net.");
      ADD_FAILURE() << field;
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  refuses(broken([](ModelFile& f) { f.set_integer("net.dim", 0); }), "net.dim");
  refuses(broken([](ModelFile& f) { f.set_integer("net.dim", 40); }), "net.layer.0.kernel");
  refuses(broken([](ModelFile& f) { f.set_integer("net.layers", 3); }), "net.layers");
  refuses(broken([](ModelFile& f) { f.set_matrix("net.layer.1.kernel", MatrixF::Ones(4, 16)); }),
          "net.layer.1.kernel");
  refuses(broken([](ModelFile& f) { f.set_matrix("net.layer.1.weights", MatrixF::Ones(16, 24)); }),
          "net.layer.1.weights");
  refuses(broken([](ModelFile& f) { f.set_vector("net.layer.1.bias", VectorF(VectorF::Ones(3))); }),
          "net.layer.1.bias");
  refuses(broken([](ModelFile& f) { f.set_matrix("net.means", MatrixF::Ones(2, 64)); }),
          "net.means");
}

TEST(SequenceNetwork, RefusesBadInput) {
  const std::vector<int> two{0, 1};
  EXPECT_THROW(SequenceNetwork::train(make_example, two, 3, quick()), InvalidArgument);
  EXPECT_THROW(SequenceNetwork::train(make_example, two, 1, quick()), InvalidArgument);
  SequenceNetworkOptions options = quick();
  options.num_channels = 12;
  EXPECT_THROW(SequenceNetwork::train(make_example, labels(), 3, options), InvalidArgument);
  const auto infinite = [](std::size_t, Random*, MatrixF* frames) {
    *frames = MatrixF::Constant(20, 4, std::numeric_limits<float>::infinity());
  };
  EXPECT_THROW(SequenceNetwork::train(infinite, two, 2, quick()), InvalidArgument);
  EXPECT_THROW(static_cast<void>(trained().log_posteriors(MatrixF::Ones(10, kDim + 1))),
               InvalidArgument);
  EXPECT_THROW(static_cast<void>(trained().log_posteriors(MatrixF(0, kDim))), InvalidArgument);
  EXPECT_THROW(trained().with_class(5, {MatrixF::Ones(10, kDim)}), InvalidArgument);
  EXPECT_THROW(trained().with_class(0, {}), InvalidArgument);
  EXPECT_THROW(trained().without_class(3), InvalidArgument);
}

TEST(SequenceNetwork, TrainingStopsWhenAsked) {
  int polls = 0;
  const StopCheck stop = [&] { return ++polls > 3; };
  EXPECT_THROW(SequenceNetwork::train(make_example, labels(), 3, quick(), {}, stop), Interrupted);
}

}  // namespace
}  // namespace hri
