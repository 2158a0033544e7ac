// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/mixture_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hri/core/error.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/mixture_training.hpp"
#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

// Plain loops over one Gaussian, in the order the header promises.
template <class T>
T distance(const T* x, const T* mean, const T* precision, int dim, std::ptrdiff_t stride) {
  constexpr int kParts = 64 / sizeof(T);
  const auto term = [&](int d) {
    const T difference = x[d] - mean[d * stride];
    const volatile T square = difference * difference;  // nothing fused
    const volatile T weighted = square * precision[d * stride];
    return static_cast<T>(weighted);
  };
  T parts[kParts] = {};
  const int whole = dim / kParts * kParts;
  for (int d = 0; d < whole; ++d) parts[d % kParts] += term(d);
  T sum = 0;
  for (int d = whole; d < dim; ++d) sum += term(d);
  for (int half = kParts / 2; half > 0; half /= 2) {
    for (int l = 0; l < half; ++l) parts[l] += parts[l + half];
  }
  return sum + parts[0];
}

template <class T, class Kernel>
void expect_plain_sums(const Kernel& kernel_of) {
  for (const MixtureKernels* kernels : all_mixture_kernels()) {
    for (const int dim : {1, 7, 8, 15, 16, 17, 39, 48, 65}) {
      for (const int rows : {1, 8, 9, 16, 17, 31, 40}) {
        const std::ptrdiff_t stride = padded(rows);
        const Matrix<T> means = noise(dim, stride, 1).template cast<T>();
        const Matrix<T> precisions = noise(dim, stride, 2).array().exp().template cast<T>();
        const Matrix<T> x = noise(1, dim, 3).template cast<T>();
        // Guards beyond the last value show a store too many.
        std::vector<T> found(static_cast<std::size_t>(stride) + 8, T{-7});
        std::vector<T> expected = found;
        for (std::ptrdiff_t r = 0; r < stride; ++r) {
          expected[static_cast<std::size_t>(r)] =
              distance(x.data(), means.data() + r, precisions.data() + r, dim, stride);
        }
        kernel_of (*kernels)(x.data(), {means.data(), precisions.data(), stride, dim},
                             found.data());
        EXPECT_EQ(found, expected) << dim << " columns, " << rows << " Gaussians";
      }
    }
  }
}

TEST(MixtureKernels, GiveTheSameBitsAsPlainLoopsOnEveryInstructionSet) {
  expect_plain_sums<float>([](const MixtureKernels& k) { return k.distances_f; });
  expect_plain_sums<double>([](const MixtureKernels& k) { return k.distances; });
}

TEST(MixtureKernels, LogSumsAreThoseOfDoublesOnEveryInstructionSet) {
  constexpr float kNone = -std::numeric_limits<float>::infinity();
  for (const int k : {1, 2, 3, 4, 9}) {
    for (const int num_states : {1, 7, 8, 30}) {
      const auto count = static_cast<std::size_t>(num_states) * static_cast<std::size_t>(k);
      const MatrixF drawn = noise(1, static_cast<Eigen::Index>(count), 5) * 30.0F;
      std::vector<float> components(drawn.data(), drawn.data() + count);
      if (num_states > 1) std::fill_n(components.begin(), k, kNone);
      if (k > 1) components.back() = kNone;
      if (k > 2) components[count - 2] = components[count - 3];
      std::vector<float> first;
      for (const MixtureKernels* kernels : all_mixture_kernels()) {
        std::vector<float> work(components);
        work.resize(static_cast<std::size_t>(padded(static_cast<std::ptrdiff_t>(count))), 7.0F);
        std::vector<float> scratch(work.size());
        std::vector<float> found(static_cast<std::size_t>(num_states) + 1, -7.0F);
        kernels->log_sums(work.data(), num_states, k, scratch.data(), found.data());
        EXPECT_EQ(found.back(), -7.0F);
        if (first.empty()) first = found;
        EXPECT_EQ(found, first);
        for (int j = 0; j < num_states; ++j) {
          const float* own = components.data() + static_cast<std::ptrdiff_t>(j) * k;
          const auto top = static_cast<double>(*std::max_element(own, own + k));
          double sum = 0;
          for (int c = 0; c < k; ++c) sum += std::exp(static_cast<double>(own[c]) - top);
          const float value = found[static_cast<std::size_t>(j)];
          if (top == static_cast<double>(kNone)) {
            EXPECT_EQ(value, kNone);
          } else {
            const double expected = top + std::log(sum);
            EXPECT_NEAR(value, expected, 2e-7 * (1 + std::abs(expected))) << j << " of " << k;
          }
        }
      }
    }
  }
}

int nearest_by_eigen(const MatrixD& centres, const Eigen::RowVectorXd& row) {
  Eigen::Index best = 0;
  (centres.rowwise() - row).rowwise().squaredNorm().minCoeff(&best);
  return static_cast<int>(best);
}

TEST(NearestCentre, FindsWhatEigenFinds) {
  for (const int dim : {1, 2, 5, 39}) {
    const MatrixD centres = noise(16, dim, 4).cast<double>();
    NearestCentre search(centres);
    const MatrixD rows = noise(300, dim, 5).cast<double>();
    for (Eigen::Index r = 0; r < rows.rows(); ++r)
      EXPECT_EQ(search.find(rows.data() + r * dim), nearest_by_eigen(centres, rows.row(r)));
  }
}

// Centres that are equal, and rows midway between two, where rounding decides.
TEST(NearestCentre, AgreesOnTies) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MatrixD centres = noise(2, 39, seed).cast<double>() / 3;  // so that the middle is rounded
    const Eigen::RowVectorXd middle = 0.5 * (centres.row(0) + centres.row(1));
    EXPECT_EQ(NearestCentre(centres).find(middle.data()), nearest_by_eigen(centres, middle));
    centres.row(1) = centres.row(0);
    EXPECT_EQ(NearestCentre(centres).find(middle.data()), 0);
  }
  const MatrixD centres = noise(6, 7, 6).cast<double>();
  NearestCentre search(centres);
  const Eigen::RowVectorXd far = Eigen::RowVectorXd::Constant(7, 1e200);  // infinitely far from all
  EXPECT_EQ(search.find(far.data()), nearest_by_eigen(centres, far));
}

TEST(MixtureBank, RefusesFramesOfAnotherWidth) {
  const MixtureBank bank(MatrixD::Ones(1, 1), MatrixD::Zero(1, 8), MatrixD::Ones(1, 8));
  MixtureAccumulator accumulator(1, 1, 8);
  for (const int width : {3, 7, 9, 12}) {
    const MatrixF frames = MatrixF::Zero(2, width);
    MatrixF floats(2, 1);
    MatrixD doubles(2, 1);
    EXPECT_THROW(bank.log_densities(frames, floats), InvalidArgument) << width;
    EXPECT_THROW(bank.log_densities(frames, &doubles, nullptr), InvalidArgument) << width;
    EXPECT_THROW(bank.log_densities(frames, doubles.data()), InvalidArgument) << width;
    EXPECT_THROW(accumulator.add(frames, MatrixD::Ones(2, 1), MatrixD()), InvalidArgument) << width;
  }
  const MatrixF frames = MatrixF::Zero(2, 8);
  EXPECT_THROW(accumulator.add(frames, MatrixD::Ones(1, 1), MatrixD()), InvalidArgument);
  EXPECT_THROW(accumulator.add(frames, MatrixD::Ones(2, 2), MatrixD()), InvalidArgument);
  MixtureAccumulator mixed(1, 2, 8);
  EXPECT_THROW(mixed.add(frames, MatrixD::Ones(2, 1), MatrixD::Ones(2, 1)), InvalidArgument);
}

// One component and frame after the other.
TEST(MixtureAccumulator, GivesTheBitsOfPlainSums) {
  for (const int num_mixtures : {1, 3}) {
    constexpr int kStates = 5;
    constexpr int kDim = 6;
    MixtureAccumulator accumulator(kStates, num_mixtures, kDim);
    const int num_rows = kStates * num_mixtures;
    VectorD counts = VectorD::Zero(num_rows);
    MatrixD sums = MatrixD::Zero(num_rows, kDim);
    MatrixD squares = MatrixD::Zero(num_rows, kDim);
    for (const int length : {1, 3, 64, 65, 200}) {
      const MatrixF frames = noise(length, kDim, 7);
      const MatrixD shares = noise(length, num_rows, 8).cast<double>().cwiseAbs();
      MatrixD gamma = noise(length, kStates, 10).cast<double>().cwiseMax(0.0);
      gamma.col(2).setConstant(1e-13);  // too little to count
      accumulator.add(frames, gamma, shares);
      for (int t = 0; t < length; ++t) {
        const Eigen::RowVectorXd x = frames.row(t).cast<double>();
        for (int r = 0; r < num_rows; ++r) {
          const int j = r / num_mixtures;
          if (!(gamma(t, j) > 1e-12)) continue;
          const double w = gamma(t, j) * (num_mixtures == 1 ? 1.0 : shares(t, r));
          counts[r] += w;
          sums.row(r) += w * x;
          squares.row(r) += w * x.cwiseAbs2();
        }
      }
    }
    EXPECT_EQ(accumulator.counts(), counts);
    EXPECT_EQ(accumulator.sums(), sums);
    EXPECT_EQ(accumulator.squares(), squares);
    EXPECT_EQ(counts[2 * num_mixtures], 0);
  }
}

}  // namespace
}  // namespace hri::detail
