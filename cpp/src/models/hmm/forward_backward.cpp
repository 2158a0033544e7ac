// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/forward_backward.hpp"

#include <algorithm>
#include <cmath>

#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/log_steps.hpp"

namespace hri::detail {
namespace {

// Of scaled probabilities: see forward_pass.cpp. What vanishes beside kSafeTotal is 1e-100 of it or
// less.
constexpr double kDanger = 1e-260;
constexpr double kRescale = 1e-50;
constexpr double kSafeTotal = 1e-200;
constexpr int kBlock = 64;

// The sum over frames of x_t(i) y_t(j), for the pairs i, j that the chain has: times a_ij it is the
// expected number of transitions.
class TransitionSums {
 public:
  explicit TransitionSums(const MarkovChain& chain)
      : chain_(chain),
        dense_(chain.topology().kind == Topology::Kind::ergodic),
        x_(kBlock, chain.num_states(), 0),
        y_(kBlock, chain.num_states(), 0),
        pairs_(chain.num_states(), dense_ ? chain.num_states() : band_width(chain.topology()), 0),
        leave_(VectorD::Zero(chain.num_states())),
        land_(VectorD::Zero(chain.num_states())) {}

  /// Where the rows of the next step go, padded; add() then counts them.
  double* x() { return x_.row(held_); }
  double* y() { return y_.row(held_); }

  void add() {
    if (++held_ == kBlock) flush();
  }

  void finish(ChainCounts* counts) {
    flush();
    const int n = chain_.num_states();
    for (int i = 0; i < n; ++i) {
      const int first = chain_.topology().first_next(i);
      const int end = chain_.topology().end_next(i);
      for (int j = first; j < end; ++j)
        counts->band(i, j) += chain_.band()(i, j) * pairs_.row(i)[j - first];
    }
    if (!chain_.jumps()) return;
    counts->leave += leave_;
    counts->land += land_;
  }

 private:
  static int band_width(const Topology& topology) {
    int width = 0;
    for (int i = 0; i < topology.num_states; ++i)
      width = std::max(width, topology.end_next(i) - topology.first_next(i));
    return width;
  }

  void flush() {
    const int n = chain_.num_states();
    if (dense_) {
      dense_kernels().add_products(x_.row(0), x_.stride(), y_.row(0), y_.stride(), held_, n,
                                   pairs_.stride(), pairs_.row(0));
    } else {
      for (int r = 0; r < held_; ++r) add_steps(x_.row(r), y_.row(r));
    }
    held_ = 0;
  }

  void add_steps(const double* x, const double* y) {
    const int n = chain_.num_states();
    double left = 0;
    double landed = 0;
    for (int i = 0; i < n; ++i) {
      const int end = chain_.topology().end_next(i);
      const int first = chain_.topology().first_next(i);
      double* row = pairs_.row(i);
      for (int j = first; j < end; ++j) row[j - first] += x[i] * y[j];
      if (!chain_.jumps()) continue;
      left += x[i] * chain_.leave()[i];
      landed += chain_.land()[i] * y[i];
    }
    if (!chain_.jumps()) return;
    for (int i = 0; i < n; ++i) {
      leave_[i] += x[i] * chain_.leave()[i] * landed;
      land_[i] += left * chain_.land()[i] * y[i];
    }
  }

  const MarkovChain& chain_;
  bool dense_;
  int held_ = 0;
  PaddedMatrix x_;
  PaddedMatrix y_;
  PaddedMatrix pairs_;  // row i begins with the first state that i leads to
  VectorD leave_;
  VectorD land_;
};

// Expected transitions of one step in logs, without jumps: alpha(i) a_ij after(j) / total.
void count_steps_in_logs(const MarkovChain& chain, const double* alpha, const double* after,
                         double total, ChainCounts* counts) {
  for (int i = 0; i < chain.num_states(); ++i) {
    if (alpha[i] == kMinusInf) continue;
    const int end = chain.topology().end_next(i);
    for (int j = chain.topology().first_next(i); j < end; ++j) {
      const double a = chain.band()(i, j);
      const double exponent = alpha[i] + after[j] - total;
      if (a > 0 && exponent > -700) counts->band(i, j) += a * std::exp(exponent);
    }
  }
}

void count_jumps_in_logs(const MarkovChain& chain, const double* alpha, const double* after,
                         double total, ChainCounts* counts) {
  const int n = chain.num_states();
  const auto log_of = [](double p) { return p > 0 ? std::log(p) : kMinusInf; };
  const double left = log_sum(0, n, [&](int i) { return alpha[i] + log_of(chain.leave()[i]); });
  const double landed = log_sum(0, n, [&](int j) { return log_of(chain.land()[j]) + after[j]; });
  if (left == kMinusInf || landed == kMinusInf) return;
  for (int i = 0; i < n; ++i) {
    counts->leave[i] += chain.leave()[i] * std::exp(alpha[i] + landed - total);
    counts->land[i] += chain.land()[i] * std::exp(left + after[i] - total);
  }
}

// Forward in logs: log P(frames 0..t, state) into row t of `alpha`, whose padding holds -inf, as it
// does in all vectors below; `scratch` holds twice as many values as a row. Gives log P(frames).
double log_forward(const MarkovChain& chain, const Rows<double>& log_b, double* scratch,
                   PaddedMatrix* alpha) {
  const int n = chain.num_states();
  for (std::ptrdiff_t t = 0; t < log_b.num_frames; ++t) {
    double* now = alpha->row(t);
    if (t == 0) {
      std::copy_n(chain.log_start().data(), n, now);
    } else {
      log_forward_step(chain, alpha->row(t - 1), scratch, now);
    }
    const double* row = log_b[t];
    for (int j = 0; j < n; ++j) now[j] += row[j];
  }
  const double* last = alpha->row(log_b.num_frames - 1);
  return log_sum(0, n, [&](int i) { return last[i]; });
}

// One step of the way back: `beta` from what it is at the next frame, whose log emissions are
// `row`, to what it is at this one. `after` becomes log P(frames from the next on | its state).
void log_step_back(const MarkovChain& chain, const double* row, double* scratch, double* after,
                   double* beta) {
  for (int j = 0; j < chain.num_states(); ++j) after[j] = row[j] + beta[j];
  log_backward_step(chain, after, scratch, beta);
}

}  // namespace

ForwardBackward both_ways(const MarkovChain& chain, const Rows<double>& log_b) {
  const int n = chain.num_states();
  const std::ptrdiff_t num_frames = log_b.num_frames;
  PaddedMatrix alpha(num_frames, n, kMinusInf);
  PaddedMatrix way_back(2, n, kMinusInf);
  AlignedVector scratch(static_cast<std::size_t>(2 * alpha.stride()));
  ForwardBackward result;
  result.log_likelihood = log_forward(chain, log_b, scratch.data(), &alpha);
  result.log_forward.resize(num_frames, n);
  result.log_backward.resize(num_frames, n);
  double* beta = way_back.row(0);
  std::fill(beta, beta + n, 0.0);
  for (std::ptrdiff_t t = num_frames - 1; t >= 0; --t) {
    if (t + 1 < num_frames)
      log_step_back(chain, log_b[t + 1], scratch.data(), way_back.row(1), beta);
    std::copy_n(alpha.row(t), n, result.log_forward.data() + t * n);
    std::copy_n(beta, n, result.log_backward.data() + t * n);
  }
  return result;
}

double forward_backward(const MarkovChain& chain, const Rows<double>& log_b, double* gamma,
                        std::ptrdiff_t stride, ChainCounts* counts) {
  const int n = chain.num_states();
  const std::ptrdiff_t num_frames = log_b.num_frames;
  const DenseKernels& kernels = dense_kernels();
  PaddedMatrix alpha(num_frames, n, kMinusInf);
  const std::ptrdiff_t count = alpha.stride();
  AlignedVector scratch(static_cast<std::size_t>(2 * count));
  const double total = log_forward(chain, log_b, scratch.data(), &alpha);
  std::fill(gamma, gamma + num_frames * stride, 0.0);
  if (total == kMinusInf) return total;

  TransitionSums sums(chain);
  PaddedMatrix way_back(3, n, kMinusInf);
  double* beta = way_back.row(0);
  double* after = way_back.row(1);
  double* posterior = way_back.row(2);
  std::fill(beta, beta + n, 0.0);
  for (std::ptrdiff_t t = num_frames - 1; t >= 0; --t) {
    const double* now = alpha.row(t);
    if (t + 1 < num_frames) {
      log_step_back(chain, log_b[t + 1], scratch.data(), after, beta);
      if (counts != nullptr) {
        const double alpha_top = kernels.largest(now, count);
        // As long as no pair is too far above the total, terms that underflow are none that count.
        if (alpha_top + kernels.largest(after, count) - total < 460) {
          kernels.exponentials(now, alpha_top, count, sums.x());
          kernels.exponentials(after, total - alpha_top, count, sums.y());
          sums.add();
        } else {
          count_steps_in_logs(chain, now, after, total, counts);
          if (chain.jumps()) count_jumps_in_logs(chain, now, after, total, counts);
        }
      }
    }
    for (int i = 0; i < n; ++i) posterior[i] = now[i] + beta[i];
    kernels.exponentials(posterior, total, count, posterior);
    std::copy_n(posterior, n, gamma + t * stride);
  }
  if (counts != nullptr) {
    sums.finish(counts);
    for (int i = 0; i < n; ++i) counts->start[i] += gamma[i];
  }
  return total;
}

bool scaled_forward_backward(const MarkovChain& chain, const Rows<double>& b, PaddedMatrix* gamma,
                             ChainCounts* counts, double* log_likelihood) {
  const int n = chain.num_states();
  const std::ptrdiff_t stride = gamma->stride();
  const std::ptrdiff_t num_frames = b.num_frames;
  const DenseKernels& kernels = dense_kernels();
  double exponent = 0;
  double sum = 0;
  // gamma holds alpha until the way back.
  for (std::ptrdiff_t t = 0; t < num_frames; ++t) {
    double* now = gamma->row(t);
    std::fill(now + n, now + stride, 0.0);
    Spread spread{};
    if (t == 0) {
      std::copy_n(chain.start().data(), n, now);
      spread = kernels.emit(b[t], stride, now);
    } else {
      spread = chain.propagate(now - stride, b[t], now);
    }
    if (spread.smallest < kDanger) return false;
    sum = spread.sum;
    if (!(sum > 0)) {
      std::fill(gamma->row(0), gamma->row(num_frames), 0.0);
      *log_likelihood = kMinusInf;
      return true;
    }
    if (sum < kRescale) {
      const int power = -std::ilogb(sum);
      const double scale = std::ldexp(1.0, power);
      for (int j = 0; j < n; ++j) now[j] *= scale;
      sum *= scale;
      exponent -= power;
    }
  }
  *log_likelihood = std::log(sum) + exponent * kLog2;

  TransitionSums sums(chain);
  PaddedMatrix way_back(2, n, 0);
  double* after = way_back.row(0);
  double* beta = way_back.row(1);
  double* last = gamma->row(num_frames - 1);
  for (int j = 0; j < n; ++j) last[j] /= sum;
  std::fill(beta, beta + n, 1.0);
  for (std::ptrdiff_t t = num_frames - 2; t >= 0; --t) {
    std::copy_n(beta, stride, after);
    const Spread spread = kernels.emit(b[t + 1], stride, after);
    if (spread.smallest < kDanger || !(spread.sum > 0)) return false;
    if (spread.sum < kRescale) {
      const double up = std::ldexp(1.0, -std::ilogb(spread.sum));
      for (int j = 0; j < n; ++j) after[j] *= up;
    }
    chain.propagate_back(after, beta);
    double* now = gamma->row(t);
    std::copy_n(now, stride, sums.x());
    std::copy_n(beta, stride, now);
    const double total = kernels.emit(sums.x(), stride, now).sum;
    if (!(total > kSafeTotal)) return false;
    const double scale = 1 / total;
    for (int j = 0; j < n; ++j) now[j] *= scale;
    if (counts == nullptr) continue;
    double* y = sums.y();
    for (std::ptrdiff_t j = 0; j < stride; ++j) y[j] = after[j] * scale;
    sums.add();
  }
  if (counts != nullptr) {
    sums.finish(counts);
    for (int i = 0; i < n; ++i) counts->start[i] += gamma->row(0)[i];
  }
  return true;
}

}  // namespace hri::detail
