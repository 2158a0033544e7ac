// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The forward recursion, frame by frame, in the cheapest arithmetic that loses nothing: scaled
// probabilities in double, in long double where that reaches further, and logs. A pass begins with
// the first and changes to the next when a probability comes close to where it would underflow.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/models/hmm/markov_chain.hpp"

namespace hri::detail {

class ForwardPass {
 public:
  enum class Arithmetic : std::uint8_t { scaled, extended, logs };

  /// Before the first frame. Allocates only where the chain is larger than all before.
  void reset(const MarkovChain& chain, Arithmetic first);

  /// One more frame. `b` holds the emission probabilities of the states, padded() with 0, `log_b`
  /// their logs; b is not read by passes that began in logs. The chain is the one of reset().
  template <class Scalar>
  void step(const MarkovChain& chain, const double* b, const Scalar* log_b);

  /// Room for the log densities of one frame, num_states values, for callers who have none.
  float* log_densities() { return log_densities_.data(); }

  /// log P(frames so far); 0 before the first.
  [[nodiscard]] double log_likelihood() const;

 private:
  // False: the step was not taken, as it wants wider arithmetic.
  bool step_scaled(const MarkovChain& chain, const double* b);
  bool step_extended(const MarkovChain& chain, const double* b);
  template <class Scalar>
  void step_logs(const MarkovChain& chain, const Scalar* log_b);
  void widen();
  void take_logs();

  int num_states_ = 0;
  Arithmetic arithmetic_ = Arithmetic::scaled;
  bool started_ = false;
  double sum_ = 1;             // scaled: of now_
  std::int64_t exponent_ = 0;  // probabilities are now_ times 2^exponent_
  AlignedVector now_;
  AlignedVector next_;
  AlignedVector scratch_;
  std::vector<float> log_densities_;
  std::vector<long double> wide_now_;
  std::vector<long double> wide_next_;
};

/// What a pass over these models may begin with, where `smallest` is the smallest product above 0
/// of a transition and an emission.
ForwardPass::Arithmetic first_arithmetic(double smallest);

}  // namespace hri::detail
