// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/filter_bank.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using testing_data::kNan;
using testing_data::message_of;

constexpr FilterBankKind kKinds[] = {FilterBankKind::mel, FilterBankKind::hfcc};

FilterBankOptions bank_of(FilterBankKind kind, int num_filters = 29) {
  FilterBankOptions options;
  options.kind = kind;
  options.num_filters = num_filters;
  return options;
}

TEST(MelScale, HoldsItsDefinitionAndItsInverse) {
  EXPECT_DOUBLE_EQ(hz_to_mel(0), 0);
  EXPECT_NEAR(hz_to_mel(700), 2595 * std::log10(2.0), 1e-9);
  EXPECT_NEAR(hz_to_mel(1000), 1000, 0.1);
  for (const double hz : {0.0, 1.0, 123.4, 4000.0, 192000.0})
    EXPECT_NEAR(mel_to_hz(hz_to_mel(hz)), hz, 1e-9 * (1 + hz));
}

TEST(EquivalentRectangularBandwidth, IsMooreAndGlasbergsTimesTheFactor) {
  EXPECT_NEAR(equivalent_rectangular_bandwidth(1000, 1), 6.23 + 93.39 + 28.52, 1e-9);
  EXPECT_NEAR(equivalent_rectangular_bandwidth(1000, 3), 3 * (6.23 + 93.39 + 28.52), 1e-9);
}

TEST(FilterTriangles, StandBetweenTheEdgesInRisingOrder) {
  for (const FilterBankKind kind : kKinds) {
    for (const double high_hz : {0.0, 4000.0}) {
      FilterBankOptions options = bank_of(kind);
      options.high_hz = high_hz;
      const auto triangles = filter_triangles(options, 16000);
      ASSERT_EQ(triangles.size(), 29U);
      EXPECT_NEAR(triangles.front().low_hz, 100, 1e-6);
      EXPECT_NEAR(triangles.back().high_hz, high_hz > 0 ? high_hz : 8000, 1e-6);
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        EXPECT_LT(triangles[i].low_hz, triangles[i].centre_hz);
        EXPECT_LT(triangles[i].centre_hz, triangles[i].high_hz);
        if (i > 0) {
          EXPECT_LT(triangles[i - 1].centre_hz, triangles[i].centre_hz);
        }
      }
    }
  }
}

TEST(FilterTriangles, OfMelMeetAtEachOthersCentresAndAreEvenInMel) {
  const auto triangles = filter_triangles(bank_of(FilterBankKind::mel), 16000);
  const double step = (hz_to_mel(8000) - hz_to_mel(100)) / 30;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    EXPECT_NEAR(hz_to_mel(triangles[i].centre_hz),
                hz_to_mel(100) + static_cast<double>(i + 1) * step, 1e-6);
    if (i > 0) {
      EXPECT_DOUBLE_EQ(triangles[i].low_hz, triangles[i - 1].centre_hz);
      EXPECT_DOUBLE_EQ(triangles[i - 1].high_hz, triangles[i].centre_hz);
    }
  }
}

TEST(FilterTriangles, OfHfccAreAsWideAsAnEarTimesE) {
  for (const double factor : {0.5, 1.0, 3.0}) {
    FilterBankOptions options = bank_of(FilterBankKind::hfcc);
    options.erb_factor = factor;
    const auto triangles = filter_triangles(options, 16000);
    const double step = hz_to_mel(triangles[1].centre_hz) - hz_to_mel(triangles[0].centre_hz);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const FilterTriangle& t = triangles[i];
      // A triangle's own equivalent rectangle is half as wide as its base.
      EXPECT_NEAR((t.high_hz - t.low_hz) / 2, equivalent_rectangular_bandwidth(t.centre_hz, factor),
                  1e-6);
      // Its centre is the middle of its edges in mel.
      EXPECT_NEAR(hz_to_mel(t.centre_hz), (hz_to_mel(t.low_hz) + hz_to_mel(t.high_hz)) / 2, 1e-6);
      if (i > 0) {
        EXPECT_NEAR(hz_to_mel(t.centre_hz) - hz_to_mel(triangles[i - 1].centre_hz), step, 1e-6);
      }
    }
  }
}

TEST(FilterTriangles, OfMelIgnoreE) {
  FilterBankOptions options = bank_of(FilterBankKind::mel);
  const auto plain = filter_triangles(options, 16000);
  options.erb_factor = 5;
  EXPECT_DOUBLE_EQ(filter_triangles(options, 16000)[7].high_hz, plain[7].high_hz);
}

TEST(FilterTriangles, WarpScalesEveryFrequency) {
  for (const FilterBankKind kind : kKinds) {
    FilterBankOptions options = bank_of(kind);
    const auto plain = filter_triangles(options, 16000);
    for (const double warp : {0.5, 0.92, 1.08, 2.0}) {
      options.warp = warp;
      const auto warped = filter_triangles(options, 16000);
      for (std::size_t i = 0; i < plain.size(); ++i) {
        EXPECT_NEAR(warped[i].low_hz, warp * plain[i].low_hz, 1e-9);
        EXPECT_NEAR(warped[i].centre_hz, warp * plain[i].centre_hz, 1e-9);
        EXPECT_NEAR(warped[i].high_hz, warp * plain[i].high_hz, 1e-9);
      }
    }
  }
}

TEST(FilterBank, SamplesItsTriangles) {
  for (const FilterBankKind kind : kKinds) {
    const FilterBankOptions options = bank_of(kind);
    const auto triangles = filter_triangles(options, 16000);
    const FilterBank bank(options, 16000, 1024);
    ASSERT_EQ(bank.num_filters(), 29);
    ASSERT_EQ(bank.num_bins(), 513);
    for (int i = 0; i < bank.num_filters(); ++i) {
      const FilterTriangle& t = triangles[static_cast<std::size_t>(i)];
      for (int k = 0; k < bank.num_bins(); ++k) {
        const double f = 15.625 * k;
        const double rising = (f - t.low_hz) / (t.centre_hz - t.low_hz);
        const double falling = (t.high_hz - f) / (t.high_hz - t.centre_hz);
        EXPECT_NEAR(bank.weights()(i, k), std::max(0.0, std::min(rising, falling)), 1e-6);
      }
    }
  }
}

TEST(FilterBank, LeavesNoFilterOfTheDefaultsEmpty) {
  for (const FilterBankKind kind : kKinds) {
    for (const auto& [rate_hz, fft_size] : {std::pair{8000, 256}, {16000, 512}, {48000, 2048}}) {
      const FilterBank bank(bank_of(kind, 26), rate_hz, fft_size);
      for (int i = 0; i < bank.num_filters(); ++i) {
        EXPECT_GT(bank.weights().row(i).sum(), 0) << rate_hz << " Hz, filter " << i;
        EXPECT_LE(bank.weights().row(i).maxCoeff(), 1.0F);
      }
    }
  }
}

TEST(FilterBank, WeightsOfMelAddUpToOneBetweenTheOuterCentres) {
  const auto triangles = filter_triangles(bank_of(FilterBankKind::mel), 16000);
  const FilterBank bank(bank_of(FilterBankKind::mel), 16000, 1024);
  for (int k = 0; k < bank.num_bins(); ++k) {
    const double f = 15.625 * k;
    if (f <= triangles.front().centre_hz || f >= triangles.back().centre_hz) continue;
    EXPECT_NEAR(bank.weights().col(k).sum(), 1, 1e-5) << f;
  }
}

TEST(FilterBank, AppliesItsWeights) {
  for (const FilterBankKind kind : kKinds) {
    const FilterBank bank(bank_of(kind, 26), 16000, 512);
    const MatrixF power = testing_data::noise(1, 257, 5, 4).cwiseAbs();
    std::vector<float> out(26, kNan);
    bank.apply(row_span(power, 0), out);
    const VectorF expected = bank.weights() * power.row(0).transpose();
    for (int i = 0; i < 26; ++i)
      EXPECT_NEAR(out[static_cast<std::size_t>(i)], expected[i], 1e-5F * expected[i]);
  }
}

TEST(FilterBank, RefusesVectorsOfOtherLengths) {
  const FilterBank bank({}, 16000, 512);
  std::vector<float> power(256);
  std::vector<float> out(26);
  EXPECT_THROW(bank.apply(power, out), InvalidArgument);
  power.resize(257);
  out.resize(25);
  EXPECT_THROW(bank.apply(power, out), InvalidArgument);
}

TEST(FilterBank, NamesTheFieldThatIsOutOfRange) {
  const auto refusal = [](const std::function<void(FilterBankOptions&)>& change,
                          int rate_hz = 16000, int fft_size = 512) {
    FilterBankOptions options;
    change(options);
    return message_of<InvalidArgument>([&] { FilterBank(options, rate_hz, fft_size); });
  };
  const auto keep = [](FilterBankOptions&) {};
  const auto names = [](const std::string& message, const char* field) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, std::string(field) + " ", message);
  };
  for (const int value : {0, -1, 513})
    names(refusal([&](auto& o) { o.num_filters = value; }), "num_filters");
  for (const double value : {-1.0, 8000.0, 9000.0, static_cast<double>(kNan)})
    names(refusal([&](auto& o) { o.low_hz = value; }), "low_hz");
  for (const double value : {-1.0, 8001.0, static_cast<double>(kNan)})
    names(refusal([&](auto& o) { o.high_hz = value; }), "high_hz");
  for (const double value : {0.0, 0.09, 10.1, -1.0, static_cast<double>(kNan)})
    names(refusal([&](auto& o) { o.erb_factor = value; }), "erb_factor");
  for (const double value : {0.0, 0.49, 2.01, static_cast<double>(kNan)})
    names(refusal([&](auto& o) { o.warp = value; }), "warp");
  for (const int rate_hz : {0, 999, 384001}) names(refusal(keep, rate_hz), "sample_rate_hz");
  for (const int fft_size : {0, -2, 511}) names(refusal(keep, 16000, fft_size), "fft_size");
}

TEST(FilterBank, RefusesEarsThatDoNotFitBetweenTheEdges) {
  FilterBankOptions options = bank_of(FilterBankKind::hfcc);
  options.erb_factor = 10;
  options.high_hz = 300;
  EXPECT_EQ(
      message_of<InvalidArgument>([&] { filter_triangles(options, 16000); }).rfind("erb_factor", 0),
      0U);
}

}  // namespace
}  // namespace hri
