// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/dwt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr Border kBorders[] = {Border::symmetric, Border::zero,    Border::constant,
                               Border::periodic,  Border::reflect, Border::periodization};

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

TEST(Wavelet, FiltersAreOrthonormalToTheirEvenShifts) {
  for (const std::string& name : wavelet_names()) {
    // dmey is a finite approximation of an infinite filter.
    const double tolerance = name == "dmey" ? 1e-2 : 1e-8;
    const Wavelet& w = wavelet(name);
    const std::size_t taps = w.dec_lo.size();
    EXPECT_NEAR(std::accumulate(w.rec_lo.begin(), w.rec_lo.end(), 0.0), std::sqrt(2.0), tolerance)
        << name;
    EXPECT_NEAR(std::accumulate(w.rec_hi.begin(), w.rec_hi.end(), 0.0), 0.0, tolerance) << name;
    for (std::size_t shift = 0; shift < taps; shift += 2) {
      double low = 0;
      double cross = 0;
      for (std::size_t k = 0; k + shift < taps; ++k) {
        low += w.dec_lo[k] * w.dec_lo[k + shift];
        cross += w.dec_lo[k] * w.dec_hi[k + shift];
      }
      EXPECT_NEAR(low, shift == 0 ? 1.0 : 0.0, tolerance) << name << " shift " << shift;
      EXPECT_NEAR(cross, 0.0, tolerance) << name << " shift " << shift;
    }
  }
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

template <class T>
void expect_round_trip(double tolerance) {
  for (const std::string& name : wavelet_names()) {
    // dmey is orthonormal to 1e-3 only, so that its inverse is no closer.
    const double bound = name == "dmey" ? 2e-2 : tolerance;
    for (const Border border : kBorders) {
      for (const std::size_t count : {2U, 7U, 16U, 101U}) {
        const std::vector<T> x = noise<T>(count, count);
        const auto levels = wavedec<T>(x, wavelet(name), border, 2);
        EXPECT_LT(largest_difference(waverec<T>(levels, wavelet(name), border), x), bound)
            << name << " border " << static_cast<int>(border) << " length " << count;
      }
    }
  }
}

TEST(Dwt, IsUndoneByItsInverseInDouble) { expect_round_trip<double>(1e-10); }
TEST(Dwt, IsUndoneByItsInverseInSinglePrecision) { expect_round_trip<float>(2e-5); }

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

TEST(Dwt, RefusesLengthsThatDoNotFit) {
  std::vector<double> x(8);
  std::vector<double> right(dwt_length(8, 4, Border::zero));
  std::vector<double> wrong(right.size() + 1);
  EXPECT_THROW(dwt<double>(x, wavelet("db2"), Border::zero, right, wrong), InvalidArgument);
  EXPECT_THROW(dwt<double>(std::vector<double>(), wavelet("db2"), Border::zero, right, right),
               InvalidArgument);
  EXPECT_THROW(wavedec<double>(x, wavelet("db2"), Border::zero, 0), InvalidArgument);
}

TEST(Dwt2, IsUndoneByItsInverse) {
  Random random(2);
  for (const auto& [rows, cols] : {std::pair{8, 8}, {9, 16}, {33, 17}, {1, 5}}) {
    MatrixD image(rows, cols);
    for (Eigen::Index i = 0; i < image.size(); ++i) image.data()[i] = random.normal();
    for (const Border border : kBorders) {
      const auto level = dwt2<double>(image, wavelet("sym4"), border);
      const MatrixD back = idwt2<double>(level, wavelet("sym4"), border, rows, cols);
      EXPECT_LT((back - image).cwiseAbs().maxCoeff(), 1e-10);
    }
  }
}

}  // namespace
}  // namespace hri
