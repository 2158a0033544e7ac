// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The recursion of possibility-theory HMMs for a block of classes side by side, in logs:
//   phi'(j) = pi_j(o) and max over i of (phi(i) and s_ij),  "and" being +, min or max.
// Every array below holds one value a state and class: state j of class `lane` stands at
// j * num_lanes + lane, so that a step from state to state is a shift by num_lanes, and one loop
// over contiguous values serves all states of all classes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hri/core/types.hpp"

namespace hri::detail {

enum class Join : std::uint8_t { product, min, max };

/// Left-right models without skips know two transitions, stay and go on. Staying costs nothing once
/// it is counted as part of the emission, and going on neither where values are shifted from state
/// to state (see possibility_chains.hpp).
enum class Steps : std::uint8_t {
  as_given,   ///< any structure
  free_stay,  ///< phi'(j) = pi_j(o) + max(phi(j), phi(j - 1) + bands(1, j))
  free,       ///< phi'(j) = pi_j(o) + max(phi(j), phi(j - 1))
};

/// Transitions of a block of classes; size = num_states * num_lanes.
template <class T>
struct ChainBlock {
  int num_states = 0;  ///< rows of the block
  int num_lanes = 0;
  int num_bands = 0;
  const int* offsets = nullptr;  ///< of each diagonal: from j - offset to j
  const T* bands = nullptr;      ///< (num_bands, size): s(j - offset, j)
  const T* leave = nullptr;      ///< (size), or nullptr without jumps: s_ij = leave(i) and land(j)
  const T* land = nullptr;       ///< (size)
  const T* dense = nullptr;      ///< (num_states, size): from i to j; then there are no bands
  Steps steps = Steps::as_given;
  /// One class takes the whole block: rows are R = num_states, and state j stands in row j % R,
  /// lane j / R. Only with free_stay or free.
  bool striped = false;
};

/// What 16-bit integers may hold. Values of the recursion lie between the floor, which is
/// impossible, and kMost; where a class is shifted its best value becomes kBest. kImpossible takes
/// any value to the floor or below, and the sum of any value and any entry of a table fits into 16
/// bits.
struct Bounds16 {
  static constexpr int kBest = 15500;
  static constexpr int kLargestRise = 2048;   ///< what going on may save compared with staying
  static constexpr int kLargestShift = 4096;  ///< from transitions into the values of one state
  static constexpr int kMost = kBest + kLargestRise;
  static constexpr int kFloor = -7600;
  static constexpr int kImpossible = kFloor - kMost;
  static constexpr int kLowestPossible = -4095;  ///< of one entry; two may add up
  static_assert(kFloor + kImpossible >= -32768 && kMost - 2 * kLowestPossible < 32768);
};

/// What was taken out of phi adds up in these.
template <class T>
struct ScaleOf {
  using Type = double;
};
template <>
struct ScaleOf<std::int16_t> {
  using Type = std::int32_t;
};

/// Where the recursion stands. `phi` and `next` have a margin of max |offset| states at either end
/// that holds impossible values.
template <class T>
struct ChainState {
  T* phi = nullptr;
  T* next = nullptr;
  T* lanes = nullptr;                          ///< scratch (num_lanes)
  typename ScaleOf<T>::Type* scale = nullptr;  ///< (num_lanes): taken out of phi so far
  std::int64_t num_frames = 0;                 ///< 0: the next frame is the first
};

/// How a recursion is run.
template <class T>
struct ChainRule {
  Join join = Join::product;
  /// After so many frames every class is shifted to a best value of 0; 0 for never.
  int condition_every = 0;
  /// min only, >= 1: what a state holds is multiplied by it (in logs, so that it counts for more
  /// against the state) at every frame that is not fully possible there.
  T concentration = 1;
  /// Integers: nothing falls below it, and what has fallen so far is impossible and stays so.
  T floor = 0;
};

/// Emissions of frames: those of frame t are rows + row_size * index[t], or rows + row_size * t
/// without an index. `levels`, if there are any, hold num_lanes values a row that go straight into
/// the score of each class.
template <class T>
struct FrameTable {
  const T* rows = nullptr;
  std::ptrdiff_t row_size = 0;
  const T* levels = nullptr;
  const std::int32_t* index = nullptr;
};

/// The loops for one instruction set.
template <class T>
struct ChainKernels {
  const char* name;
  /// Advances by `num_frames` frames. `start` (size) is joined with the first frame's emissions.
  /// Integers know the product alone.
  void (*advance)(const ChainBlock<T>& block, const ChainRule<T>& rule, const T* start,
                  const FrameTable<T>& frames, std::ptrdiff_t num_frames, ChainState<T>* state);
  /// The best of phi + ends of every lane, -inf where nothing is possible (`floor` as in the rule).
  void (*best_of_lanes)(const T* phi, const T* ends, int num_rows, int num_lanes, T floor, T* best);
};

/// Those that this machine can run, the best one last; all give the same bits. T is float, double
/// or std::int16_t.
template <class T>
Span<const ChainKernels<T>> chain_kernels();
/// The one to use.
template <class T>
const ChainKernels<T>& best_chain_kernels();

template <>
Span<const ChainKernels<float>> chain_kernels<float>();
template <>
Span<const ChainKernels<double>> chain_kernels<double>();
template <>
Span<const ChainKernels<std::int16_t>> chain_kernels<std::int16_t>();
template <>
const ChainKernels<float>& best_chain_kernels<float>();
template <>
const ChainKernels<double>& best_chain_kernels<double>();
template <>
const ChainKernels<std::int16_t>& best_chain_kernels<std::int16_t>();

template <class T>
void advance(const ChainBlock<T>& block, const ChainRule<T>& rule, const T* start,
             const FrameTable<T>& frames, std::ptrdiff_t num_frames, ChainState<T>* state) {
  best_chain_kernels<T>().advance(block, rule, start, frames, num_frames, state);
}

template <class T>
void best_of_lanes(const T* phi, const T* ends, int num_rows, int num_lanes, T floor, T* best) {
  best_chain_kernels<T>().best_of_lanes(phi, ends, num_rows, num_lanes, floor, best);
}

}  // namespace hri::detail
