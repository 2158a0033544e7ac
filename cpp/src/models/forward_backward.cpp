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

// The states from which j can be reached form a contiguous range in every topology.
int first_previous(const Topology& t, int j) {
  return t.kind == Topology::Kind::ergodic ? 0 : std::max(0, j - t.max_jump);
}
int end_previous(const Topology& t, int j) {
  if (t.kind == Topology::Kind::left_right) return j + 1;
  return t.kind == Topology::Kind::banded ? std::min(t.num_states, j + t.max_jump + 1)
                                          : t.num_states;
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
void forward_step(const Chain& chain, const Scalar* log_b, const double* before, double* scratch,
                  double* after) {
  const int n = chain.topology.num_states;
  const double top = scaled_exp(before, n, scratch);
  for (int j = 0; j < n; ++j) {
    const int begin = first_previous(chain.topology, j);
    const int end = end_previous(chain.topology, j);
    double sum = 0;
    if (top > kMinusInf) {
      for (int i = begin; i < end; ++i) sum += scratch[i] * chain.transition(i, j);
    }
    const double log_sum_j = sum > kSafeSum ? top + std::log(sum) : log_sum(begin, end, [&](int i) {
      return before[i] + chain.log_transition(i, j);
    });
    after[j] = static_cast<double>(log_b[j]) + log_sum_j;
  }
}

// The same backward: `after` holds log b(t + 1) + beta(t + 1).
void backward_step(const Chain& chain, const double* after, double* scratch, double* beta) {
  const int n = chain.topology.num_states;
  const double top = scaled_exp(after, n, scratch);
  for (int i = 0; i < n; ++i) {
    const int begin = chain.topology.first_next(i);
    const int end = chain.topology.end_next(i);
    double sum = 0;
    if (top > kMinusInf) {
      for (int j = begin; j < end; ++j) sum += chain.transition(i, j) * scratch[j];
    }
    beta[i] = sum > kSafeSum ? top + std::log(sum) : log_sum(begin, end, [&](int j) {
      return chain.log_transition(i, j) + after[j];
    });
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
double forward(const Chain& chain, const Matrix<Scalar>& log_b) {
  const int n = chain.topology.num_states;
  thread_local std::vector<double> buffers;
  buffers.resize(3 * static_cast<std::size_t>(n));
  double* now = buffers.data();
  double* next = now + n;
  double* scratch = next + n;
  for (int j = 0; j < n; ++j) now[j] = chain.log_start[j] + static_cast<double>(log_b(0, j));
  for (Eigen::Index t = 1; t < log_b.rows(); ++t) {
    forward_step(chain, log_b.data() + t * n, now, scratch, next);
    std::swap(now, next);
  }
  return log_sum(0, n, [&](int i) { return now[i]; });
}

template double forward<float>(const Chain&, const MatrixF&);
template double forward<double>(const Chain&, const MatrixD&);

template <class Scalar>
double viterbi(const Chain& chain, const Matrix<Scalar>& log_b, std::vector<int>* path) {
  const int n = chain.topology.num_states;
  const Eigen::Index num_frames = log_b.rows();
  MatrixD delta(num_frames, n);
  Matrix<int> from = Matrix<int>::Zero(num_frames, n);
  for (int j = 0; j < n; ++j) delta(0, j) = chain.log_start[j] + static_cast<double>(log_b(0, j));
  for (Eigen::Index t = 1; t < num_frames; ++t) {
    for (int j = 0; j < n; ++j) {
      const int begin = first_previous(chain.topology, j);
      double best = kMinusInf;
      int best_i = begin;
      for (int i = begin; i < end_previous(chain.topology, j); ++i) {
        const double score = delta(t - 1, i) + chain.log_transition(i, j);
        if (score > best) {
          best = score;
          best_i = i;
        }
      }
      delta(t, j) = best + static_cast<double>(log_b(t, j));
      from(t, j) = best_i;
    }
  }
  Eigen::Index last = 0;
  const double score = delta.row(num_frames - 1).maxCoeff(&last);
  if (path != nullptr) {
    path->clear();
    if (score > kMinusInf) {
      path->resize(static_cast<std::size_t>(num_frames));
      int state = static_cast<int>(last);
      for (Eigen::Index t = num_frames - 1; t >= 0; --t) {
        (*path)[static_cast<std::size_t>(t)] = state;
        state = from(t, state);
      }
    }
  }
  return score;
}

template double viterbi<float>(const Chain&, const MatrixF&, std::vector<int>*);
template double viterbi<double>(const Chain&, const MatrixD&, std::vector<int>*);

double forward_backward(const Chain& chain, const MatrixD& log_b, MatrixD* gamma,
                        ChainCounts* counts) {
  const Topology& topology = chain.topology;
  const int n = topology.num_states;
  const Eigen::Index num_frames = log_b.rows();
  MatrixD alpha(num_frames, n);
  MatrixD beta = MatrixD::Zero(num_frames, n);
  VectorD scratch(n);
  VectorD after(n);
  alpha.row(0) = chain.log_start.transpose() + log_b.row(0);
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
        counts->transition(i, j) +=
            std::exp(alpha(t, i) + chain.log_transition(i, j) + after[j] - total);
      }
    }
  }
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    for (int i = 0; i < n; ++i) (*gamma)(t, i) = std::exp(alpha(t, i) + beta(t, i) - total);
  }
  counts->start += gamma->row(0).transpose();
  return total;
}

void estimate_chain(const ChainCounts& counts, VectorD* start, MatrixD* transition) {
  constexpr double kUnvisited = 1e-8;
  if (counts.start.sum() > kUnvisited) *start = counts.start / counts.start.sum();
  for (Eigen::Index i = 0; i < transition->rows(); ++i) {
    const double sum = counts.transition.row(i).sum();
    if (sum > kUnvisited) transition->row(i) = counts.transition.row(i) / sum;
  }
}

const char* chain_fault(const Topology& topology, const VectorD& start, const MatrixD& transition) {
  if (const char* fault = topology_fault(topology)) return fault;
  const Eigen::Index n = topology.num_states;
  if (start.size() != n || transition.rows() != n || transition.cols() != n) {
    return "start and transition must have num_states rows and columns";
  }
  if (!start.allFinite() || !transition.allFinite()) return "start or transition is not finite";
  if (start.minCoeff() < 0 || std::abs(start.sum() - 1) > 1e-6)
    return "start must be >= 0 and sum to 1";
  if (transition.minCoeff() < 0 ||
      (transition.rowwise().sum().array() - 1).abs().maxCoeff() > 1e-6) {
    return "the rows of transition must be >= 0 and sum to 1";
  }
  for (int i = 0; i < topology.num_states; ++i) {
    for (int j = 0; j < topology.num_states; ++j) {
      if (!topology.allows(i, j) && transition(i, j) != 0)
        return "transition has an entry outside its topology";
    }
  }
  return nullptr;
}

std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states) {
  std::vector<int> states(static_cast<std::size_t>(num_frames));
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    states[static_cast<std::size_t>(t)] = static_cast<int>(t * num_states / num_frames);
  }
  return states;
}

}  // namespace hri::detail
