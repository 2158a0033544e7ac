// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The product recursion of possibility-theory HMMs in 16-bit integers: logs turn products into
// sums, so that additions and comparisons are all it takes. Twice the classes fit into a vector
// register, and floating point is used only to turn the final scores into natural logs.
#pragma once

#include <cstddef>
#include <memory>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"

namespace hri {

namespace detail {
template <class T>
class SymbolScorer;
}

/// Immutable; const calls are safe from several threads. Scores differ from the set's by rounding:
/// at most 1 / units() a frame, and less than its root on average. A possibility below
/// exp(-4095 / units()), but for 0, counts as that. A state that falls behind the best of its own
/// class by more than 16 bits hold (23100 steps, less what the class as a whole loses in four
/// frames) counts as impossible.
class HRI_API FixedPointHmmSet {
 public:
  /// Throws InvalidArgument unless the set's conjunction is product.
  explicit FixedPointHmmSet(const PossibilisticHmmSet& set);

  /// log possibility of the symbols under each class, shape (num_classes,), natural log; -inf for
  /// impossible.
  [[nodiscard]] VectorF log_possibilities(Span<const std::int32_t> symbols) const;
  /// The same into the caller's buffer (num_classes), without allocating.
  void log_possibilities(Span<const std::int32_t> symbols, Span<float> out) const;

  [[nodiscard]] int num_classes() const { return num_classes_; }
  [[nodiscard]] int num_symbols() const { return num_symbols_; }
  /// Integer steps in one natural-log unit.
  [[nodiscard]] double units() const { return units_; }

 private:
  int num_classes_ = 0;
  int num_symbols_ = 0;
  double units_ = 0;
  std::shared_ptr<const detail::SymbolScorer<std::int16_t>> scorer_;  // immutable
};

}  // namespace hri
