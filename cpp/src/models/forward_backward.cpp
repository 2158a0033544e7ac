// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "forward_backward.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hri::detail {
namespace {

constexpr double kMinusInf = -std::numeric_limits<double>::infinity();

// log sum exp of values[i] + terms(i) over i in [begin, end).
template <class F>
double log_sum(int begin, int end, const F& term) {
  double top = kMinusInf;
  for (int i = begin; i < end; ++i) top = std::max(top, term(i));
  if (top == kMinusInf) return kMinusInf;
  double sum = 0;
  for (int i = begin; i < end; ++i) sum += std::exp(term(i) - top);
  return top + std::log(sum);
}

// exp(values - their maximum) into `out`; gives the maximum.
double scaled_exp(const double* values, int count, double* out) {
  const double top = *std::max_element(values, values + count);
  if (top == kMinusInf) return top;
  for (int i = 0; i < count; ++i) out[i] = std::exp(values[i] - top);
  return top;
}

// One step of the forward recursion. Sums are taken of probabilities scaled by the largest, with
// one exp and one log a state; a sum so small that terms may have underflowed is taken again in
// logs.
constexpr double kSafeSum = 1e-200;

template <class Scalar>
void forward_step(const MarkovChain& chain, const Scalar* log_b, const double* before,
                  double* scratch, double* after) {
  const int n = chain.num_states();
  const double top = scaled_exp(before, n, scratch);
  if (top == kMinusInf) {
    std::fill(after, after + n, kMinusInf);
    return;
  }
  chain.propagate(scratch, after);
  for (int j = 0; j < n; ++j) {
    const double log_sum_j =
        after[j] > kSafeSum
            ? top + std::log(after[j])
            : log_sum(0, n, [&](int i) { return before[i] + chain.log_transition()(i, j); });
    after[j] = static_cast<double>(log_b[j]) + log_sum_j;
  }
}

// The same backward: `after` holds log b(t + 1) + beta(t + 1).
void backward_step(const MarkovChain& chain, const double* after, double* scratch, double* beta) {
  const int n = chain.num_states();
  const double top = scaled_exp(after, n, scratch);
  if (top == kMinusInf) {
    std::fill(beta, beta + n, kMinusInf);
    return;
  }
  chain.propagate_back(scratch, beta);
  for (int i = 0; i < n; ++i) {
    beta[i] = beta[i] > kSafeSum
                  ? top + std::log(beta[i])
                  : log_sum(0, n, [&](int j) { return chain.log_transition()(i, j) + after[j]; });
  }
}

}  // namespace

VectorD safe_log(const VectorD& values) {
  return values.unaryExpr([](double v) { return v > 0 ? std::log(v) : kMinusInf; });
}

MatrixD safe_log(const MatrixD& values) {
  return values.unaryExpr([](double v) { return v > 0 ? std::log(v) : kMinusInf; });
}

template <class Scalar>
double forward(const MarkovChain& chain, const Matrix<Scalar>& log_b) {
  const int n = chain.num_states();
  thread_local std::vector<double> buffers;
  buffers.resize(3 * static_cast<std::size_t>(n));
  double* now = buffers.data();
  double* next = now + n;
  double* scratch = next + n;
  for (int j = 0; j < n; ++j) now[j] = chain.log_start()[j] + static_cast<double>(log_b(0, j));
  for (Eigen::Index t = 1; t < log_b.rows(); ++t) {
    forward_step(chain, log_b.data() + t * n, now, scratch, next);
    std::swap(now, next);
  }
  return log_sum(0, n, [&](int i) { return now[i]; });
}

template double forward<float>(const MarkovChain&, const MatrixF&);
template double forward<double>(const MarkovChain&, const MatrixD&);

template <class Scalar>
double viterbi(const MarkovChain& chain, const Matrix<Scalar>& log_b, std::vector<int>* path) {
  const int n = chain.num_states();
  const Eigen::Index num_frames = log_b.rows();
  MatrixD delta(num_frames, n);
  for (int j = 0; j < n; ++j) delta(0, j) = chain.log_start()[j] + static_cast<double>(log_b(0, j));
  for (Eigen::Index t = 1; t < num_frames; ++t) {
    chain.propagate_max(delta.data() + (t - 1) * n, delta.data() + t * n);
    for (int j = 0; j < n; ++j) delta(t, j) += static_cast<double>(log_b(t, j));
  }
  Eigen::Index last = 0;
  const double score = delta.row(num_frames - 1).maxCoeff(&last);
  if (path != nullptr) {
    path->clear();
    if (score > kMinusInf) {
      path->resize(static_cast<std::size_t>(num_frames));
      int state = static_cast<int>(last);
      for (Eigen::Index t = num_frames - 1; t > 0; --t) {
        (*path)[static_cast<std::size_t>(t)] = state;
        state = chain.best_previous(delta.data() + (t - 1) * n, state);
      }
      path->front() = state;
    }
  }
  return score;
}

template double viterbi<float>(const MarkovChain&, const MatrixF&, std::vector<int>*);
template double viterbi<double>(const MarkovChain&, const MatrixD&, std::vector<int>*);

double forward_backward(const MarkovChain& chain, const MatrixD& log_b, MatrixD* gamma,
                        ChainCounts* counts) {
  const Topology& topology = chain.topology();
  const int n = topology.num_states;
  const Eigen::Index num_frames = log_b.rows();
  MatrixD alpha(num_frames, n);
  MatrixD beta = MatrixD::Zero(num_frames, n);
  VectorD scratch(n);
  VectorD after(n);
  alpha.row(0) = chain.log_start().transpose() + log_b.row(0);
  for (Eigen::Index t = 1; t < num_frames; ++t) {
    forward_step(chain, log_b.data() + t * n, alpha.data() + (t - 1) * n, scratch.data(),
                 alpha.data() + t * n);
  }
  const double total = log_sum(0, n, [&](int i) { return alpha(num_frames - 1, i); });
  gamma->setZero(num_frames, n);
  if (total == kMinusInf) return total;
  for (Eigen::Index t = num_frames - 2; t >= 0; --t) {
    after = (log_b.row(t + 1) + beta.row(t + 1)).transpose();
    backward_step(chain, after.data(), scratch.data(), beta.data() + t * n);
    for (int i = 0; i < n; ++i) {
      if (alpha(t, i) == kMinusInf) continue;
      for (int j = topology.first_next(i); j < topology.end_next(i); ++j) {
        if (chain.band()(i, j) > 0) {
          counts->band(i, j) += chain.band()(i, j) * std::exp(alpha(t, i) + after[j] - total);
        }
      }
    }
    if (!chain.jumps()) continue;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double jumped =
            chain.leave()[i] * chain.land()[j] * std::exp(alpha(t, i) + after[j] - total);
        counts->leave[i] += jumped;
        counts->land[j] += jumped;
      }
    }
  }
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    for (int i = 0; i < n; ++i) (*gamma)(t, i) = std::exp(alpha(t, i) + beta(t, i) - total);
  }
  counts->start += gamma->row(0).transpose();
  return total;
}

MarkovChain estimate_chain(const ChainCounts& counts, const MarkovChain& previous) {
  constexpr double kUnvisited = 1e-8;
  VectorD start = previous.start();
  MatrixD band = previous.band();
  VectorD leave = previous.leave();
  VectorD land = previous.land();
  if (counts.start.sum() > kUnvisited) start = counts.start / counts.start.sum();
  for (Eigen::Index i = 0; i < band.rows(); ++i) {
    const double sum = counts.band.row(i).sum() + counts.leave[i];
    if (!(sum > kUnvisited)) continue;
    band.row(i) = counts.band.row(i) / sum;
    if (previous.jumps()) leave[i] = counts.leave[i] / sum;
  }
  if (!previous.jumps()) return {previous.topology(), start, band};
  if (counts.land.sum() > kUnvisited) land = counts.land / counts.land.sum();
  return {previous.topology(), start, band, leave, land};
}

std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states) {
  std::vector<int> states(static_cast<std::size_t>(num_frames));
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    states[static_cast<std::size_t>(t)] = static_cast<int>(t * num_states / num_frames);
  }
  return states;
}

}  // namespace hri::detail
