// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/linear_prediction.hpp"

#include <algorithm>
#include <cmath>

#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

HRI_SIMD_CLONES
double product_sum(const double* a, const double* b, std::ptrdiff_t count) {
  constexpr int kLanes = 16;  // partial sums, so that none waits for the one before
  double lanes[kLanes] = {};
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int l = 0; l < kLanes; ++l) lanes[l] += a[i + l] * b[i + l];
  }
  double sum = 0;
  for (; i < count; ++i) sum += a[i] * b[i];
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace

void autocorrelation(Span<const double> x, Span<double> r) {
  const auto count = static_cast<std::ptrdiff_t>(x.size());
  for (std::size_t k = 0; k < r.size(); ++k) {
    const auto lag = static_cast<std::ptrdiff_t>(k);
    r[k] = lag < count ? product_sum(x.data(), x.data() + lag, count - lag) : 0;
  }
}

double levinson_durbin(Span<const double> r, Span<double> a) {
  require(r.size() == a.size() + 1, "r must have one value more than a");
  double error = r[0];
  std::fill(a.begin(), a.end(), 0.0);
  for (std::size_t i = 0; i < a.size() && error > 0; ++i) {
    double sum = r[i + 1];
    for (std::size_t j = 0; j < i; ++j) sum += a[j] * r[i - j];
    const double reflection = -sum / error;
    a[i] = reflection;
    for (std::size_t j = 0; 2 * j < i; ++j) {
      const double front = a[j];
      const double back = a[i - 1 - j];
      a[j] = front + reflection * back;
      if (j != i - 1 - j) a[i - 1 - j] = back + reflection * front;
    }
    error *= 1 - reflection * reflection;
  }
  return std::max(error, 0.0);
}

void lpc_cepstrum(Span<const double> a, double gain, Span<double> c) {
  require(gain > 0, "gain must be greater than 0");
  if (c.empty()) return;
  c[0] = std::log(gain);
  for (std::size_t n = 1; n < c.size(); ++n) {
    double sum = n <= a.size() ? a[n - 1] : 0;
    for (std::size_t k = n > a.size() ? n - a.size() : 1; k < n; ++k)
      sum += static_cast<double>(k) / static_cast<double>(n) * c[k] * a[n - k - 1];
    c[n] = -sum;
  }
}

}  // namespace hri
