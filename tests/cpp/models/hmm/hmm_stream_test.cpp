// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/hmm_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

void push_row(HmmStream<DiscreteHmm>* stream, const SymbolSequence& s, std::size_t t) {
  stream->push(s[t]);
}
void push_row(HmmStream<GaussianMixtureHmm>* stream, const MatrixF& s, std::size_t t) {
  stream->push(row_span(s, static_cast<Eigen::Index>(t)));
}

SymbolSequence head(const SymbolSequence& s, std::size_t count) {
  return {s.begin(), s.begin() + static_cast<std::ptrdiff_t>(count)};
}
MatrixF head(const MatrixF& s, std::size_t count) {
  return s.topRows(static_cast<Eigen::Index>(count));
}

template <class Case>
std::vector<typename Case::Model> models() {
  std::vector<typename Case::Model> result;
  std::uint64_t seed = 0;
  for (const Topology& topology : kTopologies) result.push_back(Case::make(topology, ++seed));
  result.push_back(Case::make({Kind::left_right, 40, 2}, ++seed));
  return result;
}

template <class Stream>
std::vector<double> scores(const Stream& stream) {
  std::vector<double> result(static_cast<std::size_t>(stream.num_models()));
  stream.log_likelihoods(result);
  return result;
}

template <class T>
class Streams : public ::testing::Test {};
using StreamCases = ::testing::Types<DiscreteCase, GaussianCase>;
TYPED_TEST_SUITE(Streams, StreamCases);

TYPED_TEST(Streams, AreAtEveryFrameWhereTheWholeScoreIs) {
  const auto all = models<TypeParam>();
  HmmStream<typename TypeParam::Model> stream(all);
  const auto s = TypeParam::sequence(400, 9);
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(stream.num_frames(), 0);
    EXPECT_EQ(scores(stream), std::vector<double>(all.size(), 0.0));
    for (std::size_t t = 0; t < 400; ++t) {
      push_row(&stream, s, t);
      EXPECT_EQ(stream.num_frames(), static_cast<std::int64_t>(t) + 1);
      if (t > 20 && t % 97 != 0) continue;
      const std::vector<double> now = scores(stream);
      for (std::size_t m = 0; m < all.size(); ++m) {
        const double whole = all[m].log_likelihood(head(s, t + 1));
        EXPECT_NEAR(now[m], whole, 1e-12 * std::abs(whole));
      }
    }
    stream.reset();
  }
}

TYPED_TEST(Streams, RankTheBestFirst) {
  const auto all = models<TypeParam>();
  HmmStream<typename TypeParam::Model> stream(all);
  for (std::size_t t = 0; t < 30; ++t) push_row(&stream, TypeParam::sequence(30, 2), t);
  const std::vector<double> now = scores(stream);
  const std::vector<int> best = stream.nbest(100);
  ASSERT_EQ(best.size(), all.size());
  for (std::size_t i = 1; i < best.size(); ++i)
    EXPECT_GE(now[static_cast<std::size_t>(best[i - 1])], now[static_cast<std::size_t>(best[i])]);
  EXPECT_EQ(stream.nbest(3), std::vector<int>(best.begin(), best.begin() + 3));
  EXPECT_THROW(static_cast<void>(stream.nbest(0)), InvalidArgument);
}

TYPED_TEST(Streams, LoseOnlyModelsBelowTheBeamAndNeverTheBest) {
  int dropped = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<typename TypeParam::Model> all;
    for (std::uint64_t m = 0; m < 10; ++m)
      all.push_back(TypeParam::make({Kind::ergodic, 3, 1}, 100 * seed + m));
    HmmStreamOptions options;
    options.beam = 25;
    HmmStream<typename TypeParam::Model> whole(all);
    HmmStream<typename TypeParam::Model> pruned(all, options);
    const auto s = TypeParam::sequence(60, seed);
    for (std::size_t t = 0; t < 60; ++t) {
      push_row(&whole, s, t);
      push_row(&pruned, s, t);
    }
    EXPECT_EQ(pruned.nbest(1), whole.nbest(1));
    const std::vector<double> exact = scores(whole);
    const std::vector<double> kept = scores(pruned);
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (kept[m] == -kInfinity) {
        ++dropped;
      } else {
        EXPECT_EQ(kept[m], exact[m]);
      }
    }
    EXPECT_EQ(pruned.num_active(),
              std::count_if(kept.begin(), kept.end(), [](double v) { return v > -kInfinity; }));
    pruned.reset();
    EXPECT_EQ(pruned.num_active(), 10);
  }
  if (std::is_same_v<TypeParam, GaussianCase>) {
    EXPECT_GT(dropped, 0);
  }
}

TYPED_TEST(Streams, RefuseWhatDoesNotFit) {
  using Stream = HmmStream<typename TypeParam::Model>;
  EXPECT_THROW(Stream({}), InvalidArgument);
  HmmStreamOptions options;
  options.beam = 0;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "beam",
                      message_of<InvalidArgument>([&] { Stream(models<TypeParam>(), options); }));
}

TEST(DiscreteHmmStream, ChangesNothingOnAnUnknownSymbol) {
  DiscreteHmmStream stream(models<DiscreteCase>());
  stream.push(1);
  const std::vector<double> before = scores(stream);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "symbol 4 at position 1",
                      message_of<InvalidArgument>([&] { stream.push(4); }));
  EXPECT_EQ(scores(stream), before);
  EXPECT_EQ(stream.num_frames(), 1);
}

TEST(GaussianMixtureHmmStream, ChangesNothingOnAFrameThatIsNotFinite) {
  GaussianMixtureHmmStream stream(models<GaussianCase>());
  const std::vector<float> bad{0.0F, kNan};
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "frame 0 is not finite at column 1",
                      message_of<InvalidArgument>([&] { stream.push(bad); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "has 1 values, the model has 2",
                      message_of<InvalidArgument>([&] {
                        stream.push({bad.data(), 1});
                      }));
  EXPECT_EQ(stream.num_frames(), 0);
}

}  // namespace
}  // namespace hri
