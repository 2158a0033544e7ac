// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/composite_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hri::htk::detail {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

double log_add(double a, double b) {
  if (a < b) std::swap(a, b);
  return b == kNever ? a : a + std::log1p(std::exp(b - a));
}

// Frames on the shortest way from the entry to the exit: breadth first.
int shortest(const MatrixD& transitions) {
  const Eigen::Index exit = transitions.rows() - 1;
  std::vector<int> frames(static_cast<std::size_t>(exit + 1), LogChain::kNoWay);
  frames[0] = 0;
  std::vector<Eigen::Index> open = {0};
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Eigen::Index from = open[k];
    for (Eigen::Index to = 1; to <= exit; ++to) {
      int& known = frames[static_cast<std::size_t>(to)];
      if (!(transitions(from, to) > 0) || known != LogChain::kNoWay) continue;
      if (to == exit) return frames[static_cast<std::size_t>(from)];
      known = frames[static_cast<std::size_t>(from)] + 1;
      open.push_back(to);
    }
  }
  return LogChain::kNoWay;
}

}  // namespace

LogChain::LogChain(const MatrixD& transitions) : min_frames(shortest(transitions)) {
  const MatrixD logs = transitions.array().log();
  const Eigen::Index n = logs.rows() - 2;
  next.resize(static_cast<std::size_t>(n));
  previous.resize(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    start.push_back(logs(0, i + 1));
    exit.push_back(logs(i + 1, n + 1));
    for (Eigen::Index j = 0; j < n; ++j) {
      const double log_weight = logs(i + 1, j + 1);
      if (log_weight == kNever) continue;
      next[static_cast<std::size_t>(i)].push_back({static_cast<int>(j), log_weight});
      previous[static_cast<std::size_t>(j)].push_back({static_cast<int>(i), log_weight});
    }
  }
  skip = logs(0, n + 1);
}

std::int64_t CompositePass::begin(const std::vector<const LogChain*>& units) {
  units_ = units;
  first_.clear();
  unit_of_.clear();
  std::int64_t num_frames = 0;
  for (std::size_t u = 0; u < units.size(); ++u) {
    first_.push_back(static_cast<int>(unit_of_.size()));
    unit_of_.insert(unit_of_.end(), units[u]->exit.size(), static_cast<int>(u));
    num_frames += units[u]->min_frames;
  }
  first_.push_back(static_cast<int>(unit_of_.size()));
  enter_.resize(first_.size());
  reached_.resize(first_.size());
  alpha_.resize(unit_of_.size());
  next_alpha_.resize(unit_of_.size());
  gamma_.resize(unit_of_.size());
  return num_frames;
}

// Backward scores at the entries of units at a point; those at its frame are known.
void CompositePass::enter(std::int64_t point) {
  std::fill(enter_.begin(), enter_.end(), kNever);
  const auto num_frames = static_cast<std::int64_t>(rows_.size());
  const bool at_end = point == num_frames;
  const Row row = at_end ? Row() : rows_[static_cast<std::size_t>(point)];
  if (at_end) enter_.back() = 0;
  for (int u = at_end ? num_units() - 1 : unit_of(row.end - 1); u >= 0; --u) {
    const LogChain& chain = *units_[static_cast<std::size_t>(u)];
    double score = chain.skip + enter_[static_cast<std::size_t>(u) + 1];
    for (int i = 0; i < chain.num_states(); ++i) {
      const int state = first_of(u) + i;
      if (!row.has(state)) continue;
      score = log_add(score, chain.start[static_cast<std::size_t>(i)] + log_b_[row.at(state)] +
                                 beta_[row.at(state)]);
    }
    enter_[static_cast<std::size_t>(u)] = score;
    if (score == kNever && first_of(u) <= row.first) break;
  }
}

double CompositePass::backward_score(int state, const Row& later) const {
  const int unit = unit_of(state);
  const LogChain& chain = *units_[static_cast<std::size_t>(unit)];
  const auto i = static_cast<std::size_t>(state - first_of(unit));
  double score = chain.exit[i] + enter_[static_cast<std::size_t>(unit) + 1];
  for (const LogChain::Step& step : chain.next[i]) {
    const int to = first_of(unit) + step.state;
    if (later.has(to))
      score = log_add(score, step.log_weight + log_b_[later.at(to)] + beta_[later.at(to)]);
  }
  return score;
}

// The row of a frame from that of the frame after, for whose point enter_ holds; false where no
// state of it leads to the end.
bool CompositePass::add_row(std::int64_t frame, double beam) {
  const auto t = static_cast<std::size_t>(frame);
  const Row later = t + 1 < rows_.size() ? rows_[t + 1] : Row();
  int low = later.end > later.first ? unit_of(later.first) : num_units();
  int high = later.end > later.first ? unit_of(later.end - 1) : -1;
  for (int u = 0; u < num_units(); ++u) {
    if (enter_[static_cast<std::size_t>(u) + 1] == kNever) continue;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  if (high < low) return false;
  Row row{beta_.size(), first_of(low), first_of(high + 1)};
  double best = kNever;
  for (int state = row.first; state < row.end; ++state) {
    beta_.push_back(backward_score(state, later));
    best = std::max(best, beta_.back());
  }
  if (best == kNever) return false;
  if (beam > 0) {
    for (std::size_t k = row.offset; k < beta_.size(); ++k) {
      if (beta_[k] < best - beam) beta_[k] = kNever;
    }
  }
  // States at the ends that lead nowhere are not kept.
  while (beta_.back() == kNever) {
    beta_.pop_back();
    --row.end;
  }
  std::ptrdiff_t dead = 0;
  const auto begin = beta_.begin() + static_cast<std::ptrdiff_t>(row.offset);
  while (*(begin + dead) == kNever) ++dead;
  beta_.erase(begin, begin + dead);
  row.first += static_cast<int>(dead);
  rows_[t] = row;
  return true;
}

double CompositePass::backward(std::int64_t num_frames, double beam, const Densities& densities) {
  rows_.assign(static_cast<std::size_t>(num_frames), Row());
  beta_.clear();
  log_b_.clear();
  enter(num_frames);
  for (std::int64_t t = num_frames - 1; t >= 0; --t) {
    if (!add_row(t, beam)) return kNever;
    const Row& row = rows_[static_cast<std::size_t>(t)];
    log_b_.resize(beta_.size());
    densities(t, row.first, row.end, log_b_.data() + row.offset);
    enter(t);
  }
  log_probability_ = enter_.front();
  return log_probability_;
}

// Forward scores at the entries of units at a point, and what leads there: the exits of the frame
// before, and models passed without a frame.
void CompositePass::leave(std::int64_t point, const Row& before,
                          const std::vector<MatrixD*>& counts) {
  std::fill(reached_.begin(), reached_.end(), kNever);
  if (point == 0) reached_.front() = 0;
  for (int u = point == 0 ? 0 : unit_of(before.first); u < num_units(); ++u) {
    const auto at = static_cast<std::size_t>(u);
    if (first_of(u) >= before.end && reached_[at] == kNever) break;
    const LogChain& chain = *units_[at];
    const double after = enter_[at + 1] - log_probability_;
    const Eigen::Index exit = chain.num_states() + 1;
    double score = reached_[at] + chain.skip;
    (*counts[at])(0, exit) += std::exp(score + after);
    for (int i = 0; i < chain.num_states(); ++i) {
      const int state = first_of(u) + i;
      if (!before.has(state)) continue;
      const double term =
          alpha_[static_cast<std::size_t>(state)] + chain.exit[static_cast<std::size_t>(i)];
      (*counts[at])(i + 1, exit) += std::exp(term + after);
      score = log_add(score, term);
    }
    reached_[at + 1] = score;
  }
}

// Forward scores of the states of a frame, and posteriors in gamma_.
void CompositePass::advance(std::int64_t frame, const Row& before,
                            const std::vector<MatrixD*>& counts) {
  const Row& row = rows_[static_cast<std::size_t>(frame)];
  for (int state = row.first; state < row.end; ++state) {
    const auto s = static_cast<std::size_t>(state);
    const int u = unit_of(state);
    const LogChain& chain = *units_[static_cast<std::size_t>(u)];
    MatrixD& count = *counts[static_cast<std::size_t>(u)];
    const int i = state - first_of(u);
    const double log_b = log_b_[row.at(state)];
    const double after = beta_[row.at(state)] + log_b - log_probability_;
    double score = reached_[static_cast<std::size_t>(u)] + chain.start[static_cast<std::size_t>(i)];
    count(0, i + 1) += std::exp(score + after);
    for (const LogChain::Step& step : chain.previous[static_cast<std::size_t>(i)]) {
      const int from = first_of(u) + step.state;
      if (!before.has(from)) continue;
      const double term = alpha_[static_cast<std::size_t>(from)] + step.log_weight;
      count(step.state + 1, i + 1) += std::exp(term + after);
      score = log_add(score, term);
    }
    gamma_[s] = std::exp(score + after);
    // What the backward pass left out is not passed here.
    next_alpha_[s] = beta_[row.at(state)] == kNever ? kNever : score + log_b;
  }
}

void CompositePass::forward(const std::vector<MatrixD*>& counts, const Posteriors& posteriors) {
  Row before;
  const auto num_frames = static_cast<std::int64_t>(rows_.size());
  for (std::int64_t t = 0; t <= num_frames; ++t) {
    enter(t);
    leave(t, before, counts);
    if (t == num_frames) break;
    advance(t, before, counts);
    alpha_.swap(next_alpha_);
    before = rows_[static_cast<std::size_t>(t)];
    posteriors(t, before.first, before.end, gamma_.data() + before.first);
  }
}

}  // namespace hri::htk::detail
