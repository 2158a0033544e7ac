// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibilistic_rule.hpp"

#include <cstdint>
#include <limits>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

const char* rule_fault(const PossibilisticRule& rule) {
  if (!(rule.concentration >= 1 && rule.concentration <= 16))
    return "concentration must lie in 1..16";
  return nullptr;
}

}  // namespace

Join join_of(Conjunction conjunction) {
  if (conjunction == Conjunction::product) return Join::product;
  return conjunction == Conjunction::min ? Join::min : Join::max;
}

bool is_conditioned(const PossibilisticRule& rule) {
  return rule.conjunction == Conjunction::min && rule.conditioned;
}

void validate(const PossibilisticRule& rule) {
  const char* fault = rule_fault(rule);
  require(fault == nullptr, fault);
}

bool same_topology(const Topology& a, const Topology& b) {
  return a.kind == b.kind && a.num_states == b.num_states && a.max_jump == b.max_jump;
}

void write_rule(const PossibilisticRule& rule, int num_classes, ModelFile& file,
                const std::string& prefix) {
  file.set_integer(prefix + "conjunction", static_cast<std::int64_t>(rule.conjunction));
  file.set_integer(prefix + "conditioned", rule.conditioned ? 1 : 0);
  file.set_number(prefix + "concentration", rule.concentration);
  file.set_integer(prefix + "num_classes", num_classes);
}

PossibilisticRule read_rule(const ModelFile& file, const std::string& prefix, int* num_classes) {
  const auto field = [&](const char* name, std::int64_t low, std::int64_t high) {
    const std::int64_t value = file.integer(prefix + name);
    if (value < low || value > high) {
      fail(ErrorKind::format, file.name() + ": field '" + prefix + name +
                                  "' is out of range: " + std::to_string(value));
    }
    return value;
  };
  PossibilisticRule rule;
  rule.conjunction = static_cast<Conjunction>(field("conjunction", 0, 2));
  rule.conditioned = field("conditioned", 0, 1) == 1;
  rule.concentration = file.number(prefix + "concentration");
  if (const char* fault = rule_fault(rule))
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "concentration': " + fault);
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  *num_classes = static_cast<int>(field("num_classes", 1, kMost));
  return rule;
}

}  // namespace hri::detail
