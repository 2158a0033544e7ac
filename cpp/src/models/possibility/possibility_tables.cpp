// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibility_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {

std::vector<PossibilityChain> possibility_chains(const std::vector<DiscreteHmm>& models) {
  return scaled_together(chains_of(models));
}

void check_symbols(Span<const std::int32_t> symbols, int num_symbols) {
  for (std::size_t t = 0; t < symbols.size(); ++t) {
    if (symbols[t] >= 0 && symbols[t] < num_symbols) continue;
    fail(ErrorKind::invalid_argument, "symbol " + std::to_string(symbols[t]) + " at position " +
                                          std::to_string(t) + " lies outside 0.." +
                                          std::to_string(num_symbols - 1));
  }
}

template <class T>
SymbolScorer<T>::SymbolScorer(const std::vector<DiscreteHmm>& models, const VectorD& largest,
                              const ChainRule<T>& rule, double units)
    : chains_(possibility_chains(models), rule, units), num_symbols_(models.front().num_symbols()) {
  const ChainLayout& layout = chains_.layout();
  const auto size = static_cast<std::size_t>(layout.block_size());
  // Also where positions stand for no state: an entry takes any value down to the floor, which one
  // that is as low as the floor would not.
  emissions_.assign(static_cast<std::size_t>(layout.num_blocks * num_symbols_) * size,
                    from_log<T>(-std::numeric_limits<double>::infinity(), units));
  for (int c = 0; c < layout.num_classes; ++c) {
    const MatrixD& b = models[static_cast<std::size_t>(c)].emission();
    const int block = layout.block(c);
    for (int o = 0; o < num_symbols_; ++o) {
      T* row = emissions_.data() + static_cast<std::size_t>(block * num_symbols_ + o) * size;
      for (int j = 0; j < layout.num_states; ++j) {
        const int x = layout.position(c, j);
        // A symbol that no class ever emits says nothing: it is impossible for all.
        const double possibility = largest[o] > 0 ? b(j, o) / largest[o] : 0.0;
        row[x] = sum_of_entries(from_log<T>(std::log(possibility), units), chains_.shift(block)[x]);
      }
    }
  }
  if (rule.join == Join::min && rule.condition_every > 0) condition_symbols();
}

template <class T>
void SymbolScorer<T>::condition_symbols() {
  const ChainLayout& layout = chains_.layout();
  const T nothing = PossibilityChains<T>::impossible();
  levels_.assign(static_cast<std::size_t>(layout.num_blocks * num_symbols_) *
                     static_cast<std::size_t>(layout.num_lanes),
                 0);
  for (int r = 0; r < layout.num_blocks * num_symbols_; ++r) {
    T* row = emissions_.data() + static_cast<std::ptrdiff_t>(r) * layout.block_size();
    T* level = levels_.data() + static_cast<std::ptrdiff_t>(r) * layout.num_lanes;
    for (int l = 0; l < layout.num_lanes; ++l) {
      T top = nothing;
      for (int x = l; x < layout.block_size(); x += layout.num_lanes) top = std::max(top, row[x]);
      if (!(top > nothing)) continue;  // no state knows the symbol
      level[l] = top;
      for (int x = l; x < layout.block_size(); x += layout.num_lanes)
        row[x] = static_cast<T>(row[x] - top);
    }
  }
}

template <class T>
void SymbolScorer<T>::advance(int block, Span<const std::int32_t> symbols,
                              ChainWorkspace<T>* workspace) const {
  const ChainLayout& layout = chains_.layout();
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block) * num_symbols_;
  FrameTable<T> frames;
  frames.row_size = layout.block_size();
  frames.rows = emissions_.data() + first * frames.row_size;
  frames.levels = levels_.empty() ? nullptr : levels_.data() + first * layout.num_lanes;
  frames.index = symbols.data();
  chains_.advance(block, frames, static_cast<std::ptrdiff_t>(symbols.size()), workspace);
}

template <class T>
void SymbolScorer<T>::score(Span<const std::int32_t> symbols, double* out) const {
  thread_local ChainWorkspace<T> workspace;
  const ChainLayout& layout = chains_.layout();
  std::array<double, ChainLayout::kMaxLanes> scores;
  for (int block = 0; block < layout.num_blocks; ++block) {
    chains_.reset(block, &workspace);
    advance(block, symbols, &workspace);
    chains_.scores(block, workspace, scores.data());
    const int first = block * layout.classes_a_block();
    std::copy_n(scores.data(), std::min(layout.classes_a_block(), layout.num_classes - first),
                out + first);
  }
}

template class SymbolScorer<float>;
template class SymbolScorer<double>;
template class SymbolScorer<std::int16_t>;

}  // namespace hri::detail
