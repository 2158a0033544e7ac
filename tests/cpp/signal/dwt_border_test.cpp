// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The transform against its definition: the signal is written out beyond its ends sample by sample
// and filtered by two plain loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {
namespace {

constexpr Border kEveryBorder[] = {Border::symmetric, Border::zero,          Border::constant,
                                   Border::periodic,  Border::reflect,       Border::periodization,
                                   Border::smooth,    Border::antisymmetric, Border::antireflect};

// The signal turned about both of its ends, again and again.
std::vector<double> turned(const std::vector<double>& x, std::size_t by) {
  std::vector<double> wide = x;
  while (wide.size() < 2 * by + x.size()) {
    const std::vector<double> middle = wide;
    if (middle.size() == 1) return std::vector<double>(2 * by + 1, middle[0]);
    wide.clear();
    for (std::size_t i = middle.size() - 1; i > 0; --i)
      wide.push_back(2 * middle.front() - middle[i]);
    wide.insert(wide.end(), middle.begin(), middle.end());
    for (std::size_t i = middle.size() - 1; i > 0; --i)
      wide.push_back(2 * middle.back() - middle[i - 1]);
  }
  const auto first = wide.begin() + static_cast<std::ptrdiff_t>((wide.size() - x.size()) / 2 - by);
  return {first, first + static_cast<std::ptrdiff_t>(2 * by + x.size())};
}

double beyond_an_end(double end, double before_it, std::size_t steps, Border border) {
  if (border == Border::zero) return 0;
  return border == Border::constant ? end : end + static_cast<double>(steps) * (end - before_it);
}

// The signal and `by` samples beyond each end.
std::vector<double> grown(const std::vector<double>& x, Border border, std::size_t by) {
  if (border == Border::antireflect) return turned(x, by);
  std::vector<double> tile = x;
  if (border == Border::periodization && x.size() % 2 == 1) tile.push_back(x.back());
  if (border == Border::symmetric) tile.insert(tile.end(), x.rbegin(), x.rend());
  if (border == Border::antisymmetric)
    std::transform(x.rbegin(), x.rend(), std::back_inserter(tile), std::negate<>());
  if (border == Border::reflect && x.size() > 1)
    tile.insert(tile.end(), x.rbegin() + 1, x.rend() - 1);
  const std::size_t middle = border == Border::periodization ? tile.size() : x.size();
  const std::size_t second = x.size() > 1 ? 1 : 0;
  std::vector<double> out(2 * by + middle);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (border == Border::zero || border == Border::constant || border == Border::smooth) {
      if (i < by) {
        out[i] = beyond_an_end(x.front(), x[second], by - i, border);
      } else if (i < by + x.size()) {
        out[i] = x[i - by];
      } else {
        out[i] = beyond_an_end(x.back(), *(x.rbegin() + static_cast<std::ptrdiff_t>(second)),
                               i + 1 - by - x.size(), border);
      }
    } else {
      out[i] = tile[(i + tile.size() * (by / tile.size() + 1) - by) % tile.size()];
    }
  }
  return out;
}

TEST(DwtBorder, EqualsTheDefinitionAtEveryBorder) {
  for (const char* name : {"haar", "db2", "db3", "db6", "sym4", "coif2"}) {
    const Wavelet& w = wavelet(name);
    const std::size_t taps = w.dec_lo.size();
    for (const Border border : kEveryBorder) {
      for (const std::size_t count : {1U, 2U, 3U, 8U, 9U, 40U, 41U}) {
        Random random(count);
        std::vector<double> x(count);
        for (double& v : x) v = random.normal();
        const std::size_t length = dwt_length(count, taps, border);
        std::vector<double> approx(length);
        std::vector<double> detail(length);
        dwt<double>(x, w, border, approx, detail);
        const std::size_t by = 2 * taps;
        const std::vector<double> wide = grown(x, border, by);
        const std::size_t shift = border == Border::periodization ? taps / 2 : 1;
        for (std::size_t k = 0; k < length; ++k) {
          double low = 0;
          double high = 0;
          for (std::size_t j = 0; j < taps; ++j) {
            low += w.dec_lo[j] * wide[by + 2 * k + shift - j];
            high += w.dec_hi[j] * wide[by + 2 * k + shift - j];
          }
          EXPECT_NEAR(approx[k], low, 1e-12) << name << " border " << static_cast<int>(border)
                                             << " length " << count << " k " << k;
          EXPECT_NEAR(detail[k], high, 1e-12) << name << " border " << static_cast<int>(border)
                                              << " length " << count << " k " << k;
        }
      }
    }
  }
}

TEST(DwtBorder, EnergyStaysForEveryWaveletThatWrapsAround) {
  for (const std::string& name : wavelet_names()) {
    if (name.find("bio") != std::string::npos) continue;  // not orthogonal
    for (const std::size_t count : {16U, 128U}) {
      Random random(count);
      std::vector<double> x(count);
      for (double& v : x) v = random.normal();
      double sum = 0;
      for (const auto& c : wavedec<double>(x, wavelet(name), Border::periodization, 3).coefficients)
        sum += std::inner_product(c.begin(), c.end(), c.begin(), 0.0);
      const double energy = std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
      EXPECT_NEAR(sum / energy, 1, name == "dmey" ? 1e-2 : 1e-9) << name << " " << count;
    }
  }
}

TEST(DwtBorder, OneSampleAndConstantsComeBack) {
  for (const Border border : kEveryBorder) {
    for (const char* name : {"haar", "db6", "dmey"}) {
      const std::vector<double> one{2.5};
      const auto levels = wavedec<double>(one, wavelet(name), border, 1);
      const std::vector<double> back = waverec<double>(levels, wavelet(name), border);
      ASSERT_EQ(back.size(), 1U);
      EXPECT_NEAR(back[0], 2.5, 1e-2) << name << " border " << static_cast<int>(border);
    }
    if (border == Border::zero || border == Border::antisymmetric)
      continue;  // a constant has edges there
    const std::vector<double> constant(20, 3);
    const auto levels = wavedec<double>(constant, wavelet("db6"), border, 2);
    for (std::size_t c = 1; c < levels.coefficients.size(); ++c) {
      for (const double v : levels.coefficients[c]) EXPECT_NEAR(v, 0, 1e-9);
    }
    for (const double v : levels.coefficients[0]) EXPECT_NEAR(v, 6, 1e-9);
  }
}

TEST(DwtBorder, CountsCoefficientsAsTheHeaderSays) {
  EXPECT_EQ(dwt_length(8, 4, Border::zero), 5U);
  EXPECT_EQ(dwt_length(9, 4, Border::symmetric), 6U);
  EXPECT_EQ(dwt_length(9, 4, Border::periodization), 5U);
  EXPECT_EQ(dwt_length(1, 40, Border::periodization), 1U);
  EXPECT_EQ(dwt_length(1, 40, Border::reflect), 20U);
}

TEST(DwtBorder, NaNStaysNearWhereItStood) {
  std::vector<double> x(64, 1);
  x[32] = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> approx(dwt_length(64, 4, Border::symmetric));
  std::vector<double> detail(approx.size());
  dwt<double>(x, wavelet("db2"), Border::symmetric, approx, detail);
  for (std::size_t k = 0; k < approx.size(); ++k) {
    const bool near = k == 16 || k == 17;  // output k reads samples 2 k - 2 .. 2 k + 1
    EXPECT_EQ(std::isnan(approx[k]), near) << k;
    EXPECT_EQ(std::isnan(detail[k]), near) << k;
  }
}

TEST(DwtBorder, InverseRefusesCoefficientsThatNoSignalHas) {
  const Wavelet& w = wavelet("db4");
  const auto rec = [&w](std::vector<std::vector<double>> c, Border border) {
    return waverec<double>({std::move(c), 100}, w, border);
  };
  using V = std::vector<double>;
  EXPECT_THROW(rec({}, Border::zero), InvalidArgument);
  EXPECT_THROW(rec({V(5)}, Border::zero), InvalidArgument);
  EXPECT_THROW(rec({V(), V()}, Border::zero), InvalidArgument);
  EXPECT_THROW(rec({V(), V()}, Border::periodization), InvalidArgument);
  EXPECT_THROW(rec({V(3), V(3)}, Border::zero), InvalidArgument);  // eight taps leave no sample
  EXPECT_THROW(rec({V(1), V(50)}, Border::zero), InvalidArgument);
  EXPECT_THROW(rec({V(52), V(50)}, Border::zero), InvalidArgument);
  EXPECT_THROW(rec({V(8), V(8), V(30)}, Border::periodization), InvalidArgument);
  EXPECT_EQ(rec({V(50), V(50)}, Border::zero).size(), 94U);
  V x(94);
  EXPECT_THROW(idwt<double>(V(50), V(49), w, Border::zero, Span<double>(x)), InvalidArgument);
  EXPECT_THROW(idwt<double>(V(), V(), w, Border::zero, Span<double>(x)), InvalidArgument);
  EXPECT_THROW(idwt<double>(V(51), V(51), w, Border::zero, Span<double>(x)), InvalidArgument);
  EXPECT_THROW(wavedec<double>(x, w, Border::zero, 63), InvalidArgument);
  EXPECT_THROW(wavedec<double>(V(), w, Border::zero, 1), InvalidArgument);
}

TEST(Wavelet, RefusalListsTheNames) {
  for (const char* name : {"", "db39", "sym1", "Haar", "db4 "}) {
    try {
      (void)wavelet(name);
      ADD_FAILURE() << name;
    } catch (const InvalidArgument& error) {
      EXPECT_NE(std::string(error.what()).find("coif17"), std::string::npos);
    }
  }
  EXPECT_EQ(wavelet_names().size(), 106U);  // haar, 38 db, 19 sym, 17 coif, dmey, 2 x 15 bio
}

TEST(Wavelet, HasAsManyVanishingMomentsAsItsName) {
  for (int order = 1; order <= 10; ++order) {
    const Wavelet& w = wavelet("db" + std::to_string(order));
    ASSERT_EQ(w.dec_lo.size(), static_cast<std::size_t>(2 * order));
    for (int moment = 0; moment <= order; ++moment) {
      double sum = 0;
      double size = 0;
      for (std::size_t k = 0; k < w.rec_hi.size(); ++k) {
        const double term = w.rec_hi[k] * std::pow(static_cast<double>(k), moment);
        sum += term;
        size += std::abs(term);
      }
      if (moment < order) {
        EXPECT_NEAR(sum / size, 0, 1e-8) << w.name << " moment " << moment;
      } else {
        EXPECT_GT(std::abs(sum / size), 1e-8) << w.name;
      }
    }
  }
}

}  // namespace
}  // namespace hri
