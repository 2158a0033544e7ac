// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Wavelet packets: details are split as approximations are, so that a level divides the spectrum
// into bands of equal width. Equal to PyWavelets' WaveletPacket.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/dwt.hpp"

namespace hri {

/// The whole tree; T is float or double.
template <class T>
struct WaveletPackets {
  /// levels[l] has a row for each of the 2^l nodes of level l, level 0 is the signal. Rows in
  /// natural order: the binary digits of an index are the way from the top, 0 for the
  /// approximation, 1 for the detail.
  std::vector<Matrix<T>> levels;
};

/// Throws InvalidArgument for an empty signal and for levels outside 1..20.
template <class T>
HRI_API WaveletPackets<T> wavelet_packets(Span<const T> x, const Wavelet& wavelet, Border border,
                                          int num_levels);

/// Rows of a level (0..20) by rising frequency: a detail turns its spectrum round, so that they
/// follow Gray's code.
HRI_API std::vector<std::size_t> frequency_order(int level);

struct PacketNode {
  int level = 0;
  std::size_t index = 0;  ///< in natural order
};

/// The nodes that together describe the signal with the least Shannon entropy of energy (Coifman
/// and Wickerhauser), from low indices to high.
template <class T>
HRI_API std::vector<PacketNode> best_basis(const WaveletPackets<T>& packets);

/// The signal from the rows of `basis` alone. Throws InvalidArgument unless these nodes, in any
/// order, cover the signal exactly once.
template <class T>
HRI_API std::vector<T> reconstruct(const WaveletPackets<T>& packets, Span<const PacketNode> basis,
                                   const Wavelet& wavelet, Border border);

}  // namespace hri
