// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scores of a set of possibility-theory HMMs while the symbols come in.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/hmm_stream.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"

namespace hri {

/// All classes are advanced together, one symbol at a time. Keeps what it needs of the set, which
/// may be gone before it. For one thread at a time.
class HRI_API PossibilisticHmmStream {
 public:
  /// Throws InvalidArgument for a beam that is not positive.
  explicit PossibilisticHmmStream(const PossibilisticHmmSet& set,
                                  const HmmStreamOptions& options = {});
  ~PossibilisticHmmStream();
  PossibilisticHmmStream(PossibilisticHmmStream&&) noexcept;
  PossibilisticHmmStream& operator=(PossibilisticHmmStream&&) noexcept;

  /// Allocates nothing. Throws InvalidArgument for an unknown symbol, and the stream stays as it
  /// was.
  void push(std::int32_t symbol);

  /// Log possibility of all symbols so far under each class, num_classes() values; 0 before the
  /// first symbol, -inf for impossible or dropped. Without a beam equal to
  /// PossibilisticHmmSet::log_possibilities.
  void log_possibilities(Span<float> out) const;

  /// The `count` best classes (all, if there are fewer), best first, the lower index where two are
  /// equal; classes at -inf are left out.
  [[nodiscard]] std::vector<int> nbest(int count) const;

  /// Ready for the next utterance.
  void reset();

  [[nodiscard]] int num_classes() const { return num_classes_; }
  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }
  /// Classes not dropped.
  [[nodiscard]] int num_active() const;

 private:
  struct State;
  void prune();

  int num_classes_ = 0;
  int num_symbols_ = 0;
  double beam_;
  std::int64_t num_frames_ = 0;
  std::shared_ptr<const detail::PossibilityTables> tables_;
  std::unique_ptr<State> state_;
};

}  // namespace hri
