// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/lbfgs.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace hri::detail {
namespace {

constexpr std::size_t kMemory = 10;
constexpr double kSufficientDecrease = 1e-4;
constexpr int kMaxHalvings = 30;

struct Correction {
  VectorD step;
  VectorD change;  // of the gradient
  double inverse;  // of their product
};

// Minus the gradient times the inverse Hessian that the corrections imply.
VectorD direction_of(const std::deque<Correction>& corrections, const VectorD& gradient) {
  VectorD q = -gradient;
  std::vector<double> alphas(corrections.size());
  for (std::size_t i = corrections.size(); i-- > 0;) {
    alphas[i] = corrections[i].inverse * corrections[i].step.dot(q);
    q -= alphas[i] * corrections[i].change;
  }
  if (!corrections.empty()) {
    const Correction& last = corrections.back();
    q /= last.inverse * last.change.squaredNorm();
  }
  for (std::size_t i = 0; i < corrections.size(); ++i) {
    const double beta = corrections[i].inverse * corrections[i].change.dot(q);
    q += (alphas[i] - beta) * corrections[i].step;
  }
  return q;
}

}  // namespace

VectorD minimise(const SmoothFunction& function, VectorD x, int max_iterations, double tolerance,
                 const StopCheck& should_stop) {
  VectorD gradient(x.size());
  double value = function(x, &gradient);
  std::deque<Correction> corrections;
  for (int i = 0; i < max_iterations; ++i) {
    poll(should_stop);
    const VectorD direction = direction_of(corrections, gradient);
    const double slope = direction.dot(gradient);
    if (!(slope < 0)) break;
    // Nothing is known of the scale at first: a step as long as 1 at most.
    double length = corrections.empty() ? std::min(1.0, 1.0 / direction.norm()) : 1.0;
    VectorD next(x.size());
    VectorD next_gradient(x.size());
    double next_value = value;
    bool found = false;
    for (int halved = 0; halved < kMaxHalvings && !found; ++halved, length *= 0.5) {
      next = x + length * direction;
      next_value = function(next, &next_gradient);
      found = next_value <= value + kSufficientDecrease * length * slope;
    }
    if (!found) break;
    Correction correction{next - x, next_gradient - gradient, 0};
    const double product = correction.step.dot(correction.change);
    if (product > 0) {
      correction.inverse = 1.0 / product;
      corrections.push_back(std::move(correction));
      if (corrections.size() > kMemory) corrections.pop_front();
    }
    const double gain = value - next_value;
    x = std::move(next);
    gradient = std::move(next_gradient);
    value = next_value;
    if (gain <= tolerance * std::abs(value)) break;
  }
  return x;
}

}  // namespace hri::detail
