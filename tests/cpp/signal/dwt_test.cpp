// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/dwt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr Border kBordersOfDwt[] = {Border::symmetric, Border::zero,          Border::constant,
                                    Border::periodic,  Border::reflect,       Border::periodization,
                                    Border::smooth,    Border::antisymmetric, Border::antireflect};

template <class T>
std::vector<T> noise(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> x(count);
  for (T& v : x) v = static_cast<T>(random.normal());
  return x;
}

template <class T>
double largest_difference(const std::vector<T>& a, const std::vector<T>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  return largest;
}

// sum_k a[k] b[k + shift]
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t shift) {
  return std::inner_product(b.begin() + static_cast<std::ptrdiff_t>(shift), b.end(), a.begin(),
                            0.0);
}

// Of orthogonal wavelets analysis is synthesis backwards, so that this says they are orthonormal.
TEST(Wavelet, FiltersAreBiorthonormalToTheirEvenShifts) {
  for (const std::string& name : wavelet_names()) {
    // dmey is a finite approximation of an infinite filter; coif17's taps reach far and wide.
    const double tolerance = name == "dmey" ? 1e-2 : 1e-9;
    const Wavelet& w = wavelet(name);
    EXPECT_NEAR(std::accumulate(w.rec_lo.begin(), w.rec_lo.end(), 0.0), std::sqrt(2.0), tolerance)
        << name;
    EXPECT_NEAR(std::accumulate(w.rec_hi.begin(), w.rec_hi.end(), 0.0), 0.0, tolerance) << name;
    const std::vector<double> low(w.dec_lo.rbegin(), w.dec_lo.rend());
    const std::vector<double> high(w.dec_hi.rbegin(), w.dec_hi.rend());
    for (std::size_t shift = 0; shift < w.dec_lo.size(); shift += 2) {
      const double same = shift == 0 ? 1.0 : 0.0;
      for (const bool turned : {false, true}) {
        const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
          return turned ? correlation(b, a, shift) : correlation(a, b, shift);
        };
        EXPECT_NEAR(product(low, w.rec_lo), same, tolerance) << name << " " << shift;
        EXPECT_NEAR(product(high, w.rec_hi), same, tolerance) << name << " " << shift;
        EXPECT_NEAR(product(low, w.rec_hi), 0, tolerance) << name << " " << shift;
        EXPECT_NEAR(product(high, w.rec_lo), 0, tolerance) << name << " " << shift;
      }
    }
  }
}

TEST(Wavelet, HighPassFiltersAreMirrorsOfLowPassOnes) {
  for (const std::string& name : wavelet_names()) {
    const Wavelet& w = wavelet(name);
    EXPECT_EQ(w.name, name);
    const bool orthogonal = name.find("bio") == std::string::npos;
    const bool mirrored = w.rec_lo == std::vector<double>(w.dec_lo.rbegin(), w.dec_lo.rend());
    // The shortest biorthogonal ones are Haar's.
    EXPECT_EQ(mirrored, orthogonal || name.substr(4) == "1.1") << name;
    ASSERT_EQ(w.dec_hi.size(), w.rec_lo.size()) << name;
    ASSERT_EQ(w.rec_hi.size(), w.dec_lo.size()) << name;
    for (std::size_t k = 0; k < w.dec_hi.size(); ++k) {
      EXPECT_EQ(w.dec_hi[k], (k % 2 == 0 ? -1 : 1) * w.rec_lo[k]) << name << " tap " << k;
      EXPECT_EQ(w.rec_hi[k], (k % 2 == 0 ? 1 : -1) * w.dec_lo[k]) << name << " tap " << k;
    }
  }
}

TEST(Wavelet, NamesTellTheNumberOfTapsAndOfVanishingMoments) {
  std::vector<std::string> expected = {"haar"};
  const auto check = [&expected](const std::string& name, int num_taps, int num_moments) {
    expected.push_back(name);
    const std::vector<double>& high = wavelet(name).rec_hi;
    ASSERT_EQ(high.size(), static_cast<std::size_t>(num_taps)) << name;
    for (int p = 0; p < std::min(num_moments, 8); ++p) {  // higher ones drown in rounding
      double moment = 0;
      for (int k = 0; k < num_taps; ++k)
        moment +=
            std::pow(k / static_cast<double>(num_taps), p) * high[static_cast<std::size_t>(k)];
      EXPECT_NEAR(moment, 0, 1e-8) << name << " moment " << p;
    }
  };
  for (int n = 1; n <= 38; ++n) check("db" + std::to_string(n), 2 * n, n);
  for (int n = 2; n <= 20; ++n) check("sym" + std::to_string(n), 2 * n, n);
  for (int n = 1; n <= 17; ++n) check("coif" + std::to_string(n), 6 * n, 2 * n);
  check("dmey", 62, 0);
  for (const char* family : {"bior", "rbio"}) {
    for (const auto& [order, num_taps] : std::vector<std::pair<std::string, int>>{{"1.1", 2},
                                                                                  {"1.3", 6},
                                                                                  {"1.5", 10},
                                                                                  {"2.2", 6},
                                                                                  {"2.4", 10},
                                                                                  {"2.6", 14},
                                                                                  {"2.8", 18},
                                                                                  {"3.1", 4},
                                                                                  {"3.3", 8},
                                                                                  {"3.5", 12},
                                                                                  {"3.7", 16},
                                                                                  {"3.9", 20},
                                                                                  {"4.4", 10},
                                                                                  {"5.5", 12},
                                                                                  {"6.8", 18}})
      check(family + order, num_taps, 1);
  }
  EXPECT_EQ(wavelet_names(), expected);
}

TEST(Wavelet, KnowsHaarAndDb2FromTheirFormulae) {
  EXPECT_NEAR(wavelet("haar").rec_lo[0], 1 / std::sqrt(2.0), 1e-15);
  const double root = std::sqrt(3.0);
  const double scale = 4 * std::sqrt(2.0);
  const double db2[] = {(1 + root) / scale, (3 + root) / scale, (3 - root) / scale,
                        (1 - root) / scale};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(wavelet("db2").rec_lo[k], db2[k], 1e-12);
  EXPECT_THROW((void)wavelet("db0"), InvalidArgument);
}

TEST(Wavelet, LivesAsLongAsTheProgram) { EXPECT_EQ(&wavelet("sym4"), &wavelet("sym4")); }

// dmey is orthonormal to 1e-3 only, so that its inverse is no closer. The straight lines of the
// smooth border climb far above the signal under long filters.
double bound_of(const std::string& name, Border border, double tolerance) {
  const bool climbs = border == Border::smooth;
  if (name == "dmey") return climbs ? 0.6 : 3e-2;
  return climbs ? 8 * tolerance : tolerance;
}

// One level, back at both lengths that idwt offers.
template <class T>
void expect_round_trip_of_one_level(double tolerance) {
  for (const std::string& name : wavelet_names()) {
    const Wavelet& w = wavelet(name);
    for (const Border border : kBordersOfDwt) {
      for (const std::size_t count : {1U, 2U, 3U, 7U, 16U, 61U, 62U, 101U, 128U}) {
        const std::vector<T> x = noise<T>(count, count);
        const std::size_t length = dwt_length(count, w.dec_lo.size(), border);
        std::vector<T> approx(length);
        std::vector<T> detail(length);
        dwt<T>(x, w, border, approx, detail);
        std::vector<T> whole(count + count % 2, std::numeric_limits<T>::quiet_NaN());
        idwt<T>(approx, detail, w, border, whole);
        whole.resize(count);
        EXPECT_LE(largest_difference(whole, x), bound_of(name, border, tolerance))
            << name << " border " << static_cast<int>(border) << " length " << count;
        std::vector<T> cut(count, std::numeric_limits<T>::quiet_NaN());
        idwt<T>(approx, detail, w, border, cut);
        EXPECT_EQ(cut, whole) << name << " border " << static_cast<int>(border) << " length "
                              << count;
      }
    }
  }
}

TEST(Dwt, OneLevelIsUndoneInDouble) { expect_round_trip_of_one_level<double>(1e-10); }
TEST(Dwt, OneLevelIsUndoneInSinglePrecision) { expect_round_trip_of_one_level<float>(2e-5); }

template <class T>
void expect_round_trip(double tolerance) {
  for (const std::string& name : wavelet_names()) {
    for (const Border border : kBordersOfDwt) {
      for (const std::size_t count : {1U, 2U, 7U, 16U, 101U}) {
        for (const int num_levels : {1, 2, 3}) {  // five lose 1.1e-10 to the taps of sym20
          const std::vector<T> x = noise<T>(count, count);
          const auto levels = wavedec<T>(x, wavelet(name), border, num_levels);
          EXPECT_EQ(levels.num_samples, count);
          EXPECT_EQ(levels.coefficients.size(), static_cast<std::size_t>(num_levels) + 1);
          EXPECT_LE(largest_difference(waverec<T>(levels, wavelet(name), border), x),
                    bound_of(name, border, tolerance))
              << name << " border " << static_cast<int>(border) << " length " << count << " levels "
              << num_levels;
        }
      }
    }
  }
}

TEST(Dwt, IsUndoneByItsInverseInDouble) { expect_round_trip<double>(1e-10); }
TEST(Dwt, IsUndoneByItsInverseInSinglePrecision) { expect_round_trip<float>(2e-5); }

// Where the outputs lie decides how they are cut into registers, and must decide nothing else.
template <class T>
void expect_the_same_at_every_place() {
  const Wavelet& w = wavelet("db4");
  for (const std::size_t size : {33U, 500U, 2100U}) {
    const std::vector<T> x = noise<T>(size, 8);
    const auto expected = wavedec<T>(x, w, Border::symmetric, 2);
    for (std::size_t offset = 0; offset < 16; ++offset) {
      std::vector<std::vector<T>> room;
      std::vector<Span<T>> bands;
      for (const std::vector<T>& band : expected.coefficients) {
        room.emplace_back(band.size() + 32, T(7));
        bands.push_back(Span<T>(room.back()).subspan(offset, band.size()));
      }
      wavedec<T>(x, w, Border::symmetric, Span<const Span<T>>(bands));
      for (std::size_t i = 0; i < bands.size(); ++i) {
        const std::vector<T> found(bands[i].begin(), bands[i].end());
        ASSERT_EQ(found, expected.coefficients[i]) << size << ", " << offset;
        ASSERT_EQ(room[i][offset + found.size()], T(7));
        ASSERT_EQ(std::count(room[i].begin(), room[i].begin() + static_cast<std::ptrdiff_t>(offset),
                             T(7)),
                  static_cast<std::ptrdiff_t>(offset));
      }
    }
  }
}
TEST(Dwt, GivesTheSameAtEveryPlaceInMemory) {
  expect_the_same_at_every_place<float>();
  expect_the_same_at_every_place<double>();
}

TEST(Dwt, PeriodizationRepeatsTheLastSampleOfOddSignals) {
  std::vector<double> x = noise<double>(9, 3);
  for (const std::string& name : wavelet_names()) {
    const auto odd = wavedec<double>(x, wavelet(name), Border::periodization, 1);
    std::vector<double> even = x;
    even.push_back(x.back());
    EXPECT_EQ(odd.coefficients,
              wavedec<double>(even, wavelet(name), Border::periodization, 1).coefficients)
        << name;
  }
}

TEST(Dwt, KeepsTheEnergyOfPeriodicSignals) {
  const std::vector<double> x = noise<double>(64, 1);
  const auto energy = [](const std::vector<double>& v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
  };
  const auto levels = wavedec<double>(x, wavelet("db4"), Border::periodization, 3);
  double sum = 0;
  for (const auto& c : levels.coefficients) sum += energy(c);
  EXPECT_NEAR(sum, energy(x), 1e-10);
  EXPECT_EQ(levels.coefficients.size(), 4U);
  EXPECT_EQ(levels.coefficients[0].size(), 8U);
}

TEST(Dwt, SeesNoDetailInPolynomials) {
  // db4 has four vanishing moments: cubic signals have no detail away from the borders.
  std::vector<double> x(64);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::pow(0.1 * static_cast<double>(i), 3);
  const std::size_t length = dwt_length(x.size(), 8, Border::zero);
  std::vector<double> approx(length);
  std::vector<double> detail(length);
  dwt<double>(x, wavelet("db4"), Border::zero, approx, detail);
  for (std::size_t i = 4; i + 4 < length; ++i) EXPECT_NEAR(detail[i], 0, 1e-9);
}

TEST(Dwt, LivesOnOneSampleForAllLevels) {
  const std::vector<double> x = {3};
  for (const std::string& name : wavelet_names()) {
    const auto levels = wavedec<double>(x, wavelet(name), Border::periodization, 62);
    ASSERT_EQ(levels.coefficients.size(), 63U);
    for (std::size_t i = 1; i < levels.coefficients.size(); ++i) {
      ASSERT_EQ(levels.coefficients[i].size(), 1U);
      // A constant has no detail beside the approximation of its level.
      const double scale = 3 * std::pow(2.0, (63 - static_cast<double>(i)) / 2);
      EXPECT_NEAR(levels.coefficients[i][0] / scale, 0, name == "dmey" ? 1e-2 : 1e-10) << name;
    }
    EXPECT_NEAR(waverec<double>(levels, wavelet(name), Border::periodization).at(0), 3,
                name == "dmey" ? 1 : 1e-8)
        << name;
  }
}

TEST(Dwt, GivesZerosForSilence) {
  const std::vector<double> x(21, 0.0);
  for (const std::string& name : wavelet_names()) {
    for (const Border border : kBordersOfDwt) {
      const auto levels = wavedec<double>(x, wavelet(name), border, 3);
      for (const auto& c : levels.coefficients) EXPECT_EQ(c, std::vector<double>(c.size(), 0.0));
      EXPECT_EQ(waverec<double>(levels, wavelet(name), border), x);
    }
  }
}

TEST(Dwt, KeepsItsPrecisionOverTheRangeOfTheType) {
  for (const double scale : {1e-290, 1e290}) {
    std::vector<double> x = noise<double>(33, 4);
    for (double& v : x) v *= scale;
    const auto levels = wavedec<double>(x, wavelet("db4"), Border::symmetric, 2);
    const auto back = waverec<double>(levels, wavelet("db4"), Border::symmetric);
    EXPECT_LT(largest_difference(back, x) / scale, 1e-10) << scale;
  }
}

TEST(Dwt, RefusesLengthsThatDoNotFit) {
  const Wavelet& w = wavelet("db2");
  const std::vector<double> x(8);
  for (const Border border : kBordersOfDwt) {
    std::vector<double> right(dwt_length(8, 4, border));
    std::vector<double> longer(right.size() + 1);
    std::vector<double> shorter(right.size() - 1);
    for (std::vector<double>* wrong : {&longer, &shorter}) {
      EXPECT_THROW(dwt<double>(x, w, border, right, *wrong), InvalidArgument);
      EXPECT_THROW(dwt<double>(x, w, border, *wrong, right), InvalidArgument);
      EXPECT_THROW(dwt<double>(x, w, border, *wrong, *wrong), InvalidArgument);
    }
    std::vector<double> none(dwt_length(0, 4, border));
    EXPECT_THROW(dwt<double>(std::vector<double>(), w, border, none, none), InvalidArgument);
  }
}

TEST(Dwt, InverseRefusesLengthsThatDoNotFit) {
  const Wavelet& w = wavelet("db2");
  const std::vector<double> empty;
  for (const Border border : kBordersOfDwt) {
    const std::vector<double> c(dwt_length(8, 4, border));
    const std::vector<double> shorter(c.size() - 1);
    std::vector<double> x(8);
    EXPECT_NO_THROW(idwt<double>(c, c, w, border, x));
    EXPECT_THROW(idwt<double>(c, shorter, w, border, x), InvalidArgument);
    EXPECT_THROW(idwt<double>(shorter, c, w, border, x), InvalidArgument);
    EXPECT_THROW(idwt<double>(empty, empty, w, border, x), InvalidArgument);
    for (const std::size_t size : {0U, 6U, 9U}) {
      std::vector<double> wrong(size);
      EXPECT_THROW(idwt<double>(c, c, w, border, wrong), InvalidArgument) << size;
    }
  }
  // No signal has one coefficient of four taps.
  const std::vector<double> one(1);
  std::vector<double> x;
  EXPECT_THROW(idwt<double>(one, one, w, Border::zero, x), InvalidArgument);
}

TEST(Dwt, RefusesLevelsOutOfRangeAndEmptySignals) {
  const std::vector<double> x(8);
  for (const Border border : kBordersOfDwt) {
    for (const int num_levels :
         {std::numeric_limits<int>::min(), -1, 0, 63, std::numeric_limits<int>::max()}) {
      EXPECT_THROW(wavedec<double>(x, wavelet("db2"), border, num_levels), InvalidArgument)
          << num_levels;
    }
    EXPECT_THROW(wavedec<double>(std::vector<double>(), wavelet("db2"), border, 1),
                 InvalidArgument);
  }
}

TEST(Dwt, RefusesDecompositionsThatNoSignalHas) {
  const Wavelet& w = wavelet("db2");
  for (const Border border : kBordersOfDwt) {
    const auto whole = wavedec<double>(std::vector<double>(21), w, border, 2);
    EXPECT_NO_THROW(waverec<double>(whole, w, border));
    EXPECT_THROW(waverec<double>({{}, 21}, w, border), InvalidArgument);
    EXPECT_THROW(waverec<double>({{whole.coefficients[0]}, 21}, w, border), InvalidArgument);
    EXPECT_THROW(waverec<double>({{{}, {}}, 21}, w, border), InvalidArgument);
    for (std::size_t i = 0; i < whole.coefficients.size(); ++i) {
      for (const std::size_t size : {std::size_t{0}, whole.coefficients[i].size() + 3}) {
        auto broken = whole;
        broken.coefficients[i].resize(size);
        EXPECT_THROW(waverec<double>(broken, w, border), InvalidArgument)
            << "border " << static_cast<int>(border) << " coefficients " << i << " size " << size;
      }
    }
  }
  EXPECT_THROW(waverec<double>({{{1}, {1}}, 1}, w, Border::zero), InvalidArgument);
}

}  // namespace
}  // namespace hri
