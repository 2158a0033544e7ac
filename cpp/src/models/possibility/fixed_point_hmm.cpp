// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/fixed_point_hmm.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hri/core/error.hpp"
#include "models/possibility/possibility_tables.hpp"

namespace hri {
namespace {

// Resolution is worth having up to here; beyond it only the range would shrink.
constexpr double kMostUnits = 320;
// Every class is shifted back to one best value after so many frames, and its best path may lose
// this many steps in each of them; the rest of the range is left to the states behind it.
constexpr int kFramesBetweenShifts = 4;
constexpr double kFallOfFrame = 3200;
// What costs more (natural log) may exceed that: no path that uses such entries often is a best
// one.
constexpr double kDearTransition = 2;
constexpr double kDearEmission = 12;
// So that what the shifts add up to stays within 32 bits.
constexpr std::size_t kMostSymbols = 262144;

// The largest -log of what is possible at all.
double costliest(const MatrixD& possibilities) {
  double largest = 0;
  for (Eigen::Index i = 0; i < possibilities.size(); ++i) {
    const double p = possibilities.data()[i];
    if (p > 0) largest = std::max(largest, -std::log(p));
  }
  return largest;
}

}  // namespace

FixedPointHmmSet::FixedPointHmmSet(const PossibilisticHmmSet& set)
    : num_classes_(set.num_classes()), num_symbols_(set.num_symbols()) {
  require(set.rule().conjunction == Conjunction::product,
          "16-bit scores are of the product conjunction");
  double transition = 0;
  for (const detail::PossibilityChain& chain : detail::possibility_chains(set.models_)) {
    for (const MatrixD& part : {MatrixD(chain.start), chain.band, MatrixD(chain.leave)})
      transition = std::max(transition, costliest(part));
  }
  double emission = 0;
  for (int c = 0; c < num_classes_; ++c) emission = std::max(emission, costliest(set.emission(c)));
  const double fall = std::min(transition, kDearTransition) + std::min(emission, kDearEmission);
  units_ = std::min(kMostUnits, kFallOfFrame / std::max(fall, 1e-3));
  detail::ChainRule<std::int16_t> rule;
  rule.condition_every = kFramesBetweenShifts;
  scorer_ = std::make_shared<const detail::SymbolScorer<std::int16_t>>(set.models_, set.largest_,
                                                                       rule, units_);
}

VectorF FixedPointHmmSet::log_possibilities(Span<const std::int32_t> symbols) const {
  VectorF result(num_classes_);
  log_possibilities(symbols, {result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

void FixedPointHmmSet::log_possibilities(Span<const std::int32_t> symbols, Span<float> out) const {
  require(!symbols.empty() && symbols.size() <= kMostSymbols,
          "16-bit scores take 1..262144 symbols");
  require(out.size() == static_cast<std::size_t>(num_classes_), "out must have one value a class");
  detail::check_symbols(symbols, num_symbols_);
  thread_local std::vector<double> scores;
  scores.resize(out.size());
  scorer_->score(symbols, scores.data());
  const double step = 1 / units_;
  std::transform(scores.begin(), scores.end(), out.begin(),
                 [step](double v) { return static_cast<float>(v * step); });
}

}  // namespace hri
