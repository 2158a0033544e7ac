// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What stands beyond the ends of a signal, as a weighted sum of at most three of its samples: the
// same rule serves samples of a signal and rows of a picture.
#pragma once

#include <algorithm>
#include <cstddef>

#include "hri/signal/dwt.hpp"

namespace hri::detail {

/// The sum of weight[i] x[from[i]]; weights that are 0 do not count, not even beside a NaN.
struct ExtendedSample {
  std::ptrdiff_t from[3] = {0, 0, 0};
  double weight[3] = {0, 0, 0};
};

inline ExtendedSample just(std::ptrdiff_t from, double weight = 1) {
  return {{from, 0, 0}, {weight, 0, 0}};
}

inline std::ptrdiff_t modulo(std::ptrdiff_t i, std::ptrdiff_t period) {
  const std::ptrdiff_t m = i % period;
  return m < 0 ? m + period : m;
}

/// The value at position i of a signal of n samples; i may lie anywhere.
inline ExtendedSample extended_sample(std::ptrdiff_t i, std::ptrdiff_t n, Border border) {
  if (i >= 0 && i < n) return just(i);
  const std::ptrdiff_t last = n - 1;
  switch (border) {
    case Border::zero:
      return {};
    case Border::constant:
      return just(i < 0 ? 0 : last);
    case Border::symmetric: {
      const std::ptrdiff_t m = modulo(i, 2 * n);
      return just(std::min(m, 2 * n - 1 - m));
    }
    case Border::antisymmetric: {
      const std::ptrdiff_t m = modulo(i, 2 * n);
      return m < n ? just(m) : just(2 * n - 1 - m, -1);
    }
    case Border::reflect: {
      if (n == 1) return just(0);
      const std::ptrdiff_t m = modulo(i, 2 * last);
      return just(std::min(m, 2 * last - m));
    }
    case Border::antireflect: {
      if (n == 1) return just(0);
      // Twice over the signal it has climbed by twice what lies between its ends.
      const std::ptrdiff_t m = modulo(i, 2 * last);
      const std::ptrdiff_t turns = (i - m) / (2 * last);
      const auto climbs = static_cast<double>(turns);
      if (m < n) return {{m, last, 0}, {1, 2 * climbs, -2 * climbs}};
      return {{2 * last - m, last, 0}, {-1, 2 + 2 * climbs, -2 * climbs}};
    }
    case Border::smooth: {
      if (n == 1) return just(0);
      const auto steps = static_cast<double>(i < 0 ? -i : i - last);
      return {{i < 0 ? 0 : last, i < 0 ? 1 : last - 1, 0}, {1 + steps, -steps, 0}};
    }
    case Border::periodic:
      return just(modulo(i, n));
    case Border::periodization:
      // A signal of odd length repeats its last sample once to become even.
      return just(std::min(modulo(i, n + n % 2), last));
  }
  return {};
}

/// out[i] = the value at position first + i.
template <class T>
void extend(const T* x, std::ptrdiff_t n, Border border, std::ptrdiff_t first, std::ptrdiff_t count,
            T* out) {
  std::ptrdiff_t i = 0;
  const auto beyond = [&](std::ptrdiff_t end) {
    for (; i < end; ++i) {
      const ExtendedSample s = extended_sample(first + i, n, border);
      double sum = 0;
      for (int j = 0; j < 3; ++j)
        if (s.weight[j] != 0) sum += s.weight[j] * static_cast<double>(x[s.from[j]]);
      out[i] = static_cast<T>(sum);
    }
  };
  beyond(std::clamp<std::ptrdiff_t>(-first, 0, count));
  const std::ptrdiff_t inside = std::clamp<std::ptrdiff_t>(n - first, i, count);
  if (inside > i) std::copy(x + first + i, x + first + inside, out + i);
  i = inside;
  beyond(count);
}

/// The first position that output 0 of the analysis reads; output k reads from 2 k places on.
inline std::ptrdiff_t first_read(std::ptrdiff_t num_taps, Border border) {
  return (border == Border::periodization ? num_taps / 2 : 1) - num_taps + 1;
}

/// Which samples the synthesis gives: pair p is x[2 p - late], x[2 p + 1 - late], from the
/// coefficients p + offset, p + offset + 1, ...; periodization may begin within a pair.
struct PairPlaces {
  std::ptrdiff_t late = 0;
  std::ptrdiff_t offset = 0;
};
inline PairPlaces pair_places(std::ptrdiff_t num_taps, Border border) {
  if (border != Border::periodization) return {};
  const std::ptrdiff_t shift = num_taps / 2 - 1;
  return {shift % 2, shift / 2 - shift};
}

}  // namespace hri::detail
