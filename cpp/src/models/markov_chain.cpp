// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/markov_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forward_backward.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kMinusInf = -std::numeric_limits<double>::infinity();
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
  if (const char* fault = topology_fault(topology)) return {"topology", fault};
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
    : topology_(topology), start_(std::move(start)), transition_(std::move(transition)) {
  require(!jumps(), "a chain of topology rank_one_plus_band needs leave and land");
  const Fault fault = chain_fault(topology_, start_, transition_, leave_, land_);
  require(fault.what == nullptr, fault.what);
  tabulate();
}

MarkovChain::MarkovChain(const Topology& topology, VectorD start, MatrixD band, VectorD leave,
                         VectorD land)
    : topology_(topology),
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
  log_start_ = detail::safe_log(start_);
  log_transition_ = detail::safe_log(transition_);
  if (!jumps()) return;
  log_leave_ = detail::safe_log(leave_);
  log_land_ = detail::safe_log(land_);
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
  std::fill(y, y + n, 0.0);
  double left = 0;
  const MatrixD& a = band();
  for (int i = 0; i < n; ++i) {
    const double* row = a.data() + static_cast<std::ptrdiff_t>(i) * n;
    for (int j = topology_.first_next(i); j < topology_.end_next(i); ++j) y[j] += x[i] * row[j];
    if (jumps()) left += x[i] * leave_[i];
  }
  if (!jumps()) return;
  for (int j = 0; j < n; ++j) y[j] += left * land_[j];
}

void MarkovChain::propagate_back(const double* x, double* y) const {
  const int n = num_states();
  double landed = 0;
  if (jumps()) {
    for (int j = 0; j < n; ++j) landed += land_[j] * x[j];
  }
  const MatrixD& a = band();
  for (int i = 0; i < n; ++i) {
    const double* row = a.data() + static_cast<std::ptrdiff_t>(i) * n;
    double sum = jumps() ? leave_[i] * landed : 0.0;
    for (int j = topology_.first_next(i); j < topology_.end_next(i); ++j) sum += row[j] * x[j];
    y[i] = sum;
  }
}

// A jump is never more likely than a_ij as a whole, so that outside the band the best state to come
// from is the best one to leave from, whatever j is; inside the band a_ij decides.
void MarkovChain::propagate_max(const double* x, double* y) const {
  const int n = num_states();
  double best_leave = kMinusInf;
  if (jumps()) {
    for (int i = 0; i < n; ++i) best_leave = std::max(best_leave, x[i] + log_leave_[i]);
  }
  for (int j = 0; j < n; ++j) y[j] = jumps() ? best_leave + log_land_[j] : kMinusInf;
  for (int i = 0; i < n; ++i) {
    const double* row = log_transition_.data() + static_cast<std::ptrdiff_t>(i) * n;
    for (int j = topology_.first_next(i); j < topology_.end_next(i); ++j)
      y[j] = std::max(y[j], x[i] + row[j]);
  }
}

int MarkovChain::best_previous(const double* x, int j) const {
  const int begin = jumps() ? 0 : topology_.first_previous(j);
  const int end = jumps() ? num_states() : topology_.end_previous(j);
  int best = begin;
  for (int i = begin + 1; i < end; ++i) {
    if (x[i] + log_transition_(i, j) > x[best] + log_transition_(best, j)) best = i;
  }
  return best;
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
