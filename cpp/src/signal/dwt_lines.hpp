// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// One level of one line, without the checks: what the transforms of signals, pictures and packets
// share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hri/signal/dwt.hpp"
#include "signal/filter_pair.hpp"

namespace hri::detail {

/// Values from `place` to the next cache line.
template <class T>
std::ptrdiff_t to_cache_line(const T* place) {
  constexpr std::uintptr_t kLine = 64;
  const auto over = reinterpret_cast<std::uintptr_t>(place) % kLine;
  return static_cast<std::ptrdiff_t>((kLine - over) % kLine / sizeof(T));
}

/// n >= 1 samples to count = dwt_length(n) coefficients of each band.
template <class T>
void analyse_line(const T* x, std::ptrdiff_t n, const FilterPair<T>& filters, Border border,
                  std::ptrdiff_t count, T* approx, T* detail);

/// count >= 1 coefficients to the first `size` <= idwt_length(count) samples.
template <class T>
void synthesise_line(const T* approx, const T* detail, std::ptrdiff_t count,
                     const FilterPair<T>& filters, Border border, std::ptrdiff_t size, T* x);

/// The same from the samples that the outputs read, borders included: 2 count + taps - 2 of them.
template <class T>
void analyse_extended(const T* samples, const FilterPair<T>& filters, std::ptrdiff_t count,
                      T* approx, T* detail);

}  // namespace hri::detail
