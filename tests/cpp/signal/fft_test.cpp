// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/fft.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <thread>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/framing.hpp"

namespace hri {
namespace {

using detail::kPi;

std::vector<float> white_noise(int count) {
  Random random(static_cast<std::uint64_t>(count));
  std::vector<float> x(static_cast<std::size_t>(count));
  for (float& v : x) v = static_cast<float>(random.normal());
  return x;
}

TEST(RealFft, EqualsTheSumItStandsFor) {
  for (const int size : {2, 4, 6, 30, 64, 200, 512}) {
    const std::vector<float> x = white_noise(size);
    const RealFft fft(size);
    std::vector<std::complex<float>> bins(static_cast<std::size_t>(fft.num_bins()));
    fft.forward(x, bins);
    std::vector<float> power(bins.size());
    fft.power_spectrum(x, power);
    for (std::size_t k = 0; k < bins.size(); ++k) {
      std::complex<double> sum = 0;
      for (std::size_t n = 0; n < x.size(); ++n) {
        sum += static_cast<double>(x[n]) *
               std::polar(1.0, -2 * kPi * static_cast<double>(k * n) / size);
      }
      EXPECT_NEAR(std::abs(sum - std::complex<double>(bins[k])), 0, 1e-4) << size << " bin " << k;
      EXPECT_NEAR(power[k], std::norm(sum), 1e-4 * (1 + std::norm(sum)));
    }
  }
}

TEST(RealFft, KeepsEnergy) {
  const std::vector<float> x = white_noise(256);
  std::vector<float> power(129);
  RealFft(256).power_spectrum(x, power);
  double in_time = 0;
  for (const float v : x) in_time += static_cast<double>(v) * v;
  double in_bins = power.front() + power.back();
  for (std::size_t k = 1; k < 128; ++k) in_bins += 2.0 * power[k];
  EXPECT_NEAR(in_bins / 256, in_time, 1e-3);
}

TEST(RealFft, PutsAToneIntoItsBinAndAnImpulseIntoAll) {
  constexpr int kSize = 400;
  std::vector<float> x(kSize);
  std::vector<float> power(kSize / 2 + 1);
  const RealFft fft(kSize);
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = static_cast<float>(std::cos(2 * kPi * 30 * static_cast<double>(n) / kSize));
  fft.power_spectrum(x, power);
  for (std::size_t k = 0; k < power.size(); ++k)
    EXPECT_NEAR(power[k] / (kSize * kSize / 4.0), k == 30 ? 1 : 0, 1e-5) << k;
  std::fill(x.begin(), x.end(), 0.0F);
  fft.power_spectrum(x, power);
  EXPECT_EQ(power, std::vector<float>(power.size(), 0.0F));
  x[123] = 2;
  fft.power_spectrum(x, power);
  for (const float p : power) EXPECT_NEAR(p, 4, 1e-4);
}

TEST(RealFft, OneValueThatIsNotANumberShowsInEveryBin) {
  std::vector<float> x = white_noise(64);
  x[10] = std::nanf("");
  std::vector<float> power(33);
  RealFft(64).power_spectrum(x, power);
  for (const float p : power) EXPECT_TRUE(std::isnan(p));
  // And in no later call: the work space of the thread keeps nothing.
  RealFft(64).power_spectrum(white_noise(64), power);
  for (const float p : power) EXPECT_TRUE(std::isfinite(p));
}

TEST(RealFft, OfLargeSizesKeepsItsPrecision) {
  constexpr int kSize = 1 << 16;
  const std::vector<float> x = white_noise(kSize);
  std::vector<float> power(kSize / 2 + 1);
  RealFft(kSize).power_spectrum(x, power);
  for (const std::size_t k : {0U, 1U, 12345U, 32768U}) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      sum += static_cast<double>(x[n]) *
             std::polar(1.0, -2 * kPi * static_cast<double>((k * n) % kSize) / kSize);
    }
    EXPECT_NEAR(power[k] / kSize, std::norm(sum) / kSize, 1e-4 * (1 + std::norm(sum) / kSize)) << k;
  }
}

TEST(RealFft, GivesEveryThreadTheSame) {
  const RealFft fft(512);
  const std::vector<float> x = white_noise(512);
  std::vector<std::vector<float>> found(4, std::vector<float>(257));
  std::vector<std::thread> threads;
  for (auto& power : found) {
    threads.emplace_back([&fft, &x, &power] {
      for (int i = 0; i < 50; ++i) fft.power_spectrum(x, power);
    });
  }
  for (std::thread& t : threads) t.join();
  for (const auto& power : found) EXPECT_EQ(power, found.front());
}

TEST(RealFft, RefusesOddAndEmptySizes) {
  for (const int size : {-2, 0, 1, 3, 1 << 25})
    EXPECT_THROW(RealFft{size}, InvalidArgument) << size;
  std::vector<float> wrong(3);
  EXPECT_THROW(RealFft(4).power_spectrum(wrong, wrong), InvalidArgument);
}

TEST(Framing, CountsWholeFrames) {
  EXPECT_EQ(num_frames(399, 400, 160), 0);
  EXPECT_EQ(num_frames(400, 400, 160), 1);
  EXPECT_EQ(num_frames(559, 400, 160), 1);
  EXPECT_EQ(num_frames(560, 400, 160), 2);
  const std::vector<float> window = make_window(WindowKind::hamming, 5);
  EXPECT_NEAR(window[0], 0.08, 1e-6);
  EXPECT_NEAR(window[2], 1.0, 1e-6);
  EXPECT_EQ(window[0], window[4]);
}

}  // namespace
}  // namespace hri
