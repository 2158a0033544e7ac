// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Constants and small functions of many sources.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hri::detail {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kLog2Pi = 1.8378770664093454835606594728112;
inline constexpr double kMinusInf = -std::numeric_limits<double>::infinity();
inline constexpr double kDecibelsPerNeper = 4.342944819032518;  // of power: 10 / ln 10

constexpr double squared(double v) { return v * v; }

/// log(1 + exp(x)), which never overflows.
inline double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

/// An index that is known to be no less than 0.
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace hri::detail
