// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/model_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

using hri::detail::kLog2Pi;

double gconst_of(const VectorD& variance) {
  return static_cast<double>(variance.size()) * kLog2Pi + variance.array().log().sum();
}

StateDefinition state_of(const MixtureBank& bank, int state) {
  StateDefinition definition;
  definition.num_mixtures = bank.num_mixtures();
  for (int m = 0; m < bank.num_mixtures(); ++m) {
    const Eigen::Index row = state * bank.num_mixtures() + m;
    WeightedComponent one;
    one.number = m + 1;
    one.weight = bank.weights()(state, m);
    one.component.mean.values = bank.means().row(row);
    one.component.variance.values = bank.variances().row(row);
    one.component.has_gconst = true;
    one.component.gconst = gconst_of(one.component.variance.values);
    definition.components.push_back(std::move(one));
  }
  return definition;
}

// The smallest band of steps to the right that holds the chain; ergodic where there is none.
Topology topology_of(const VectorD& start, const MatrixD& transition) {
  Topology topology;
  topology.num_states = static_cast<int>(start.size());
  topology.max_jump = 1;
  bool is_left_right = start[0] == 1;
  for (Eigen::Index i = 0; i < transition.rows(); ++i) {
    for (Eigen::Index j = 0; j < transition.cols(); ++j) {
      if (transition(i, j) == 0) continue;
      is_left_right = is_left_right && j >= i;
      topology.max_jump = std::max(topology.max_jump, static_cast<int>(j - i));
    }
  }
  topology.kind = is_left_right ? Topology::Kind::left_right : Topology::Kind::ergodic;
  return topology;
}

}  // namespace

const MacroDefinition* ModelSet::find(char type, const std::string& name) const {
  for (const MacroDefinition& macro : macros) {
    if (macro.type == type && macro.name == name) return &macro;
  }
  return nullptr;
}

std::vector<std::string> ModelSet::hmm_names() const {
  std::vector<std::string> names;
  for (const MacroDefinition& macro : macros) {
    if (macro.type == 'h') names.push_back(macro.name);
  }
  return names;
}

int ModelSet::num_codewords() const {
  for (const MacroDefinition& macro : macros) {
    if (macro.type == 's') return static_cast<int>(macro.state.discrete.size());
    if (macro.type == 'h' && !macro.hmm.states.empty())
      return static_cast<int>(macro.hmm.states.front().discrete.size());
  }
  return 0;
}

void ModelSet::add(const std::string& name, const GaussianMixtureHmm& model, double final_stay) {
  require(model.chain().topology().kind == Topology::Kind::left_right,
          "a model with an exit needs a left-right chain");
  require(final_stay >= 0 && final_stay < 1, "final_stay must lie in 0..1, 1 excluded");
  require(vector_size == 0 || vector_size == model.dim(), "the model has another dimension");
  require(num_codewords() == 0, "the other models are discrete");
  if (find('h', name) != nullptr)
    fail(ErrorKind::invalid_argument, "there is a model '" + name + "' already");
  MacroDefinition macro;
  macro.name = name;
  const int n = model.num_states();
  for (int s = 0; s < n; ++s) macro.hmm.states.push_back(state_of(model.bank(), s));
  MatrixD& values = macro.hmm.transitions.values;
  values = MatrixD::Zero(n + 2, n + 2);
  values.row(0).segment(1, n) = model.chain().start().transpose();
  values.block(1, 1, n, n) = model.chain().transition();
  values(n, n) = final_stay;
  values(n, n + 1) = 1 - final_stay;
  vector_size = model.dim();
  macros.push_back(std::move(macro));
}

void ModelSet::reorder(const std::vector<std::size_t>& order) {
  std::vector<bool> known(macros.size(), false);
  require(order.size() == macros.size(), "order must name every definition once");
  for (const std::size_t number : order) {
    require(number < macros.size() && !known[number], "order must name every definition once");
    known[number] = true;
  }
  std::vector<MacroDefinition> ordered;
  ordered.reserve(order.size());
  for (const std::size_t number : order) ordered.push_back(std::move(macros[number]));
  macros = std::move(ordered);
}

void ModelSet::rename_hmm(const std::string& hmm, const std::string& name) {
  if (hmm == name) return;
  if (find('h', name) != nullptr)
    fail(ErrorKind::invalid_argument, "there is a model '" + name + "' already");
  const auto found = std::find_if(macros.begin(), macros.end(), [&](const MacroDefinition& macro) {
    return macro.type == 'h' && macro.name == hmm;
  });
  if (found == macros.end()) fail(ErrorKind::invalid_argument, "there is no model '" + hmm + "'");
  found->name = name;
}

GaussianMixtureHmm to_hmm(const HmmDefinition& definition) {
  const auto n = static_cast<Eigen::Index>(definition.states.size());
  const MatrixD& values = definition.transitions.values;
  require(n > 0 && values.rows() == n + 2 && values.cols() == n + 2,
          "a model has another number of states than of transitions");
  VectorD start = values.row(0).segment(1, n);
  require(start.sum() > 0, "a model has no step from its entry");
  start /= start.sum();
  MatrixD transition = values.block(1, 1, n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sum = transition.row(i).sum();
    if (sum > 0) {
      transition.row(i) /= sum;
    } else {
      transition(i, i) = 1;
    }
  }
  std::size_t num_mixtures = 1;
  for (const StateDefinition& state : definition.states) {
    require(!state.components.empty(), "a discrete model has no Gaussians");
    num_mixtures = std::max(num_mixtures, state.components.size());
  }
  const Eigen::Index dim =
      definition.states.front().components.front().component.mean.values.size();
  const auto width = static_cast<Eigen::Index>(num_mixtures);
  MatrixD weights = MatrixD::Zero(n, width);
  MatrixD means = MatrixD::Zero(n * width, dim);
  MatrixD variances = MatrixD::Ones(n * width, dim);
  for (Eigen::Index s = 0; s < n; ++s) {
    Eigen::Index m = 0;
    for (const WeightedComponent& one : definition.states[static_cast<std::size_t>(s)].components) {
      require(
          one.component.mean.values.size() == dim && one.component.variance.values.size() == dim,
          "the vectors of a model have different sizes");
      weights(s, m) = one.weight;
      means.row(s * width + m) = one.component.mean.values;
      variances.row(s * width + m) = one.component.variance.values;
      ++m;
    }
    weights.row(s) /= weights.row(s).sum();
  }
  const Topology topology = topology_of(start, transition);
  return {MarkovChain(topology, std::move(start), std::move(transition)),
          MixtureBank(std::move(weights), std::move(means), std::move(variances))};
}

WordChain to_chain(const HmmDefinition& definition, double* log_skip) {
  const MatrixD logs = definition.transitions.values.array().log();
  const Eigen::Index n = logs.rows() - 2;
  require(n > 0, "a model has no state that emits");
  WordChain chain;
  chain.log_start = logs.row(0).segment(1, n);
  chain.log_transition = logs.block(1, 1, n, n);
  chain.log_exit = logs.col(n + 1).segment(1, n);
  *log_skip = logs(0, n + 1);
  return chain;
}

}  // namespace hri::htk
