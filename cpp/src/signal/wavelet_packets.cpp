// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/wavelet_packets.hpp"

#include <cmath>

#include "hri/core/error.hpp"
#include "signal/dwt_lines.hpp"

namespace hri {
namespace {

constexpr int kMaxPacketLevels = 20;  // a million nodes

template <class T>
void require_tree(const WaveletPackets<T>& packets) {
  require(packets.levels.size() >= 2 && packets.levels.size() <= kMaxPacketLevels + 1,
          "packets must have 1..20 levels below the signal");
  for (std::size_t l = 0; l < packets.levels.size(); ++l) {
    require(packets.levels[l].rows() == Eigen::Index{1} << l && packets.levels[l].cols() > 0,
            "level l of packets must have 2^l rows that are not empty");
  }
}

// What is known of the nodes of one level.
using Costs = std::vector<double>;

template <class T>
Costs entropies(const Matrix<T>& rows, double energy) {
  Costs costs(static_cast<std::size_t>(rows.rows()), 0);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    for (Eigen::Index c = 0; c < rows.cols(); ++c) {
      const auto value = static_cast<double>(rows(r, c));
      const double share = value * value / energy;
      if (share > 0) costs[static_cast<std::size_t>(r)] -= share * std::log(share);
    }
  }
  return costs;
}

// Reads a signal back from the leaves of a cover.
template <class T>
class Cover {
 public:
  Cover(const WaveletPackets<T>& packets, Span<const PacketNode> basis, const Wavelet& wavelet,
        Border border)
      : packets_(packets), filters_(detail::synthesis_filters<T>(wavelet)), border_(border) {
    for (std::size_t l = 0; l < packets.levels.size(); ++l) chosen_.emplace_back(1U << l, false);
    for (std::size_t l = 0; l + 1 < packets.levels.size(); ++l) {
      require(dwt_length(static_cast<std::size_t>(packets.levels[l].cols()), wavelet.rec_lo.size(),
                         border) == static_cast<std::size_t>(packets.levels[l + 1].cols()),
              "packets are not those of this wavelet and border");
    }
    double covered = 0;
    for (const PacketNode& node : basis) {
      require(node.level >= 0 && static_cast<std::size_t>(node.level) < packets.levels.size() &&
                  node.index < std::size_t{1} << static_cast<unsigned>(node.level),
              "basis has a node that the packets do not have");
      chosen_[static_cast<std::size_t>(node.level)][node.index] = true;
      covered += std::ldexp(1, -node.level);
    }
    // With every part of the signal found once more below, this leaves no room for a second time.
    require(covered == 1, "basis must cover the signal exactly once");
  }

  [[nodiscard]] std::vector<T> signal(std::size_t level, std::size_t index) const {
    require(level < chosen_.size(), "basis must cover the signal exactly once");
    const Matrix<T>& rows = packets_.levels[level];
    const auto size = static_cast<std::size_t>(rows.cols());
    if (chosen_[level][index]) {
      const T* row = rows.data() + index * size;
      return std::vector<T>(row, row + size);
    }
    const std::vector<T> approx = signal(level + 1, 2 * index);
    const std::vector<T> detail = signal(level + 1, 2 * index + 1);
    std::vector<T> x(size);
    detail::synthesise_line(approx.data(), detail.data(),
                            static_cast<std::ptrdiff_t>(approx.size()), filters_, border_,
                            static_cast<std::ptrdiff_t>(size), x.data());
    return x;
  }

 private:
  const WaveletPackets<T>& packets_;
  detail::FilterPair<T> filters_;
  Border border_;
  std::vector<std::vector<bool>> chosen_;
};

}  // namespace

template <class T>
WaveletPackets<T> wavelet_packets(Span<const T> x, const Wavelet& wavelet, Border border,
                                  int num_levels) {
  require(!x.empty(), "signal must not be empty");
  require(num_levels >= 1 && num_levels <= kMaxPacketLevels, "num_levels must lie in 1..20");
  const auto filters = detail::analysis_filters<T>(wavelet);
  WaveletPackets<T> packets;
  packets.levels.push_back(
      Eigen::Map<const Matrix<T>>(x.data(), 1, static_cast<Eigen::Index>(x.size())));
  for (int level = 1; level <= num_levels; ++level) {
    const Matrix<T>& above = packets.levels.back();
    const auto count = static_cast<Eigen::Index>(
        dwt_length(static_cast<std::size_t>(above.cols()), wavelet.dec_lo.size(), border));
    Matrix<T> below(2 * above.rows(), count);
    for (Eigen::Index r = 0; r < above.rows(); ++r)
      detail::analyse_line(&above(r, 0), above.cols(), filters, border, count, &below(2 * r, 0),
                           &below(2 * r + 1, 0));
    packets.levels.push_back(std::move(below));
  }
  return packets;
}

std::vector<std::size_t> frequency_order(int level) {
  require(level >= 0 && level <= kMaxPacketLevels, "level must lie in 0..20");
  std::vector<std::size_t> order(std::size_t{1} << static_cast<unsigned>(level));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i ^ (i >> 1U);
  return order;
}

template <class T>
std::vector<PacketNode> best_basis(const WaveletPackets<T>& packets) {
  require_tree(packets);
  const double energy = packets.levels[0].template cast<double>().squaredNorm();
  require(std::isfinite(energy), "signal must be finite");
  const std::size_t depth = packets.levels.size() - 1;
  // From the bottom: a node is kept if what stands below it takes no less.
  std::vector<std::vector<bool>> kept(depth + 1);
  Costs below;
  for (std::size_t l = depth + 1; l-- > 0;) {
    Costs own = entropies(packets.levels[l], energy > 0 ? energy : 1);
    kept[l].assign(own.size(), true);
    for (std::size_t i = 0; l < depth && i < own.size(); ++i) {
      const double split = below[2 * i] + below[2 * i + 1];
      kept[l][i] = own[i] <= split;
      if (!kept[l][i]) own[i] = split;
    }
    below = std::move(own);
  }
  std::vector<PacketNode> basis;
  std::vector<PacketNode> open = {{0, 0}};
  while (!open.empty()) {
    const PacketNode node = open.back();
    open.pop_back();
    if (kept[static_cast<std::size_t>(node.level)][node.index]) {
      basis.push_back(node);
    } else {
      open.push_back({node.level + 1, 2 * node.index + 1});
      open.push_back({node.level + 1, 2 * node.index});
    }
  }
  return basis;
}

template <class T>
std::vector<T> reconstruct(const WaveletPackets<T>& packets, Span<const PacketNode> basis,
                           const Wavelet& wavelet, Border border) {
  require_tree(packets);
  return Cover<T>(packets, basis, wavelet, border).signal(0, 0);
}

#define HRI_INSTANTIATE_PACKETS(T)                                                           \
  template WaveletPackets<T> wavelet_packets<T>(Span<const T>, const Wavelet&, Border, int); \
  template std::vector<PacketNode> best_basis<T>(const WaveletPackets<T>&);                  \
  template std::vector<T> reconstruct<T>(const WaveletPackets<T>&, Span<const PacketNode>,   \
                                         const Wavelet&, Border);
HRI_INSTANTIATE_PACKETS(float)
HRI_INSTANTIATE_PACKETS(double)
#undef HRI_INSTANTIATE_PACKETS

}  // namespace hri
