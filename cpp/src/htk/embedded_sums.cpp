// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/embedded_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri::htk::detail {
namespace {

using hri::detail::kLog2Pi;
constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kLeastWeight = 1e-5;  // HTK's MINMIX: below, a component has no weight

std::size_t place(int number) { return static_cast<std::size_t>(number); }

// Weights below the floor are raised to it at the cost of the others.
void raise_weights(double floor, std::vector<double>* weights) {
  std::vector<bool> raised(weights->size(), false);
  for (bool changed = true; changed;) {
    changed = false;
    double free = 1;
    double others = 0;
    for (std::size_t c = 0; c < weights->size(); ++c) {
      if (!raised[c] && (*weights)[c] < floor) changed = raised[c] = true;
      if (raised[c]) {
        free -= floor;
      } else {
        others += (*weights)[c];
      }
    }
    for (std::size_t c = 0; c < weights->size(); ++c)
      (*weights)[c] = raised[c] ? floor : (*weights)[c] * free / others;
  }
}

}  // namespace

SharedDensities::SharedDensities(const SharedParameters& parameters) {
  for (const SharedComponent& one : parameters.components) {
    const VectorD& variance = parameters.variances[place(one.variance)];
    gaussians_.push_back(
        {parameters.means[place(one.mean)], variance.cwiseInverse(),
         -0.5 * (static_cast<double>(variance.size()) * kLog2Pi + variance.array().log().sum())});
  }
  for (const SharedState& state : parameters.states) {
    states_.push_back(state.components);
    std::vector<double> logs;
    logs.reserve(state.weights.size());
    for (const double weight : state.weights) logs.push_back(std::log(weight));
    logs_.reserve(logs.size());
    log_weights_.push_back(std::move(logs));
  }
}

double SharedDensities::state(int number, const VectorD& frame) {
  const std::vector<int>& components = states_[place(number)];
  if (components.empty()) {
    first_slot_ = static_cast<std::size_t>(frame[0]) - 1;
    logs_.assign(1, log_weights_[place(number)][first_slot_]);
    return logs_.front();
  }
  logs_.resize(components.size());
  double top = kImpossible;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Gaussian& one = gaussians_[place(components[c])];
    const double distance = ((frame - one.mean).array().square() * one.precision.array()).sum();
    logs_[c] = log_weights_[place(number)][c] + one.constant - 0.5 * distance;
    top = std::max(top, logs_[c]);
  }
  if (components.size() == 1 || top == kImpossible) return top;
  double sum = 0;
  for (const double log : logs_) sum += std::exp(log - top);
  return top + std::log(sum);
}

SharedSums::SharedSums(const SharedParameters& parameters) : before_(parameters) {
  for (const MatrixD& one : parameters.transitions)
    transitions.emplace_back(MatrixD::Zero(one.rows(), one.cols()));
  for (const SharedState& state : parameters.states) slots_.emplace_back(state.weights.size(), 0.0);
  const auto count = static_cast<Eigen::Index>(parameters.components.size());
  const Eigen::Index dim = parameters.means.empty() ? 0 : parameters.means.front().size();
  counts_ = VectorD::Zero(count);
  firsts_ = MatrixD::Zero(count, dim);
  seconds_ = MatrixD::Zero(count, dim);
}

void SharedSums::add(int state, std::size_t slot, const VectorD& frame, double probability) {
  slots_[place(state)][slot] += probability;
  if (before_.states[place(state)].components.empty()) return;
  const int component = before_.states[place(state)].components[slot];
  const VectorD& mean = before_.means[place(before_.components[place(component)].mean)];
  counts_[component] += probability;
  firsts_.row(component) += probability * (frame - mean).transpose();
  seconds_.row(component) += probability * (frame - mean).cwiseAbs2().transpose();
}

double SharedSums::occupation(int state) const {
  const std::vector<double>& slots = slots_[place(state)];
  return std::accumulate(slots.begin(), slots.end(), 0.0);
}

std::vector<bool> SharedSums::components_of(const std::vector<bool>& marked) const {
  std::vector<bool> components(before_.components.size(), false);
  for (std::size_t s = 0; s < marked.size(); ++s) {
    if (!marked[s]) continue;
    for (const int one : before_.states[s].components) components[place(one)] = true;
  }
  return components;
}

void SharedSums::estimate_weights(const std::vector<bool>& marked, double floor,
                                  SharedParameters* parameters) const {
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const double sum = occupation(static_cast<int>(s));
    if (!marked[s] || !(sum > 0) || slots_[s].size() < 2) continue;
    std::vector<double>& weights = parameters->states[s].weights;
    double kept = 0;
    for (std::size_t c = 0; c < weights.size(); ++c) {
      weights[c] = slots_[s][c] / sum > kLeastWeight ? slots_[s][c] / sum : 0;
      kept += weights[c];
    }
    for (double& weight : weights) weight /= kept;
    raise_weights(std::min(floor, 1 / static_cast<double>(weights.size())), &weights);
  }
}

void SharedSums::estimate_means(const std::vector<bool>& marked,
                                SharedParameters* parameters) const {
  const std::vector<bool> components = components_of(marked);
  std::vector<bool> wanted(before_.means.size(), false);
  std::vector<VectorD> shifts(before_.means.size(), VectorD::Zero(firsts_.cols()));
  std::vector<VectorD> weights = shifts;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    const std::size_t mean = place(before_.components[c].mean);
    if (components[c]) wanted[mean] = true;
    const auto& variance = before_.variances[place(before_.components[c].variance)].array();
    shifts[mean].array() += firsts_.row(row).transpose().array() / variance;
    weights[mean].array() += counts_[row] / variance;
  }
  for (std::size_t m = 0; m < wanted.size(); ++m) {
    if (wanted[m] && (weights[m].array() > 0).all())
      parameters->means[m] = before_.means[m] + shifts[m].cwiseQuotient(weights[m]);
  }
}

void SharedSums::estimate_variances(const std::vector<bool>& marked, const VectorD& floor,
                                    SharedParameters* parameters) const {
  const std::vector<bool> components = components_of(marked);
  std::vector<bool> wanted(before_.variances.size(), false);
  std::vector<VectorD> squares(before_.variances.size(), VectorD::Zero(firsts_.cols()));
  std::vector<double> counts(before_.variances.size(), 0.0);
  for (std::size_t c = 0; c < components.size(); ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    const SharedComponent& one = before_.components[c];
    const std::size_t variance = place(one.variance);
    if (components[c]) wanted[variance] = true;
    const VectorD shift = parameters->means[place(one.mean)] - before_.means[place(one.mean)];
    squares[variance] += seconds_.row(row).transpose() -
                         2 * shift.cwiseProduct(firsts_.row(row).transpose()) +
                         counts_[row] * shift.cwiseAbs2();
    counts[variance] += counts_[row];
  }
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    if (wanted[v] && counts[v] > 0)
      parameters->variances[v] = (squares[v] / counts[v]).cwiseMax(floor);
  }
}

void SharedSums::write(ModelFile* file) const {
  std::vector<double> steps;
  for (const MatrixD& one : transitions)
    steps.insert(steps.end(), one.data(), one.data() + one.size());
  std::vector<double> weights;
  for (const std::vector<double>& one : slots_)
    weights.insert(weights.end(), one.begin(), one.end());
  const auto vector = [](const std::vector<double>& all) {
    return VectorD(Eigen::Map<const VectorD>(all.data(), static_cast<Eigen::Index>(all.size())));
  };
  file->set_vector("transitions", vector(steps));
  file->set_vector("weights", vector(weights));
  file->set_vector("counts", counts_);
  file->set_matrix("firsts", ConstMatrixRefD(firsts_));
  file->set_matrix("seconds", ConstMatrixRefD(seconds_));
}

void SharedSums::add(const ModelFile& file) {
  const auto refuse = [&file](const char* field, const char* why) {
    fail(ErrorKind::format, file.name() + ": " + field + ": " + why);
  };
  const VectorD steps = file.vector_d("transitions");
  const VectorD weights = file.vector_d("weights");
  const VectorD counts = file.vector_d("counts");
  const MatrixD firsts = file.matrix_d("firsts");
  const MatrixD seconds = file.matrix_d("seconds");
  Eigen::Index num_steps = 0;
  for (const MatrixD& one : transitions) num_steps += one.size();
  Eigen::Index num_weights = 0;
  for (const std::vector<double>& one : slots_)
    num_weights += static_cast<Eigen::Index>(one.size());
  if (steps.size() != num_steps) refuse("transitions", "not as many as the models have");
  if (weights.size() != num_weights) refuse("weights", "not as many as the models have");
  if (counts.size() != counts_.size()) refuse("counts", "not as many as the models have");
  for (const auto& [field, matrix] :
       {std::pair{"firsts", &firsts}, std::pair{"seconds", &seconds}}) {
    if (matrix->rows() != firsts_.rows() || matrix->cols() != firsts_.cols())
      refuse(field, "not as many as the models have");
  }
  if (steps.minCoeff() < 0) refuse("transitions", "one is below 0");
  if (weights.minCoeff() < 0) refuse("weights", "one is below 0");
  if (counts.size() > 0 && counts.minCoeff() < 0) refuse("counts", "one is below 0");
  if (seconds.size() > 0 && seconds.minCoeff() < 0) refuse("seconds", "one is below 0");
  Eigen::Index at = 0;
  for (MatrixD& one : transitions) {
    one += Eigen::Map<const MatrixD>(steps.data() + at, one.rows(), one.cols());
    at += one.size();
  }
  at = 0;
  for (std::vector<double>& one : slots_) {
    for (double& weight : one) weight += weights[at++];
  }
  counts_ += counts;
  firsts_ += firsts;
  seconds_ += seconds;
}

}  // namespace hri::htk::detail
