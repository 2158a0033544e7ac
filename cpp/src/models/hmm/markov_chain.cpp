// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/markov_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/forward_backward.hpp"

namespace hri {
namespace {

using detail::kMinusInf;
constexpr double kSumTolerance = 1e-6;

bool is_distribution(const VectorD& values) {
  return values.size() > 0 && values.allFinite() && values.minCoeff() >= 0 &&
         std::abs(values.sum() - 1) <= kSumTolerance;
}

// What is wrong with the parameters; `what` is nullptr where all is well.
struct Fault {
  const char* field = "";
  const char* what = nullptr;
};

Fault chain_fault(const Topology& topology, const VectorD& start, const MatrixD& band,
                  const VectorD& leave, const VectorD& land) {
  if (!options_fault(topology).empty()) return {"topology", "topology is out of range"};
  const Eigen::Index n = topology.num_states;
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  const Eigen::Index num_jumps = jumps ? n : 0;
  if (start.size() != n) return {"start", "start must have num_states values"};
  if (band.rows() != n || band.cols() != n)
    return {"transition", "transition must have num_states rows and columns"};
  if (leave.size() != num_jumps) return {"leave", "leave must have num_states values"};
  if (land.size() != num_jumps) return {"land", "land must have num_states values"};
  if (!is_distribution(start)) return {"start", "start must be finite, >= 0 and sum to 1"};
  if (jumps && !is_distribution(land)) return {"land", "land must be finite, >= 0 and sum to 1"};
  if (!band.allFinite() || band.minCoeff() < 0)
    return {"transition", "transition must be finite and >= 0"};
  if (jumps && (!leave.allFinite() || leave.minCoeff() < 0))
    return {"leave", "leave must be finite and >= 0"};
  for (int i = 0; i < topology.num_states; ++i) {
    const double sum = band.row(i).sum() + (jumps ? leave[i] : 0.0);
    if (std::abs(sum - 1) > kSumTolerance)
      return {"transition", "the rows of transition must sum to 1"};
    for (int j = 0; j < topology.num_states; ++j) {
      const bool in_band = j >= topology.first_next(i) && j < topology.end_next(i);
      if (!in_band && band(i, j) != 0)
        return {"transition", "transition has an entry outside its topology"};
    }
  }
  return {};
}

}  // namespace

MarkovChain::MarkovChain(const Topology& topology, VectorD start, MatrixD transition)
    : topology_(validated(topology)), start_(std::move(start)), transition_(std::move(transition)) {
  require(!jumps(), "a chain of topology rank_one_plus_band needs leave and land");
  const Fault fault = chain_fault(topology_, start_, transition_, leave_, land_);
  require(fault.what == nullptr, fault.what);
  tabulate();
}

MarkovChain::MarkovChain(const Topology& topology, VectorD start, MatrixD band, VectorD leave,
                         VectorD land)
    : topology_(validated(topology)),
      start_(std::move(start)),
      band_(std::move(band)),
      leave_(std::move(leave)),
      land_(std::move(land)) {
  require(jumps(), "leave and land belong to rank_one_plus_band only");
  const Fault fault = chain_fault(topology_, start_, band_, leave_, land_);
  require(fault.what == nullptr, fault.what);
  transition_ = band_ + leave_ * land_.transpose();
  tabulate();
}

void MarkovChain::tabulate() {
  detail::dense_kernels();  // the processor is asked now, so that no step allocates
  log_start_ = detail::safe_log(start_);
  if (jumps()) {
    log_leave_ = detail::safe_log(leave_);
    log_land_ = detail::safe_log(land_);
  }
  const int n = num_states();
  if (dense()) {
    forward_ = detail::PaddedMatrix(transition_);
    back_ = detail::PaddedMatrix(transition_.transpose());
    const MatrixD logs = detail::safe_log(transition_);
    log_forward_ = detail::PaddedMatrix(logs, kMinusInf);
    log_back_ = detail::PaddedMatrix(logs.transpose(), kMinusInf);
    return;
  }
  const int longest = std::min(topology_.max_jump, n - 1);
  lowest_step_ = topology_.kind == Topology::Kind::left_right ? 0 : longest;
  steps_ = detail::PaddedMatrix(lowest_step_ + longest + 1, n, 0);
  log_steps_ = detail::PaddedMatrix(steps_.num_rows(), n, kMinusInf);
  for (int i = 0; i < n; ++i) {
    for (int j = topology_.first_next(i); j < topology_.end_next(i); ++j) {
      steps_.row(j - i + lowest_step_)[i] = band()(i, j);
      if (transition_(i, j) > 0)
        log_steps_.row(j - i + lowest_step_)[i] = std::log(transition_(i, j));
    }
  }
  if (topology_.kind != Topology::Kind::left_right || longest > 1) return;
  by_one_ = detail::PaddedMatrix(detail::kNumByOne, n, 0);
  for (int j = 0; j < n; ++j) {
    by_one_.row(detail::kStay)[j] = transition_(j, j);
    if (j > 0) by_one_.row(detail::kGoInto)[j] = transition_(j - 1, j);
    if (j + 1 < n) by_one_.row(detail::kGoFrom)[j] = transition_(j, j + 1);
  }
  for (int row = 0; row < detail::kLogGoInto; ++row) {
    for (std::ptrdiff_t j = 0; j < by_one_.stride(); ++j) {
      const double p = by_one_.row(row)[j];
      by_one_.row(row + detail::kLogGoInto)[j] = p > 0 ? std::log(p) : kMinusInf;
    }
  }
}

MarkovChain MarkovChain::initial(const Topology& topology) {
  if (topology.kind != Topology::Kind::rank_one_plus_band)
    return {topology, initial_start(topology), initial_transition(topology)};
  constexpr double kLeave = 0.1;
  const int n = topology.num_states;
  return {topology, initial_start(topology), (1 - kLeave) * initial_transition(topology),
          VectorD::Constant(n, kLeave), VectorD::Constant(n, 1.0 / n)};
}

void MarkovChain::propagate(const double* x, double* y) const {
  const int n = num_states();
  if (dense()) {
    detail::dense_kernels().propagate(x, n, forward_.row(0), forward_.stride(), n, y);
    return;
  }
  std::fill(y, y + n, 0.0);
  // The longest step first, so that y[j] adds up its i in ascending order.
  for (auto row = static_cast<int>(steps_.num_rows()) - 1; row >= 0; --row) {
    const int step = row - lowest_step_;
    const double* a = steps_.row(row);
    const int end = std::min(n, n - step);
    for (int i = std::max(0, -step); i < end; ++i) y[i + step] += x[i] * a[i];
  }
  if (!jumps()) return;
  double left = 0;
  for (int i = 0; i < n; ++i) left += x[i] * leave_[i];
  for (int j = 0; j < n; ++j) y[j] += left * land_[j];
}

detail::Spread MarkovChain::propagate(const double* x, const double* b, double* y) const {
  const detail::DenseKernels& kernels = detail::dense_kernels();
  const std::ptrdiff_t count = detail::padded(num_states());
  if (!by_one_.empty())
    return kernels.step_by_one(x, by_one_.row(detail::kGoInto), by_one_.row(detail::kStay), b,
                               count, y);
  if (dense()) {
    // Also what pads, so that whole registers are stored.
    kernels.propagate(x, num_states(), forward_.row(0), forward_.stride(), static_cast<int>(count),
                      y);
  } else {
    propagate(x, y);
  }
  return kernels.emit(b, count, y);
}

void MarkovChain::propagate_back(const double* x, double* y) const {
  const int n = num_states();
  if (dense()) {
    detail::dense_kernels().propagate(x, n, back_.row(0), back_.stride(), n, y);
    return;
  }
  double landed = 0;
  if (jumps()) {
    for (int j = 0; j < n; ++j) landed += land_[j] * x[j];
  }
  for (int i = 0; i < n; ++i) y[i] = jumps() ? leave_[i] * landed : 0.0;
  for (int row = 0; row < static_cast<int>(steps_.num_rows()); ++row) {
    const int step = row - lowest_step_;
    const double* a = steps_.row(row);
    const int end = std::min(n, n - step);
    for (int i = std::max(0, -step); i < end; ++i) y[i] += a[i] * x[i + step];
  }
}

// A jump is never more likely than a_ij as a whole, so that outside the band the best state to come
// from is the best one to leave from, whatever j is; inside the band a_ij decides.
void MarkovChain::propagate_max(const double* x, double* y) const {
  const int n = num_states();
  if (dense()) {
    detail::dense_kernels().propagate_max(x, n, log_forward_.row(0), log_forward_.stride(), n, y);
    return;
  }
  if (jumps()) {
    const int leaver = best_leaver(x);
    const double best = x[leaver] + log_leave_[leaver];
    for (int j = 0; j < n; ++j) y[j] = best + log_land_[j];
  } else {
    std::fill(y, y + n, kMinusInf);
  }
  for (int row = 0; row < static_cast<int>(log_steps_.num_rows()); ++row) {
    const int step = row - lowest_step_;
    const double* a = log_steps_.row(row);
    const int end = std::min(n, n - step);
    for (int i = std::max(0, -step); i < end; ++i) y[i + step] = std::max(y[i + step], x[i] + a[i]);
  }
}

void MarkovChain::propagate_max_back(const double* x, double* y) const {
  const int n = num_states();
  if (dense()) {
    detail::dense_kernels().propagate_max(x, n, log_back_.row(0), log_back_.stride(), n, y);
    return;
  }
  if (jumps()) {
    double landed = kMinusInf;
    for (int j = 0; j < n; ++j) landed = std::max(landed, log_land_[j] + x[j]);
    for (int i = 0; i < n; ++i) y[i] = log_leave_[i] + landed;
  } else {
    std::fill(y, y + n, kMinusInf);
  }
  for (int row = 0; row < static_cast<int>(log_steps_.num_rows()); ++row) {
    const int step = row - lowest_step_;
    const double* a = log_steps_.row(row);
    const int end = std::min(n, n - step);
    for (int i = std::max(0, -step); i < end; ++i) y[i] = std::max(y[i], a[i] + x[i + step]);
  }
}

int MarkovChain::best_leaver(const double* x) const {
  return jumps() ? detail::dense_kernels().best_sum(x, log_leave_.data(), num_states()) : 0;
}

int MarkovChain::best_previous(const double* x, int j) const {
  return best_previous(x, j, best_leaver(x));
}

int MarkovChain::best_previous(const double* x, int j, int best_leaver) const {
  if (dense()) {
    return detail::dense_kernels().best_sum(x, log_back_.row(j), num_states());
  }
  const int begin = topology_.first_previous(j);
  const int end = topology_.end_previous(j);
  const auto score = [&](int i) { return x[i] + log_steps_.row(j - i + lowest_step_)[i]; };
  int best = begin;
  for (int i = begin + 1; i < end; ++i) {
    if (score(i) > score(best)) best = i;
  }
  if (!jumps() || (best_leaver >= begin && best_leaver < end)) return best;
  const double in_band = score(best);
  const double jumped = x[best_leaver] + log_leave_[best_leaver] + log_land_[j];
  return jumped > in_band || (jumped == in_band && best_leaver < best) ? best_leaver : best;
}

detail::ByOneRows MarkovChain::by_one() const {
  detail::ByOneRows rows{};
  for (std::size_t row = 0; row < rows.size() && !by_one_.empty(); ++row)
    rows[row] = by_one_.row(static_cast<std::ptrdiff_t>(row));
  return rows;
}

double MarkovChain::smallest_probability() const {
  const auto smallest = [](const double* values, Eigen::Index count) {
    double low = 1;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (values[i] > 0) low = std::min(low, values[i]);
    }
    return low;
  };
  const double low =
      std::min(smallest(start_.data(), start_.size()), smallest(band().data(), band().size()));
  if (!jumps()) return low;
  return std::min(low,
                  smallest(leave_.data(), leave_.size()) * smallest(land_.data(), land_.size()));
}

void MarkovChain::write(ModelFile& file, const std::string& prefix) const {
  write_topology(topology_, file, prefix);
  file.set_vector(prefix + "start", start_);
  file.set_matrix(prefix + "transition", band());
  if (!jumps()) return;
  file.set_vector(prefix + "leave", leave_);
  file.set_vector(prefix + "land", land_);
}

MarkovChain MarkovChain::read(const ModelFile& file, const std::string& prefix) {
  const Topology topology = read_topology(file, prefix);
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  const VectorD start = file.vector_d(prefix + "start");
  const MatrixD band = file.matrix_d(prefix + "transition");
  const VectorD leave = jumps ? file.vector_d(prefix + "leave") : VectorD();
  const VectorD land = jumps ? file.vector_d(prefix + "land") : VectorD();
  const Fault fault = chain_fault(topology, start, band, leave, land);
  if (fault.what != nullptr) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + fault.field + "': " + fault.what);
  }
  if (!jumps) return {topology, start, band};
  return {topology, start, band, leave, land};
}

}  // namespace hri
