// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the sets of possibility-theory HMMs share, whatever their emissions are.
#pragma once

#include <string>

#include "hri/io/model_file.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/possibility/possibility_kernel.hpp"

namespace hri::detail {

Join join_of(Conjunction conjunction);

/// Whether scores are conditioned, which only min is.
bool is_conditioned(const PossibilisticRule& rule);

template <class T>
ChainRule<T> chain_rule(const PossibilisticRule& rule) {
  ChainRule<T> result;
  result.join = join_of(rule.conjunction);
  if (!is_conditioned(rule)) return result;
  result.condition_every = 1;
  result.concentration = static_cast<T>(rule.concentration);
  return result;
}

bool same_topology(const Topology& a, const Topology& b);

/// The rule and the number of classes.
void write_rule(const PossibilisticRule& rule, int num_classes, ModelFile& file,
                const std::string& prefix);
PossibilisticRule read_rule(const ModelFile& file, const std::string& prefix, int* num_classes);

}  // namespace hri::detail
