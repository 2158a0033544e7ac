// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/forward_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/log_steps.hpp"

namespace hri::detail {
namespace {

// A value below kStepDanger is 0 exactly, or the step is taken again in wider arithmetic. One step
// makes no value smaller than kStepDanger * kSmallestStep, which is a normal number, so that
// nothing vanishes unseen.
constexpr double kStepDanger = 1e-260;
constexpr double kSmallestStep = 1e-40;
constexpr double kStepRescale = 1e-50;

// long double of x86 reaches 1e-4932. Steps have at most three factors of 4.9e-324 or more.
constexpr bool kHasExtended = std::numeric_limits<long double>::min_exponent10 < -4900;
constexpr int kExtendedDanger = -12900;  // powers of two
constexpr int kExtendedRescale = -2000;

using Wide = long double;

void propagate_wide(const MarkovChain& chain, const Wide* x, Wide* y) {
  const Topology& topology = chain.topology();
  const int n = topology.num_states;
  std::fill(y, y + n, Wide{0});
  Wide left = 0;
  for (int i = 0; i < n; ++i) {
    const int end = topology.end_next(i);
    const double* row = chain.band().data() + static_cast<std::ptrdiff_t>(i) * n;
    for (int j = topology.first_next(i); j < end; ++j) y[j] += x[i] * Wide{row[j]};
    if (chain.jumps()) left += x[i] * Wide{chain.leave()[i]};
  }
  if (!chain.jumps()) return;
  for (int j = 0; j < n; ++j) y[j] += left * Wide{chain.land()[j]};
}

}  // namespace

ForwardPass::Arithmetic first_arithmetic(double smallest) {
  if (smallest >= kSmallestStep) return ForwardPass::Arithmetic::scaled;
  return kHasExtended ? ForwardPass::Arithmetic::extended : ForwardPass::Arithmetic::logs;
}

void ForwardPass::reset(const MarkovChain& chain, Arithmetic first) {
  num_states_ = chain.num_states();
  arithmetic_ = first;
  started_ = false;
  exponent_ = 0;
  sum_ = 1;
  const auto size = static_cast<std::size_t>(padded(num_states_));
  now_.assign(size, 0.0);
  next_.assign(size, 0.0);
  scratch_.resize(2 * size);
  log_densities_.resize(size);
  // Kept ready, so that no frame allocates.
  wide_now_.resize(size);
  wide_next_.resize(size);
}

template <class Scalar>
void ForwardPass::step(const MarkovChain& chain, const double* b, const Scalar* log_b) {
  if (arithmetic_ == Arithmetic::scaled) {
    if (step_scaled(chain, b)) return;
    widen();
  }
  if (arithmetic_ == Arithmetic::extended) {
    if (step_extended(chain, b)) return;
    take_logs();
  }
  step_logs(chain, log_b);
}

template void ForwardPass::step(const MarkovChain&, const double*, const double*);
template void ForwardPass::step(const MarkovChain&, const double*, const float*);

bool ForwardPass::step_scaled(const MarkovChain& chain, const double* b) {
  Spread spread{};
  if (started_) {
    spread = chain.propagate(now_.data(), b, next_.data());
  } else {
    std::copy_n(chain.start().data(), num_states_, next_.data());
    spread = dense_kernels().emit(b, static_cast<std::ptrdiff_t>(next_.size()), next_.data());
  }
  if (spread.smallest < kStepDanger) return false;
  std::swap(now_, next_);
  sum_ = spread.sum;
  started_ = true;
  if (sum_ < kStepRescale && sum_ > 0) {
    // By a power of two, which rounds nothing.
    const int power = -std::ilogb(sum_);
    const double scale = std::ldexp(1.0, power);
    for (double& value : now_) value *= scale;
    sum_ *= scale;
    exponent_ -= power;
  }
  return true;
}

bool ForwardPass::step_extended(const MarkovChain& chain, const double* b) {
  if (started_) {
    propagate_wide(chain, wide_now_.data(), wide_next_.data());
  } else {
    std::copy_n(chain.start().data(), num_states_, wide_next_.data());
  }
  static const Wide danger = std::ldexp(Wide{1}, kExtendedDanger);
  static const Wide rescale = std::ldexp(Wide{1}, kExtendedRescale);
  Wide sum = 0;
  for (int j = 0; j < num_states_; ++j) {
    Wide& value = wide_next_[static_cast<std::size_t>(j)];
    value *= Wide{b[j]};
    if (value < danger && value > 0) return false;
    sum += value;
  }
  std::swap(wide_now_, wide_next_);
  started_ = true;
  if (sum < rescale && sum > 0) {
    const int power = -std::ilogb(sum);
    for (int j = 0; j < num_states_; ++j) {
      Wide& value = wide_now_[static_cast<std::size_t>(j)];
      value = std::ldexp(value, power);
    }
    exponent_ -= power;
  }
  return true;
}

template <class Scalar>
void ForwardPass::step_logs(const MarkovChain& chain, const Scalar* log_b) {
  if (started_) {
    log_forward_step(chain, now_.data(), scratch_.data(), next_.data());
    std::swap(now_, next_);
  } else {
    std::fill(now_.begin(), now_.end(), kMinusInf);
    std::copy_n(chain.log_start().data(), num_states_, now_.data());
    started_ = true;
  }
  for (int j = 0; j < num_states_; ++j)
    now_[static_cast<std::size_t>(j)] += static_cast<double>(log_b[j]);
}

void ForwardPass::widen() {
  if (kHasExtended) {
    std::copy(now_.begin(), now_.end(), wide_now_.begin());
    arithmetic_ = Arithmetic::extended;
    return;
  }
  const double scale = static_cast<double>(exponent_) * kLog2;
  for (double& value : now_) value = std::log(value) + scale;
  arithmetic_ = Arithmetic::logs;
}

void ForwardPass::take_logs() {
  const double scale = static_cast<double>(exponent_) * kLog2;
  std::fill(now_.begin(), now_.end(), kMinusInf);
  for (int j = 0; j < num_states_; ++j) {
    const auto at = static_cast<std::size_t>(j);
    now_[at] = static_cast<double>(std::log(wide_now_[at])) + scale;
  }
  arithmetic_ = Arithmetic::logs;
}

double ForwardPass::log_likelihood() const {
  if (!started_) return 0;
  const double scale = static_cast<double>(exponent_) * kLog2;
  if (arithmetic_ == Arithmetic::scaled) return std::log(sum_) + scale;
  if (arithmetic_ == Arithmetic::logs)
    return log_sum(0, num_states_, [&](int i) { return now_[static_cast<std::size_t>(i)]; });
  Wide sum = 0;
  for (int j = 0; j < num_states_; ++j) sum += wide_now_[static_cast<std::size_t>(j)];
  return static_cast<double>(std::log(sum)) + scale;
}

}  // namespace hri::detail
