// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibilistic_rule.hpp"

#include <cstdint>
#include <limits>

#include "hri/core/error.hpp"
#include "io/option_fields.hpp"

namespace hri::detail {
Join join_of(Conjunction conjunction) {
  if (conjunction == Conjunction::product) return Join::product;
  return conjunction == Conjunction::min ? Join::min : Join::max;
}

bool is_conditioned(const PossibilisticRule& rule) {
  return rule.conjunction == Conjunction::min && rule.conditioned;
}

bool same_topology(const Topology& a, const Topology& b) {
  return a.kind == b.kind && a.num_states == b.num_states && a.max_jump == b.max_jump;
}

void write_rule(const PossibilisticRule& rule, int num_classes, ModelFile& file,
                const std::string& prefix) {
  write_options(rule, file, prefix);
  file.set_integer(prefix + "num_classes", num_classes);
}

PossibilisticRule read_rule(const ModelFile& file, const std::string& prefix, int* num_classes) {
  PossibilisticRule rule;
  read_options(file, &rule, prefix);
  const std::int64_t count = file.integer(prefix + "num_classes");
  if (count < 1 || count > std::numeric_limits<std::int32_t>::max()) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix +
                                "num_classes' is out of range: " + std::to_string(count));
  }
  *num_classes = static_cast<int>(count);
  return rule;
}

}  // namespace hri::detail
