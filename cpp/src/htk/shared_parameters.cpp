// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/shared_parameters.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri::htk::detail {
namespace {

using hri::detail::kLog2Pi;

}  // namespace

SharedParameters::SharedParameters(const ModelSet& set) {
  for (const MacroDefinition& macro : set.macros) {
    switch (macro.type) {
      case 'h': {
        SharedHmm hmm;
        hmm.name = macro.name;
        for (const StateDefinition& state : macro.hmm.states)
          hmm.states.push_back(add(state.macro, state));
        hmm.transitions = add(macro.hmm.transitions.macro, macro.hmm.transitions);
        numbers_.push_back(static_cast<int>(hmms.size()));
        hmm_places_.emplace(macro.name, static_cast<int>(hmms.size()));
        hmms.push_back(std::move(hmm));
        break;
      }
      case 's':
        numbers_.push_back(add(macro.name, macro.state));
        break;
      case 'm':
        numbers_.push_back(add(macro.name, macro.component));
        break;
      case 'u':
        numbers_.push_back(add('u', macro.name, macro.vector.values, &means));
        break;
      case 'v':
        numbers_.push_back(add('v', macro.name, macro.vector.values, &variances));
        break;
      default:
        numbers_.push_back(add(macro.name, macro.transitions));
        break;
    }
  }
}

int SharedParameters::find(const std::string& hmm) const {
  const auto found = hmm_places_.find(hmm);
  return found == hmm_places_.end() ? -1 : found->second;
}

std::pair<int, bool> SharedParameters::place(char type, const std::string& macro,
                                             std::size_t next) {
  const auto number = static_cast<int>(next);
  if (macro.empty()) return {number, true};
  const auto [found, is_new] = places_.emplace(type + macro, number);
  return {found->second, is_new};
}

int SharedParameters::add(char type, const std::string& macro, const VectorD& values,
                          std::vector<VectorD>* all) {
  const auto [number, is_new] = place(type, macro, all->size());
  if (is_new) all->push_back(values);
  const VectorD& known = (*all)[static_cast<std::size_t>(number)];
  require(known.size() == values.size() && known == values, "the uses of a macro differ");
  return number;
}

int SharedParameters::add(const std::string& macro, const ComponentDefinition& definition) {
  const auto [number, is_new] = place('m', macro, components.size());
  if (!is_new) return number;
  components.emplace_back();
  components.back().mean = add('u', definition.mean.macro, definition.mean.values, &means);
  components.back().variance =
      add('v', definition.variance.macro, definition.variance.values, &variances);
  return number;
}

int SharedParameters::add(const std::string& macro, const StateDefinition& definition) {
  const auto [number, is_new] = place('s', macro, states.size());
  if (is_new) {
    SharedState state;
    for (const WeightedComponent& one : definition.components) {
      state.components.push_back(add(one.component.macro, one.component));
      state.weights.push_back(one.weight);
    }
    state.weights.insert(state.weights.end(), definition.discrete.begin(),
                         definition.discrete.end());
    states.push_back(std::move(state));
  }
  const SharedState& known = states[static_cast<std::size_t>(number)];
  const auto discrete = static_cast<std::size_t>(definition.discrete.size());
  require(!known.weights.empty() && known.components.size() == definition.components.size() &&
              known.weights.size() == definition.components.size() + discrete,
          "the uses of a macro differ");
  require(discrete == 0 || (definition.components.empty() &&
                            known.weights.size() == states.front().weights.size()),
          "a state has Gaussians and codewords, or another number of codewords");
  return number;
}

int SharedParameters::add(const std::string& macro, const TransitionDefinition& definition) {
  const auto [number, is_new] = place('t', macro, transitions.size());
  if (is_new) transitions.push_back(definition.values);
  const MatrixD& known = transitions[static_cast<std::size_t>(number)];
  require(known.rows() == definition.values.rows() && known == definition.values,
          "the uses of a macro differ");
  return number;
}

void SharedParameters::require_frames(ConstMatrixRefF frames, const std::string& what) const {
  if (!frames.allFinite())
    fail(ErrorKind::invalid_argument, what + " has values that are not finite");
  if (states.empty() || !states.front().components.empty()) return;
  const std::size_t num_codewords = states.front().weights.size();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const auto value = static_cast<double>(frames(t, 0));
    if (value == std::floor(value) && value >= 1 && value <= static_cast<double>(num_codewords))
      continue;
    fail(ErrorKind::invalid_argument, what + ": row " + std::to_string(t) +
                                          " is no codeword of the models, which have 1.." +
                                          std::to_string(num_codewords));
  }
}

ModelSet SharedParameters::applied_to(ModelSet set) const {
  require(set.macros.size() == numbers_.size(), "another set of models");
  for (std::size_t i = 0; i < set.macros.size(); ++i) {
    MacroDefinition& macro = set.macros[i];
    const auto number = static_cast<std::size_t>(numbers_[i]);
    switch (macro.type) {
      case 'h':
        for (std::size_t s = 0; s < macro.hmm.states.size(); ++s)
          put(hmms[number].states[s], &macro.hmm.states[s]);
        macro.hmm.transitions.values =
            transitions[static_cast<std::size_t>(hmms[number].transitions)];
        break;
      case 's':
        put(numbers_[i], &macro.state);
        break;
      case 'm':
        put(numbers_[i], &macro.component);
        break;
      case 'u':
        macro.vector.values = means[number];
        break;
      case 'v':
        macro.vector.values = variances[number];
        break;
      default:
        macro.transitions.values = transitions[number];
        break;
    }
  }
  return set;
}

void SharedParameters::put(int number, ComponentDefinition* definition) const {
  const SharedComponent& shared = components[static_cast<std::size_t>(number)];
  const VectorD& variance = variances[static_cast<std::size_t>(shared.variance)];
  definition->mean.values = means[static_cast<std::size_t>(shared.mean)];
  if (!definition->has_gconst || definition->variance.values != variance) {
    definition->gconst =
        static_cast<double>(variance.size()) * kLog2Pi + variance.array().log().sum();
  }
  definition->variance.values = variance;
  definition->has_gconst = true;
}

void SharedParameters::put(int number, StateDefinition* definition) const {
  const SharedState& shared = states[static_cast<std::size_t>(number)];
  if (shared.components.empty()) {
    definition->discrete = Eigen::Map<const VectorD>(
        shared.weights.data(), static_cast<Eigen::Index>(shared.weights.size()));
  }
  for (std::size_t c = 0; c < definition->components.size(); ++c) {
    definition->components[c].weight = shared.weights[c];
    put(shared.components[c], &definition->components[c].component);
  }
}

VectorD variance_floor(const ModelSet& set, double smallest) {
  VectorD floor = VectorD::Constant(set.vector_size, smallest);
  if (const MacroDefinition* macro = set.find('v', "varFloor1"); macro != nullptr) {
    require(macro->vector.values.size() == floor.size(),
            "~v \"varFloor1\" has another number of values than the models");
    floor = floor.cwiseMax(macro->vector.values);
  }
  return floor;
}

}  // namespace hri::htk::detail
