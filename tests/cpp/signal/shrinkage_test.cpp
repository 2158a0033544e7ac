// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/shrinkage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr ThresholdRule kRules[] = {ThresholdRule::universal, ThresholdRule::sure,
                                    ThresholdRule::bayes};
constexpr ThresholdShape kShapes[] = {ThresholdShape::soft, ThresholdShape::hard,
                                      ThresholdShape::garrote};
constexpr NoiseEstimate kEstimates[] = {NoiseEstimate::quietest, NoiseEstimate::per_level,
                                        NoiseEstimate::finest};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> normal(std::size_t count, double deviation, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x(count);
  for (double& v : x) v = deviation * random.normal();
  return x;
}

// Two tones that come and go.
std::vector<double> tones(std::size_t count) {
  std::vector<double> x(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    x[i] = (t > 0.3 ? std::sin(56.5 * t) : 0.0) + (t < 0.6 ? 0.7 * std::sin(194.8 * t) : 0.0);
  }
  return x;
}

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) total += (a[i] - b[i]) * (a[i] - b[i]);
  return total;
}

std::vector<double> denoised(const std::vector<double>& x, const ShrinkageOptions& options) {
  return denoise(Span<const double>(x), options);
}

double threshold(const std::vector<double>& details, double noise, ThresholdRule rule) {
  return shrinkage_threshold(Span<const double>(details), noise, details.size(), rule);
}

// What is left of a detail of size d, by the definition of each shape.
double left_of(double d, double t, ThresholdShape shape) {
  const double size = std::abs(d);
  if (shape == ThresholdShape::hard) return size < t ? 0 : d;
  if (size <= t) return 0;
  return shape == ThresholdShape::soft ? (d > 0 ? d - t : d + t) : d - t * t / d;
}

template <class T>
class ShrinkTest : public testing::Test {};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(ShrinkTest, Floats);

TYPED_TEST(ShrinkTest, LeavesOfEveryDetailWhatItsShapeSays) {
  const std::vector<TypeParam> details{-3, -1.5, -1, -0.25, 0, 0.25, 1, 1.5, 3};
  for (const ThresholdShape shape : kShapes) {
    for (const double t : {0.0, 0.5, 1.0, 2.0, kInfinity}) {
      std::vector<TypeParam> shrunk = details;
      shrink(Span<TypeParam>(shrunk), t, shape);
      for (std::size_t i = 0; i < details.size(); ++i) {
        EXPECT_EQ(shrunk[i],
                  static_cast<TypeParam>(left_of(static_cast<double>(details[i]), t, shape)))
            << "detail " << i << " at " << t;
      }
    }
  }
}

TYPED_TEST(ShrinkTest, RefusesThresholdsBelowZero) {
  std::vector<TypeParam> details{1};
  EXPECT_THROW(shrink(Span<TypeParam>(details), -0.1, ThresholdShape::soft), InvalidArgument);
  EXPECT_THROW(shrink(Span<TypeParam>(details), std::nan(""), ThresholdShape::soft),
               InvalidArgument);
  EXPECT_EQ(details[0], 1);
}

TYPED_TEST(ShrinkTest, ApproximationIsAsLoudAsTheSignal) {
  const std::vector<TypeParam> ones(256, 1);
  for (const int levels : {1, 3}) {
    const auto low =
        approximate(Span<const TypeParam>(ones), wavelet("db4"), Border::symmetric, levels);
    EXPECT_GE(low.size(), 256U >> levels);
    EXPECT_LE(low.size(), (256U >> levels) + 7);
    for (const TypeParam v : low) EXPECT_NEAR(v, 1, 1e-5);
  }
}

TEST(NoiseLevel, IsTheMedianOverThatOfNormalNoise) {
  const std::vector<double> odd{3, -1, 2};
  const std::vector<double> even{3, -1, 2, -4};
  EXPECT_DOUBLE_EQ(noise_level(Span<const double>(odd)), 2 / 0.6745);
  EXPECT_DOUBLE_EQ(noise_level(Span<const double>(even)), 2.5 / 0.6745);
  EXPECT_THROW(noise_level(Span<const double>()), InvalidArgument);
}

TEST(NoiseLevel, IsNotMovedByFewLargeDetails) {
  std::vector<double> details = normal(20000, 0.5, 1);
  EXPECT_NEAR(noise_level(Span<const double>(details)), 0.5, 0.015);
  for (std::size_t i = 0; i < details.size(); i += 50) details[i] = 100;
  EXPECT_NEAR(noise_level(Span<const double>(details)), 0.5, 0.03);
}

TEST(ShrinkageThreshold, UniversalGrowsWithTheSignal) {
  const std::vector<double> details{1, 2};
  for (const std::size_t count : {1U, 100U, 16000U}) {
    EXPECT_DOUBLE_EQ(
        shrinkage_threshold(Span<const double>(details), 0.5, count, ThresholdRule::universal),
        0.5 * std::sqrt(2 * std::log(static_cast<double>(count))));
  }
}

TEST(ShrinkageThreshold, BayesIsTheNoiseOverTheDeviationOfWhatIsClean) {
  const std::vector<double> details{3, -3, 3, -3};  // mean square 9
  EXPECT_DOUBLE_EQ(threshold(details, 1, ThresholdRule::bayes), 1 / std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(threshold(details, 2, ThresholdRule::bayes), 4 / std::sqrt(5.0));
  EXPECT_EQ(threshold(details, 3, ThresholdRule::bayes), kInfinity);  // nothing but noise
  EXPECT_EQ(threshold(details, 0, ThresholdRule::bayes), 0);
}

// Stein's estimate of the risk of soft thresholding, in units of the noise.
double risk(const std::vector<double>& details, double noise, double t) {
  auto total = static_cast<double>(details.size());
  for (const double d : details) {
    const double size = std::abs(d) / noise;
    if (size <= t) total -= 2;
    total += std::min(size, t) * std::min(size, t);
  }
  return total;
}

TEST(ShrinkageThreshold, SureHasTheLeastRiskWhereDetailsAreMany) {
  std::vector<double> details = normal(400, 1, 2);
  for (std::size_t i = 0; i < details.size(); i += 3) details[i] += 4;
  for (const double noise : {0.5, 1.0}) {
    const double found = threshold(details, noise, ThresholdRule::sure) / noise;
    const double most = std::sqrt(2 * std::log(400.0));
    EXPECT_GT(found, 0);
    EXPECT_LE(found, most);
    for (const double d : details) {
      const double other = std::min(most, std::abs(d) / noise);
      EXPECT_LE(risk(details, noise, found), risk(details, noise, other) + 1e-9);
    }
  }
}

TEST(ShrinkageThreshold, SureIsUniversalWhereDetailsAreSparse) {
  std::vector<double> details = normal(400, 1, 3);
  details[7] = 6;
  EXPECT_DOUBLE_EQ(threshold(details, 1, ThresholdRule::sure),
                   threshold(details, 1, ThresholdRule::universal));
}

TEST(ShrinkageThreshold, RefusesWhatItCannotUse) {
  const std::vector<double> details{1};
  for (const ThresholdRule rule : kRules) {
    EXPECT_THROW(threshold({}, 1, rule), InvalidArgument);
    EXPECT_THROW(threshold(details, -1, rule), InvalidArgument);
    EXPECT_THROW(shrinkage_threshold(Span<const double>(details), 1, 0, rule), InvalidArgument);
  }
}

TEST(Denoise, TakesWhiteNoiseAndLeavesTheSignal) {
  const std::vector<double> clean = tones(4096);
  const std::vector<double> noisy = sum(clean, normal(4096, 0.3, 4));
  const double before = squared_distance(noisy, clean);
  for (const ThresholdRule rule : kRules) {
    for (const NoiseEstimate estimate : {NoiseEstimate::per_level, NoiseEstimate::finest}) {
      ShrinkageOptions options;
      options.rule = rule;
      options.noise = estimate;
      EXPECT_LT(squared_distance(denoised(noisy, options), clean), before / 5);  // 7 dB
    }
  }
}

TEST(Denoise, KnowsNoiseOfAnyColourFromThePauses) {
  const std::vector<double> white = normal(8192, 1, 5);
  std::vector<double> noise(white.size());
  for (std::size_t i = 0; i < noise.size(); ++i) {  // what is fine is quieter
    for (std::size_t k = 0; k < 6; ++k) noise[i] += white[(i + k) % white.size()] / 6;
  }
  std::vector<double> clean(white.size());
  for (std::size_t i = 2500; i < 5700; ++i) clean[i] = 3 * std::sin(0.537 * static_cast<double>(i));
  const std::vector<double> noisy = sum(clean, noise);
  ShrinkageOptions options;
  const double by_pauses = squared_distance(denoised(noisy, options), clean);
  options.noise = NoiseEstimate::finest;
  EXPECT_LT(1.25 * by_pauses, squared_distance(denoised(noisy, options), clean));
  EXPECT_LT(1.5 * by_pauses, squared_distance(noisy, clean));
}

TEST(Denoise, WithoutStrengthChangesNothing) {
  for (const std::size_t count : {1U, 2U, 37U, 1001U}) {
    const std::vector<double> x = normal(count, 1, 6);
    for (const ThresholdRule rule : kRules) {
      for (const ThresholdShape shape : kShapes) {
        ShrinkageOptions options;
        options.wavelet = "haar";
        options.rule = rule;
        options.shape = shape;
        options.strength = 0;
        EXPECT_LT(squared_distance(denoised(x, options), x), 1e-20) << count;
      }
    }
  }
}

TEST(Denoise, FloatsGiveWhatDoublesGive) {
  const std::vector<double> noisy = sum(tones(1001), normal(1001, 0.3, 7));
  const std::vector<float> single(noisy.begin(), noisy.end());
  for (const NoiseEstimate estimate : kEstimates) {
    ShrinkageOptions options;
    options.noise = estimate;
    const std::vector<double> expected = denoised(noisy, options);
    const std::vector<float> found = denoise(Span<const float>(single), options);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(static_cast<double>(found[i]), expected[i], 1e-4) << i;
  }
}

TEST(Denoise, SilenceStaysSilent) {
  for (const ThresholdRule rule : kRules) {
    ShrinkageOptions options;
    options.rule = rule;
    EXPECT_EQ(denoised(std::vector<double>(100), options), std::vector<double>(100));
  }
}

TEST(Denoise, RefusesBadSignalsAndOptions) {
  const std::vector<double> x = tones(64);
  EXPECT_THROW(denoised({}, {}), InvalidArgument);
  for (const double bad : {std::nan(""), kInfinity}) {
    std::vector<double> broken = x;
    broken[5] = bad;
    EXPECT_THROW(denoised(broken, {}), InvalidArgument);
  }
  ShrinkageOptions options;
  options.num_levels = -1;
  EXPECT_THROW(denoised(x, options), InvalidArgument);
  options.num_levels = 63;
  EXPECT_THROW(denoised(x, options), InvalidArgument);
  options = {};
  options.wavelet = "no such wavelet";
  EXPECT_THROW(denoised(x, options), InvalidArgument);
  for (const double bad : {-1.0, std::nan(""), kInfinity}) {
    options = {};
    options.strength = bad;
    EXPECT_THROW(denoised(x, options), InvalidArgument);
  }
}

}  // namespace
}  // namespace hri
