// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Transition possibilities of all classes of a set, laid out for possibility_kernel.hpp: classes
// stand side by side in blocks, so that the processor advances many of them in one instruction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"
#include "models/possibility/possibility_chain.hpp"
#include "models/possibility/possibility_kernel.hpp"

namespace hri::detail {

/// Where state j of class c stands. Blocks of several classes hold one class a lane; where classes
/// are few and states many, one class takes all lanes of a block, its states dealt out to them in
/// stripes (Farrar, Bioinformatics 23(2), 2007).
struct ChainLayout {
  static constexpr int kMaxLanes = 64;
  /// `stripe_lanes` 0: no stripes. Blocks have at most `most_lanes`.
  ChainLayout(int num_classes, int num_states, int stripe_lanes, int most_lanes);
  int num_classes;
  int num_states;
  bool striped;
  int num_lanes;  ///< of a block; the last lanes of the last block may stand for no class
  int num_rows;
  int num_blocks;
  [[nodiscard]] int classes_a_block() const { return striped ? 1 : num_lanes; }
  [[nodiscard]] int block(int c) const { return c / classes_a_block(); }
  [[nodiscard]] int position(int c, int j) const {
    return striped ? j % num_rows * num_lanes + j / num_rows : j * num_lanes + c % num_lanes;
  }
  [[nodiscard]] int block_size() const { return num_rows * num_lanes; }
};

/// A table entry. Integers stand for logs in steps of 1 / units.
template <class T>
T from_log(double log_value, double units);
template <>
float from_log<float>(double log_value, double units);
template <>
double from_log<double>(double log_value, double units);
template <>
std::int16_t from_log<std::int16_t>(double log_value, double units);

/// The sum of two table entries.
template <class T>
T sum_of_entries(T a, T b);

/// Buffers of one recursion over one block.
template <class T>
class ChainWorkspace {
 public:
  /// Ready for the first frame. Allocates only where the buffers are too small. Sweeps need no
  /// margin, and write everything at the first frame.
  void reset(const ChainLayout& layout, int margin, T impossible, bool sweeps);
  ChainState<T> state;

 private:
  std::vector<T> values_;
  std::vector<typename ScaleOf<T>::Type> scale_;
};

template <class T>
class PossibilityChains {
 public:
  /// All chains have one topology. `rule.floor` is set here. `units` is used by integers only.
  PossibilityChains(const std::vector<PossibilityChain>& chains, const ChainRule<T>& rule,
                    double units = 1);

  [[nodiscard]] const ChainLayout& layout() const { return layout_; }

  /// What emission log possibilities have to be changed by before they are given to `advance`,
  /// state by state, because some transitions were shifted into them; (block_size) of each block.
  [[nodiscard]] const T* shift(int block) const { return at(shifts_, block); }

  void reset(int block, ChainWorkspace<T>* workspace) const;
  /// Frames of one block, see possibility_kernel.hpp.
  void advance(int block, const FrameTable<T>& frames, std::ptrdiff_t num_frames,
               ChainWorkspace<T>* workspace) const;
  /// Log possibility of every class of the block (classes_a_block values) after the frames so far,
  /// in the unit of T.
  void scores(int block, const ChainWorkspace<T>& workspace, double* out) const;
  /// Makes a class impossible from here on.
  void drop(int c, ChainWorkspace<T>* workspace) const;

  /// What is as low as this is impossible.
  static T impossible();

 private:
  [[nodiscard]] const T* at(const std::vector<T>& values, int block) const {
    return values.data() + static_cast<std::ptrdiff_t>(block) * layout_.block_size();
  }
  void tabulate_bands(const std::vector<PossibilityChain>& chains, double units);
  void tabulate_dense(const std::vector<PossibilityChain>& chains, double units);
  void free_the_steps();
  void shift_starts();
  [[nodiscard]] std::size_t lanes() const { return static_cast<std::size_t>(layout_.num_lanes); }

  ChainLayout layout_;
  ChainRule<T> rule_;
  int margin_ = 0;
  Steps steps_ = Steps::as_given;
  std::vector<int> offsets_;
  std::vector<T> starts_;
  std::vector<typename ScaleOf<T>::Type>
      scales_;            // (num_blocks, num_lanes): before the first frame
  std::vector<T> bands_;  // (num_blocks, num_bands, block_size)
  std::vector<T> leaves_;
  std::vector<T> lands_;
  std::vector<T> dense_;   // (num_blocks, num_states, block_size)
  std::vector<T> shifts_;  // added to emissions
  std::vector<T> ends_;    // added to phi where scores are read
};

}  // namespace hri::detail
