// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Random tables for the kernel of possibility-theory HMMs, and its recursion in plain loops, one
// class and state after the other; for integers with a check that no sum leaves 16 bits.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <vector>

#include "hri/core/random.hpp"
#include "models/possibility/possibility_chains.hpp"

namespace hri::testing_data {

using detail::Bounds16;
using detail::ChainBlock;
using detail::ChainRule;
using detail::Join;
using detail::Steps;

constexpr int kNumTableSymbols = 5;

template <class T>
constexpr bool kInteger = std::is_integral_v<T>;

// Sums are made in Wide, which holds all that could come out.
template <class T>
using Wide = std::conditional_t<kInteger<T>, std::int64_t, T>;

template <class T>
T impossible() {
  return kInteger<T> ? static_cast<T>(Bounds16::kImpossible) : -std::numeric_limits<T>::infinity();
}

template <class T>
T floor_of() {
  return kInteger<T> ? static_cast<T>(Bounds16::kFloor) : -std::numeric_limits<T>::infinity();
}

// Plain numbers, the bounds of what is possible, and the impossible.
template <class T>
T random_entry(Random* random) {
  const double kind = random->uniform();
  if (kind < 0.1) return impossible<T>();
  if (kind < 0.2) return static_cast<T>(kInteger<T> ? Bounds16::kLowestPossible : -700);
  if (kind < 0.3) return 0;
  const double share = random->uniform();
  return static_cast<T>(share * share * share * (kInteger<T> ? -4095 : -9));
}

// A block, all it points to, and the emissions.
template <class T>
struct Tables {
  ChainBlock<T> block;
  std::vector<int> offsets;
  std::vector<T> start, bands, leave, land, dense, emissions, levels;
  int margin = 0;

  [[nodiscard]] std::ptrdiff_t size() const {
    return static_cast<std::ptrdiff_t>(block.num_states) * block.num_lanes;
  }
  void point() {
    block.num_bands = static_cast<int>(offsets.size());
    block.offsets = offsets.data();
    block.bands = bands.data();
    block.leave = leave.empty() ? nullptr : leave.data();
    block.land = land.empty() ? nullptr : land.data();
    block.dense = dense.empty() ? nullptr : dense.data();
  }
  // Chains of several classes side by side, or one striped: the states of each, in order.
  [[nodiscard]] std::vector<std::vector<std::size_t>> chains() const {
    const auto rows = static_cast<std::size_t>(block.num_states);
    const auto lanes = static_cast<std::size_t>(block.num_lanes);
    std::vector<std::vector<std::size_t>> result(block.striped ? 1 : lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
      for (std::size_t j = 0; j < rows; ++j) result[block.striped ? 0 : l].push_back(j * lanes + l);
    }
    return result;
  }
};

template <class T>
std::vector<T> random_entries(std::ptrdiff_t count, Random* random) {
  std::vector<T> values(static_cast<std::size_t>(count));
  for (T& v : values) v = random_entry<T>(random);
  return values;
}

// Integers start as high as shifts will leave them; what cannot start is at the floor.
template <class T>
void raise_starts(Tables<T>* t) {
  if constexpr (kInteger<T>) {
    for (const auto& chain : t->chains()) {
      int best = Bounds16::kImpossible;
      for (const std::size_t x : chain) best = std::max<int>(best, t->start[x]);
      for (const std::size_t x : chain) {
        T& start = t->start[x];
        start = start == Bounds16::kImpossible ? static_cast<T>(Bounds16::kFloor)
                                               : static_cast<T>(start + Bounds16::kBest - best);
      }
    }
  }
}

enum class Structure { bands, jumps, dense };

template <class T>
Tables<T> any_structure(Structure structure, int num_states, int num_lanes,
                        const std::vector<int>& offsets, bool levels, Random* random) {
  Tables<T> t;
  t.block.num_states = num_states;
  t.block.num_lanes = num_lanes;
  t.start = random_entries<T>(t.size(), random);
  t.emissions = random_entries<T>(kNumTableSymbols * t.size(), random);
  if (levels) t.levels = random_entries<T>(kNumTableSymbols * num_lanes, random);
  for (T& v : t.levels) v = v > impossible<T>() ? v : 0;
  if (structure == Structure::dense) {
    t.dense = random_entries<T>(num_states * t.size(), random);
  } else {
    t.offsets = offsets;
    for (const int offset : offsets) t.margin = std::max(t.margin, std::abs(offset));
    t.bands = random_entries<T>(static_cast<std::ptrdiff_t>(offsets.size()) * t.size(), random);
  }
  if (structure == Structure::jumps) {
    t.leave = random_entries<T>(t.size(), random);
    t.land = random_entries<T>(t.size(), random);
    // In some classes nothing leaves.
    for (std::size_t x = 0; x < t.leave.size(); x += 3) t.leave[x] = impossible<T>();
  }
  raise_starts(&t);
  t.point();
  return t;
}

// Left-right without skips as PossibilityChains would have it: staying counts as emission, and with
// Steps::free going on is in the emissions too, as far as the largest shift.
template <class T>
Tables<T> left_right(Steps steps, bool striped, int num_rows, int num_lanes, Random* random) {
  Tables<T> t;
  t.block.num_states = num_rows;
  t.block.num_lanes = num_lanes;
  t.block.steps = steps;
  t.block.striped = striped;
  t.offsets = {0, 1};
  t.margin = 1;
  t.start = random_entries<T>(t.size(), random);
  t.emissions = random_entries<T>(kNumTableSymbols * t.size(), random);
  t.bands.assign(2 * static_cast<std::size_t>(t.size()), impossible<T>());
  const double most = kInteger<T> ? Bounds16::kLargestShift : 100;
  for (const auto& chain : t.chains()) {
    double g = 0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const std::size_t x = chain[i];
      T stay = random_entry<T>(random);
      if (!(stay > impossible<T>())) stay = 0;
      T go = random_entry<T>(random);
      if (kInteger<T> && go - stay > Bounds16::kLargestRise) go = stay;
      double shift = g + static_cast<double>(go) - static_cast<double>(stay);
      if (steps == Steps::free && !(std::abs(shift) <= most)) {
        go = stay;
        shift = g;
      }
      if (steps == Steps::free && i > 0) g = shift;
      t.bands[static_cast<std::size_t>(t.size()) + x] =
          go > impossible<T>() ? static_cast<T>(go - stay) : impossible<T>();
      for (std::size_t o = 0; o < kNumTableSymbols; ++o) {
        T& b = t.emissions[o * static_cast<std::size_t>(t.size()) + x];
        b = detail::sum_of_entries(b, stay);
      }
      if (t.start[x] > impossible<T>())
        t.start[x] =
            static_cast<T>(static_cast<double>(t.start[x]) - static_cast<double>(stay) - g);
    }
  }
  raise_starts(&t);
  t.point();
  return t;
}

template <class T>
struct Outcome {
  std::vector<T> phi;
  std::vector<double> scale;
};

// The recursion of one class, as possibility_kernel.hpp states it.
template <class T>
class Plain {
 public:
  Plain(const Tables<T>& tables, const ChainRule<T>& rule) : t_(tables), rule_(rule) {}

  Outcome<T> run(const std::vector<std::int32_t>& symbols) {
    const bool striped = t_.block.striped;
    Outcome<T> result{std::vector<T>(static_cast<std::size_t>(t_.size()), floor_of<T>()),
                      std::vector<double>(static_cast<std::size_t>(t_.block.num_lanes), 0.0)};
    const auto chains = t_.chains();
    for (std::size_t c = 0; c < chains.size(); ++c) {
      chain_ = chains[c];
      phi_.assign(chain_.size(), floor_of<T>());
      scale_ = 0;
      due_ = 0;
      const bool sweeps = t_.block.steps != Steps::as_given;
      const std::size_t n = symbols.size();
      for (std::size_t t = 0; t < n; ++t) {
        if (sweeps && !striped && kInteger<T> && begins_sweep(t, n)) {
          due_ = t == 1 ? T(0) : top();
          shift(due_);
        }
        step(symbols[t], t == 0);
        const auto every = static_cast<std::size_t>(rule_.condition_every);
        if (!sweeps && every > 0 && (t + 1) % every == 0) shift(top());
        if (sweeps && striped && every > 0 && t > 0 && (t % every == 0 || t + 1 == n)) shift(top());
        if (t_.levels.empty()) continue;
        scale_ += static_cast<double>(
            t_.levels[static_cast<std::size_t>(symbols[t] * t_.block.num_lanes) + c]);
      }
      for (std::size_t j = 0; j < chain_.size(); ++j)
        result.phi[chain_[j]] = static_cast<T>(phi_[j]);
      result.scale[c] = scale_;
    }
    return result;
  }

  static constexpr int kFrames = 4;  // of a sweep

 private:
  using W = Wide<T>;

  // Sweeps start after the first frame and take four frames, at the end one.
  static bool begins_sweep(std::size_t t, std::size_t n) {
    const std::size_t whole = (n - 1) / kFrames * kFrames;
    return t > 0 && (t - 1 >= whole || (t - 1) % kFrames == 0);
  }
  W sum(W a, W b) const {
    const W s = a + b;
    if constexpr (kInteger<T>) {
      EXPECT_GE(s, std::numeric_limits<T>::min());
      EXPECT_LE(s, std::numeric_limits<T>::max());
    }
    return s;
  }
  W join(W a, W b) const {
    if (rule_.join == Join::product) return sum(a, b);
    return rule_.join == Join::min ? std::min(a, b) : std::max(a, b);
  }
  W bounded(W v) const { return std::max(v, static_cast<W>(floor_of<T>())); }
  W emitted(W came, W b) const {
    const bool against = rule_.join == Join::min && b < 0;
    return bounded(join(against ? came * static_cast<W>(rule_.concentration) : came, b));
  }
  T top() const {
    const W best = *std::max_element(phi_.begin(), phi_.end());
    const W wanted = kInteger<T> ? Bounds16::kBest : 0;
    return best > static_cast<W>(floor_of<T>()) ? static_cast<T>(best - wanted) : T(0);
  }
  void shift(T by) {
    scale_ += static_cast<double>(by);
    for (W& v : phi_) {
      if (v > static_cast<W>(floor_of<T>())) v = sum(v, -static_cast<W>(by));
    }
  }
  W at(const std::vector<T>& values, std::size_t row, std::size_t j) const {
    return static_cast<W>(values[row * static_cast<std::size_t>(t_.size()) + chain_[j]]);
  }
  W came_to(std::size_t j) const {
    const auto n = static_cast<int>(phi_.size());
    W best = kInteger<T> ? std::numeric_limits<W>::lowest() : -std::numeric_limits<T>::infinity();
    if (t_.block.steps != Steps::as_given) {
      W comes = j == 0 ? static_cast<W>(floor_of<T>()) : phi_[j - 1];
      if (t_.block.steps == Steps::free_stay) comes = sum(comes, at(t_.bands, 1, j));
      return std::max(phi_[j], comes);
    }
    for (std::size_t k = 0; k < t_.offsets.size(); ++k) {
      const int i = static_cast<int>(j) - t_.offsets[k];
      const W from =
          i >= 0 && i < n ? phi_[static_cast<std::size_t>(i)] : static_cast<W>(floor_of<T>());
      best = std::max(best, join(from, at(t_.bands, k, j)));
    }
    if (!t_.leave.empty()) {
      W leaves = join(phi_[0], at(t_.leave, 0, 0));
      for (std::size_t i = 1; i < phi_.size(); ++i)
        leaves = std::max(leaves, join(phi_[i], at(t_.leave, 0, i)));
      best = std::max(best, join(bounded(leaves), at(t_.land, 0, j)));
    }
    for (std::size_t i = 0; !t_.dense.empty() && i < phi_.size(); ++i)
      best = std::max(best, join(phi_[i], at(t_.dense, i, j)));
    return best;
  }
  void step(std::int32_t symbol, bool first) {
    const auto o = static_cast<std::size_t>(symbol);
    std::vector<W> next(phi_.size());
    for (std::size_t j = 0; j < next.size(); ++j) {
      const bool sweeps = t_.block.steps != Steps::as_given;
      W came = first ? at(t_.start, 0, j) : came_to(j);
      if (!first && !sweeps) came = bounded(came);
      next[j] = emitted(came, at(t_.emissions, o, j));
    }
    phi_ = next;
  }

  const Tables<T>& t_;
  ChainRule<T> rule_;
  std::vector<std::size_t> chain_;
  std::vector<W> phi_;
  double scale_ = 0;
  T due_ = 0;
};

}  // namespace hri::testing_data
