// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/wavelet_packets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using detail::kPi;

std::vector<double> noise_of_length(std::size_t count) {
  Random random(count);
  std::vector<double> x(count);
  for (double& v : x) v = random.normal();
  return x;
}

double entropy(const WaveletPackets<double>& packets, const std::vector<PacketNode>& basis) {
  const double energy = packets.levels[0].squaredNorm();
  double sum = 0;
  for (const PacketNode& node : basis) {
    const auto row = packets.levels[static_cast<std::size_t>(node.level)].row(
        static_cast<Eigen::Index>(node.index));
    for (Eigen::Index i = 0; i < row.size(); ++i) {
      const double share = row[i] * row[i] / energy;
      if (share > 0) sum -= share * std::log(share);
    }
  }
  return sum;
}

// All covers of the tree below a node.
std::vector<std::vector<PacketNode>> covers(PacketNode node, int depth) {
  std::vector<std::vector<PacketNode>> found = {{node}};
  if (node.level == depth) return found;
  for (const auto& left : covers({node.level + 1, 2 * node.index}, depth)) {
    for (const auto& right : covers({node.level + 1, 2 * node.index + 1}, depth)) {
      found.push_back(left);
      found.back().insert(found.back().end(), right.begin(), right.end());
    }
  }
  return found;
}

TEST(WaveletPackets, EveryCoverGivesTheSignalBack) {
  for (const Border border : {Border::symmetric, Border::periodization, Border::antireflect}) {
    for (const std::size_t count : {1U, 13U, 64U, 101U}) {
      const std::vector<double> x = noise_of_length(count);
      const auto packets = wavelet_packets<double>(x, wavelet("db3"), border, 3);
      for (const auto& basis : covers({0, 0}, 3)) {
        const auto back = reconstruct<double>(packets, basis, wavelet("db3"), border);
        ASSERT_EQ(back.size(), count);
        for (std::size_t i = 0; i < count; ++i) ASSERT_NEAR(back[i], x[i], 1e-9);
      }
    }
  }
}

TEST(WaveletPackets, BestBasisIsTheBestOfAllCovers) {
  for (const std::size_t count : {32U, 100U, 256U}) {
    std::vector<double> x = noise_of_length(count);
    for (std::size_t i = 0; i < count; ++i) x[i] += 5 * std::sin(0.9 * static_cast<double>(i));
    const auto packets = wavelet_packets<double>(x, wavelet("db4"), Border::periodization, 3);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& basis : covers({0, 0}, 3)) least = std::min(least, entropy(packets, basis));
    EXPECT_NEAR(entropy(packets, best_basis(packets)), least, 1e-12);
  }
}

TEST(WaveletPackets, OrderOfFrequencyFollowsTones) {
  const auto order = frequency_order(3);
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 3, 2, 6, 7, 5, 4}));
  for (std::size_t band = 0; band < 8; ++band) {
    std::vector<double> x(1024);  // a tone in the middle of the band
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::cos(kPi * (static_cast<double>(band) + 0.5) / 8 * static_cast<double>(i));
    const auto packets = wavelet_packets<double>(x, wavelet("db20"), Border::periodization, 3);
    Eigen::Index loudest = 0;
    packets.levels[3].rowwise().squaredNorm().maxCoeff(&loudest);
    EXPECT_EQ(static_cast<std::size_t>(loudest), order[band]);
  }
}

TEST(WaveletPackets, SilenceNeedsOneNode) {
  const auto packets =
      wavelet_packets<float>(std::vector<float>(20, 0), wavelet("haar"), Border::zero, 2);
  const auto basis = best_basis(packets);
  ASSERT_EQ(basis.size(), 1U);
  EXPECT_EQ(basis[0].level, 0);
}

TEST(WaveletPackets, RefuseWhatIsNoTreeAndNoCover) {
  const Wavelet& w = wavelet("db2");
  const std::vector<double> x = noise_of_length(40);
  EXPECT_THROW(wavelet_packets<double>(std::vector<double>(), w, Border::zero, 1), InvalidArgument);
  EXPECT_THROW(wavelet_packets<double>(x, w, Border::zero, 0), InvalidArgument);
  EXPECT_THROW(wavelet_packets<double>(x, w, Border::zero, 21), InvalidArgument);
  EXPECT_THROW(frequency_order(-1), InvalidArgument);
  EXPECT_THROW(frequency_order(21), InvalidArgument);
  const auto packets = wavelet_packets<double>(x, w, Border::zero, 2);
  const std::vector<std::vector<PacketNode>> wrong = {{},
                                                      {{1, 0}},
                                                      {{1, 0}, {1, 0}},
                                                      {{0, 0}, {1, 0}},
                                                      {{1, 0}, {2, 0}, {2, 1}},
                                                      {{1, 0}, {2, 2}, {2, 4}},
                                                      {{3, 0}},
                                                      {{-1, 0}},
                                                      {{2, 0}, {2, 1}, {2, 2}, {2, 2}}};
  for (const auto& basis : wrong)
    EXPECT_THROW(reconstruct<double>(packets, basis, w, Border::zero), InvalidArgument);
  const std::vector<PacketNode> leaves = {{1, 0}, {1, 1}};
  EXPECT_NO_THROW(reconstruct<double>(packets, leaves, w, Border::zero));
  EXPECT_THROW(reconstruct<double>(packets, leaves, wavelet("db9"), Border::zero), InvalidArgument);
  EXPECT_THROW(reconstruct<double>({}, leaves, w, Border::zero), InvalidArgument);
  EXPECT_THROW(best_basis(WaveletPackets<double>{{MatrixD::Ones(2, 3), MatrixD::Ones(2, 3)}}),
               InvalidArgument);
}

}  // namespace
}  // namespace hri
