// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra against their definition, written out in double without any of the library's own parts
// but the triangles of its filters.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "core/numbers.hpp"
#include "hri/core/random.hpp"
#include "hri/features/speech/cepstra.hpp"

namespace hri {
namespace {

using detail::kPi;

// A voice of a kind: harmonics of a gliding tone, and noise.
std::vector<float> voice(std::size_t count) {
  Random random(12);
  std::vector<float> x(count);
  double phase = 0;
  for (std::size_t n = 0; n < count; ++n) {
    phase += 2 * kPi * (140 + 0.01 * static_cast<double>(n)) / 16000;
    double value = 0.02 * random.normal();
    for (int h = 1; h <= 12; ++h) value += 0.1 / h * std::sin(h * phase);
    x[n] = static_cast<float>(value);
  }
  return x;
}

std::vector<double> power_spectrum(const std::vector<double>& frame, std::size_t size) {
  std::vector<double> power(size / 2 + 1);
  for (std::size_t k = 0; k < power.size(); ++k) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < frame.size(); ++n) {
      const auto turns = static_cast<double>((k * n) % size) / static_cast<double>(size);
      sum += frame[n] * std::polar(1.0, -2 * kPi * turns);
    }
    power[k] = std::norm(sum);
  }
  return power;
}

// c0 .. c_num of frame `t`; frames of 400 samples every 160, spectrum of 512 points.
std::vector<double> cepstrum(const std::vector<float>& x, int t, const CepstraOptions& o) {
  std::vector<double> frame(400);
  for (std::size_t n = 0; n < frame.size(); ++n) {
    const std::size_t at = static_cast<std::size_t>(t) * 160 + n;
    const double before = at == 0 ? x[0] : x[at - 1];
    const double hamming = 0.54 - 0.46 * std::cos(2 * kPi * static_cast<double>(n) / 399);
    frame[n] = hamming * (x[at] - o.pre_emphasis * before);
  }
  const std::vector<double> power = power_spectrum(frame, 512);
  FilterBankOptions bank;
  bank.kind = o.filter_bank;
  bank.num_filters = o.num_filters;
  bank.low_hz = o.low_hz;
  bank.high_hz = o.high_hz;
  bank.erb_factor = o.erb_factor;
  bank.warp = o.warp;
  std::vector<double> logs;
  for (const FilterTriangle& f : filter_triangles(bank, 16000)) {
    double energy = 0;
    for (std::size_t k = 0; k < power.size(); ++k) {
      const double hz = 31.25 * static_cast<double>(k);
      if (hz <= f.low_hz || hz >= f.high_hz) continue;
      energy += power[k] * (hz <= f.centre_hz ? (hz - f.low_hz) / (f.centre_hz - f.low_hz)
                                              : (f.high_hz - hz) / (f.high_hz - f.centre_hz));
    }
    logs.push_back(std::log(energy));
  }
  std::vector<double> c;
  const auto m = static_cast<double>(logs.size());
  for (int n = 0; n <= o.num_cepstra; ++n) {
    double sum = 0;
    for (std::size_t j = 0; j < logs.size(); ++j)
      sum += logs[j] * std::cos(kPi * n * (static_cast<double>(j) + 0.5) / m);
    const double lift = o.lifter > 0 ? 1 + o.lifter / 2 * std::sin(kPi * n / o.lifter) : 1;
    c.push_back(std::sqrt((n == 0 ? 1 : 2) / m) * lift * sum);
  }
  return c;
}

void expect_definition(const CepstraOptions& changed) {
  CepstraOptions options = changed;
  options.normalisation = Normalisation::none;
  options.delta_orders = 0;
  const std::vector<float> x = voice(1600);
  const MatrixF found = CepstraComputer(options).compute(x);
  ASSERT_EQ(found.rows(), 8);
  for (int t = 0; t < 8; ++t) {
    const std::vector<double> expected = cepstrum(x, t, options);
    for (int n = 0; n <= options.num_cepstra; ++n)
      EXPECT_NEAR(found(t, n), expected[static_cast<std::size_t>(n)], 2e-3) << t << ", c" << n;
  }
}

TEST(CepstraDefinition, HoldsForTheDefaults) { expect_definition({}); }

TEST(CepstraDefinition, HoldsForHfcc) {
  CepstraOptions options;
  options.filter_bank = FilterBankKind::hfcc;
  options.num_filters = 29;
  options.erb_factor = 2;
  expect_definition(options);
}

TEST(CepstraDefinition, HoldsWithoutPreEmphasisAndLifter) {
  CepstraOptions options;
  options.pre_emphasis = 0;
  options.lifter = 0;
  options.num_cepstra = 25;
  expect_definition(options);
}

TEST(CepstraDefinition, HoldsForWarpedAndNarrowedFilters) {
  CepstraOptions options;
  options.low_hz = 200;
  options.high_hz = 6000;
  options.warp = 1.16;
  expect_definition(options);
}

TEST(CepstraDefinition, WithoutC0TheOthersStay) {
  CepstraOptions options;
  options.delta_orders = 0;
  const std::vector<float> x = voice(4000);
  const MatrixF with = CepstraComputer(options).compute(x);
  options.use_c0 = false;
  EXPECT_LT((CepstraComputer(options).compute(x) - with.rightCols(12)).cwiseAbs().maxCoeff(),
            1e-5F);
}

TEST(CepstraDefinition, AccelerationsAreDeltasOfDeltas) {
  const MatrixF f = CepstraComputer({}).compute(voice(6400));
  MatrixF again(f.rows(), 26);
  again.leftCols(13) = f.middleCols(13, 13);
  append_deltas(again, 0, 13, 2);
  EXPECT_EQ(again.rightCols(13), f.rightCols(13));
}

// A voice on a warped frequency axis has the cepstra of the plain voice once the filters follow.
TEST(CepstraDefinition, WarpFollowsAVoiceOfAnotherPitch) {
  const auto tones = [](double factor) {
    std::vector<float> x(3200);
    for (std::size_t n = 0; n < x.size(); ++n) {
      double value = 0;
      for (const double hz : {400.0, 1100.0, 2300.0})
        value += 0.1 * std::sin(2 * kPi * factor * hz * static_cast<double>(n) / 16000);
      x[n] = static_cast<float>(value);
    }
    return x;
  };
  CepstraOptions options;
  options.pre_emphasis = 0;
  options.high_hz = 3000;
  options.num_filters = 16;
  options.num_cepstra = 6;
  options.normalisation = Normalisation::none;
  options.delta_orders = 0;
  const MatrixF plain = CepstraComputer(options).compute(tones(1));
  const MatrixF unwarped = CepstraComputer(options).compute(tones(1.2));
  options.warp = 1.2;
  const MatrixF warped = CepstraComputer(options).compute(tones(1.2));
  EXPECT_LT((plain - warped).norm(), 0.3F * (plain - unwarped).norm());
}

}  // namespace
}  // namespace hri
