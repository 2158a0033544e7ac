// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stream/wavelet_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {
namespace {

template <class T>
using Bands = std::vector<std::vector<T>>;

template <class T>
std::vector<T> noise(std::size_t count) {
  Random random(count);
  std::vector<T> x(count);
  for (T& v : x) v = static_cast<T>(random.normal());
  return x;
}

template <class T>
auto into(Bands<T>* bands) {
  return [bands](int band, Span<const T> values) {
    auto& to = bands->at(static_cast<std::size_t>(band));
    to.insert(to.end(), values.begin(), values.end());
  };
}

template <class T>
void push_in_pieces(WaveletStream<T>& stream, const std::vector<T>& x, std::size_t piece,
                    Bands<T>* bands) {
  for (std::size_t i = 0; i < x.size(); i += piece)
    stream.push(Span<const T>(x).subspan(i, std::min(piece, x.size() - i)), into(bands));
}

template <class T>
void expect_the_whole_transform(const char* name, int num_levels) {
  WaveletStream<T> stream({name, num_levels});
  for (const std::size_t count : {1U, 2U, 7U, 100U, 1601U, 5000U}) {
    const std::vector<T> x = noise<T>(count);
    const Bands<T> whole = wavedec<T>(x, wavelet(name), Border::zero, num_levels).coefficients;
    for (const std::size_t piece : {1U, 3U, 160U, 1024U, 5000U}) {
      Bands<T> bands(static_cast<std::size_t>(num_levels) + 1);
      push_in_pieces(stream, x, piece, &bands);
      // What has come so far is final, and no more than the end is missing.
      const std::size_t taps = wavelet(name).dec_lo.size();
      for (std::size_t b = 0; b < bands.size(); ++b) {
        ASSERT_LE(bands[b].size(), whole[b].size());
        ASSERT_TRUE(std::equal(bands[b].begin(), bands[b].end(), whole[b].begin()))
            << name << " band " << b << " of " << count << " by " << piece;
        ASSERT_GE(bands[b].size() + taps, whole[b].size());
      }
      EXPECT_EQ(bands.back().size(), count / 2);
      stream.finish(into(&bands));
      ASSERT_EQ(bands, whole) << name << " " << count << " by " << piece;
    }
  }
}

TEST(WaveletStream, GivesTheWholeTransformToTheBit) {
  for (const char* name : {"haar", "db4", "bior2.2", "db38", "coif17"}) {
    expect_the_whole_transform<float>(name, 1);
    expect_the_whole_transform<float>(name, 5);
    expect_the_whole_transform<double>(name, 3);
  }
}

TEST(WaveletStream, StartsAnew) {
  WaveletStream<double> stream({"db2", 2});
  const std::vector<double> x = noise<double>(50);
  const auto whole = wavedec<double>(x, wavelet("db2"), Border::zero, 2).coefficients;
  Bands<double> nothing(3);
  stream.finish(into(&nothing));
  EXPECT_EQ(nothing, Bands<double>(3));
  stream.push(x, into(&nothing));
  stream.reset();
  Bands<double> bands(3);
  stream.push(x, into(&bands));
  stream.finish(into(&bands));
  EXPECT_EQ(bands, whole);
}

TEST(WaveletStream, RefusesOptionsOutOfRange) {
  EXPECT_THROW(WaveletStream<float>({"db99", 1}), InvalidArgument);
  EXPECT_THROW(WaveletStream<float>({"db2", 0}), InvalidArgument);
  EXPECT_THROW(WaveletStream<float>({"db2", 31}), InvalidArgument);
}

}  // namespace
}  // namespace hri
