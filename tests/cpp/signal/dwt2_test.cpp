// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/dwt2.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr Border kBorders[] = {Border::symmetric, Border::zero,          Border::constant,
                               Border::periodic,  Border::reflect,       Border::periodization,
                               Border::smooth,    Border::antisymmetric, Border::antireflect};

MatrixD noise(Eigen::Index rows, Eigen::Index cols) {
  Random random(static_cast<std::uint64_t>(100 * rows + cols));
  MatrixD image(rows, cols);
  for (Eigen::Index i = 0; i < image.size(); ++i) image.data()[i] = random.normal();
  return image;
}

template <class T>
double round_trip_error(const MatrixD& image, const Wavelet& w, Border border) {
  const Matrix<T> pixels = image.cast<T>();
  const Matrix<T> back =
      idwt2<T>(dwt2<T>(pixels, w, border), w, border, pixels.rows(), pixels.cols());
  return static_cast<double>((back - pixels).cwiseAbs().maxCoeff());
}

TEST(Dwt2, IsUndoneForEveryWaveletBorderAndParity) {
  for (const std::string& name : wavelet_names()) {
    const Wavelet& w = wavelet(name);
    // dmey is orthonormal to 1e-3 only.
    for (const Border border : kBorders) {
      // Straight lines climb far above the picture under long filters.
      const double climb = border == Border::smooth ? 4 : 1;
      const double tolerance_d = climb * (name == "dmey" ? 5e-2 : 1e-9);
      const double tolerance_f = climb * (name == "dmey" ? 5e-2 : 2e-5);
      for (const auto& [rows, cols] : {std::pair{1, 1}, {6, 6}, {7, 12}, {12, 7}, {9, 9}}) {
        const MatrixD image = noise(rows, cols);
        EXPECT_LT(round_trip_error<double>(image, w, border), tolerance_d)
            << name << " border " << static_cast<int>(border) << " " << rows << " x " << cols;
        EXPECT_LT(round_trip_error<float>(image, w, border), tolerance_f)
            << name << " border " << static_cast<int>(border) << " " << rows << " x " << cols;
      }
    }
  }
}

TEST(Dwt2, KeepsEnergyWhereTheImageWrapsAround) {
  const MatrixD image = noise(16, 24);
  for (const std::string& name : wavelet_names()) {
    if (name.find("bio") != std::string::npos) continue;  // not orthogonal
    const Dwt2<double> d = dwt2<double>(image, wavelet(name), Border::periodization);
    ASSERT_EQ(d.approx.rows(), 8);
    ASSERT_EQ(d.approx.cols(), 12);
    const double energy = d.approx.squaredNorm() + d.horizontal.squaredNorm() +
                          d.vertical.squaredNorm() + d.diagonal.squaredNorm();
    EXPECT_NEAR(energy / image.squaredNorm(), 1, name == "dmey" ? 1e-2 : 1e-10) << name;
  }
}

// As PyWavelets and the thesis name them: horizontal details answer to horizontal edges.
TEST(Dwt2, DetailsAnswerToTheirOwnEdges) {
  MatrixD stripes(8, 8);
  for (Eigen::Index r = 0; r < 8; ++r) stripes.row(r).setConstant(r % 2 == 0 ? 1 : -1);
  const Wavelet& haar = wavelet("haar");
  const Dwt2<double> lying = dwt2<double>(stripes, haar, Border::symmetric);
  EXPECT_NEAR(lying.horizontal.cwiseAbs().minCoeff(), 2, 1e-12);
  EXPECT_NEAR(lying.vertical.cwiseAbs().maxCoeff(), 0, 1e-12);
  EXPECT_NEAR(lying.diagonal.cwiseAbs().maxCoeff(), 0, 1e-12);
  EXPECT_NEAR(lying.approx.cwiseAbs().maxCoeff(), 0, 1e-12);
  const Dwt2<double> standing = dwt2<double>(MatrixD(stripes.transpose()), haar, Border::symmetric);
  EXPECT_NEAR(standing.vertical.cwiseAbs().minCoeff(), 2, 1e-12);
  EXPECT_NEAR(standing.horizontal.cwiseAbs().maxCoeff(), 0, 1e-12);
  const Dwt2<double> flat = dwt2<double>(MatrixD::Constant(8, 8, 3), haar, Border::symmetric);
  EXPECT_NEAR((flat.approx.array() - 6).abs().maxCoeff(), 0, 1e-12);
}

TEST(Dwt2, RefusesShapesThatDoNotFit) {
  const Wavelet& w = wavelet("db2");
  EXPECT_THROW(dwt2<double>(MatrixD(0, 4), w, Border::zero), InvalidArgument);
  EXPECT_THROW(dwt2<double>(MatrixD(4, 0), w, Border::zero), InvalidArgument);
  const Dwt2<double> whole = dwt2<double>(noise(12, 10), w, Border::zero);
  for (const auto& [rows, cols] : {std::pair{14, 10}, {12, 12}, {0, 10}, {12, -1}, {10, 12}})
    EXPECT_THROW(idwt2<double>(whole, w, Border::zero, rows, cols), InvalidArgument)
        << rows << " x " << cols;
  MatrixD Dwt2<double>::*const parts[] = {&Dwt2<double>::approx, &Dwt2<double>::horizontal,
                                          &Dwt2<double>::vertical, &Dwt2<double>::diagonal};
  for (const auto part : parts) {
    Dwt2<double> broken = whole;
    (broken.*part).resize(whole.approx.rows() - 1, whole.approx.cols());
    EXPECT_THROW(idwt2<double>(broken, w, Border::zero, 12, 10), InvalidArgument);
    (broken.*part).resize(whole.approx.rows(), whole.approx.cols() - 1);
    EXPECT_THROW(idwt2<double>(broken, w, Border::zero, 12, 10), InvalidArgument);
  }
}

TEST(Dwt2, OnePixelThatIsNotANumberSpoilsItsSurroundingsOnly) {
  MatrixD image = noise(32, 32);
  image(5, 5) = std::numeric_limits<double>::quiet_NaN();
  const Dwt2<double> d = dwt2<double>(image, wavelet("db2"), Border::symmetric);
  int spoilt = 0;
  for (Eigen::Index i = 0; i < d.approx.size(); ++i)
    spoilt += std::isnan(d.approx.data()[i]) ? 1 : 0;
  EXPECT_EQ(spoilt, 4);  // two of every row and column with four taps
}

}  // namespace
}  // namespace hri
