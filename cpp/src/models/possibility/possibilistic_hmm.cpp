// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_hmm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/possibility/possibilistic_path.hpp"
#include "models/possibility/possibilistic_rule.hpp"
#include "models/possibility/possibility_tables.hpp"
#include "models/possibility/state_possibilities.hpp"

namespace hri {
namespace {

bool same_shape(const DiscreteHmm& a, const DiscreteHmm& b) {
  return detail::same_topology(a.chain().topology(), b.chain().topology()) &&
         a.num_symbols() == b.num_symbols();
}

}  // namespace

PossibilisticHmmSet::PossibilisticHmmSet(std::vector<DiscreteHmm> models,
                                         const PossibilisticRule& rule)
    : models_(std::move(models)), rule_(rule) {
  require(!models_.empty(), "a set needs at least one model");
  validate(rule_);
  largest_ = VectorD::Zero(num_symbols());
  for (const DiscreteHmm& m : models_) {
    require(same_shape(m, models_.front()),
            "all models of a set need the same topology and number of symbols");
    largest_ = largest_.cwiseMax(m.emission().colwise().maxCoeff().transpose());
  }
  tables_ = std::make_shared<const detail::PossibilityTables>(
      detail::PossibilityTables{{models_, largest_, detail::chain_rule<float>(rule_)}});
}

PossibilisticHmmSet PossibilisticHmmSet::with_class(DiscreteHmm model) const {
  std::vector<DiscreteHmm> models = models_;
  models.push_back(std::move(model));
  return PossibilisticHmmSet(std::move(models), rule_);
}

VectorF PossibilisticHmmSet::log_possibilities(Span<const std::int32_t> symbols) const {
  VectorF result(num_classes());
  log_possibilities(symbols, {result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

void PossibilisticHmmSet::log_possibilities(Span<const std::int32_t> symbols,
                                            Span<float> out) const {
  require(!symbols.empty(), "symbols must not be empty");
  require(out.size() == models_.size(), "out must have one value a class");
  detail::check_symbols(symbols, num_symbols());
  thread_local std::vector<double> scores;
  scores.resize(models_.size());
  tables_->scorer.score(symbols, scores.data());
  std::transform(scores.begin(), scores.end(), out.begin(),
                 [](double v) { return static_cast<float>(v); });
}

VectorD PossibilisticHmmSet::log_possibilities_exact(Span<const std::int32_t> symbols) const {
  require(!symbols.empty(), "symbols must not be empty");
  detail::check_symbols(symbols, num_symbols());
  const detail::SymbolScorer<double> scorer(models_, largest_, detail::chain_rule<double>(rule_));
  VectorD result(num_classes());
  scorer.score(symbols, result.data());
  return result;
}

Possibilities PossibilisticHmmSet::classify(Span<const std::int32_t> symbols) const {
  return possibilities(log_possibilities(symbols));
}

double PossibilisticHmmSet::viterbi(int class_index, Span<const std::int32_t> symbols,
                                    std::vector<int>* path) const {
  MatrixD log_b = log_emissions(class_index, symbols);
  return detail::most_possible_path(
      detail::possibility_chains(models_)[static_cast<std::size_t>(class_index)], rule_,
      std::move(log_b), path);
}

StatePossibilities PossibilisticHmmSet::state_possibilities(
    int class_index, Span<const std::int32_t> symbols) const {
  MatrixD log_b = log_emissions(class_index, symbols);
  return detail::state_possibilities(models_[static_cast<std::size_t>(class_index)].chain(),
                                     detail::ChainScale(detail::chains_of(models_)), rule_,
                                     std::move(log_b));
}

// Of one class, a row a symbol, after checking both arguments.
MatrixD PossibilisticHmmSet::log_emissions(int class_index,
                                           Span<const std::int32_t> symbols) const {
  check_class(class_index);
  require(!symbols.empty(), "symbols must not be empty");
  detail::check_symbols(symbols, num_symbols());
  const MatrixD& b = models_[static_cast<std::size_t>(class_index)].emission();
  MatrixD result(static_cast<Eigen::Index>(symbols.size()), num_states());
  for (std::size_t t = 0; t < symbols.size(); ++t) {
    const std::int32_t o = symbols[t];
    for (int j = 0; j < num_states(); ++j) {
      const double p = b(j, o) > 0 ? b(j, o) / largest_[o] : 0;
      result(static_cast<Eigen::Index>(t), j) = p > 0 ? std::log(p) : detail::kMinusInf;
    }
  }
  return result;
}

void PossibilisticHmmSet::check_class(int class_index) const {
  require(class_index >= 0 && class_index < num_classes(), "class_index out of range");
}

VectorD PossibilisticHmmSet::start(int class_index) const {
  check_class(class_index);
  return detail::possibility_chains(models_)[static_cast<std::size_t>(class_index)].start;
}

MatrixD PossibilisticHmmSet::transition(int class_index) const {
  check_class(class_index);
  return detail::possibility_chains(models_)[static_cast<std::size_t>(class_index)].transition(
      detail::join_of(rule_.conjunction));
}

MatrixD PossibilisticHmmSet::emission(int class_index) const {
  check_class(class_index);
  MatrixD result = models_[static_cast<std::size_t>(class_index)].emission();
  for (Eigen::Index o = 0; o < result.cols(); ++o) {
    if (largest_[o] > 0) result.col(o) /= largest_[o];
  }
  return result;
}

void PossibilisticHmmSet::write(ModelFile& file, const std::string& prefix) const {
  detail::write_rule(rule_, num_classes(), file, prefix);
  for (std::size_t c = 0; c < models_.size(); ++c)
    models_[c].write(file, prefix + std::to_string(c) + ".");
}

PossibilisticHmmSet PossibilisticHmmSet::read(const ModelFile& file, const std::string& prefix) {
  int num_classes = 0;
  const PossibilisticRule rule = detail::read_rule(file, prefix, &num_classes);
  std::vector<DiscreteHmm> models;
  // A class that is not there ends this, however large the number.
  for (int c = 0; c < num_classes; ++c) {
    const std::string name = prefix + std::to_string(c) + ".";
    models.push_back(DiscreteHmm::read(file, name));
    if (!same_shape(models.back(), models.front())) {
      fail(ErrorKind::format,
           file.name() + ": field '" + name + "emission': differs in shape from class 0");
    }
  }
  return PossibilisticHmmSet(std::move(models), rule);
}

}  // namespace hri
