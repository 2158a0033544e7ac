// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibility_chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace hri::detail {
namespace {

constexpr int kAligned = 16;  // lanes of a block come in multiples of this
// Fewer classes than this leave too many lanes empty, unless states are so few that it is no loss.
constexpr int kFewClasses = 4;
constexpr int kFewStates = 8;

// As many rows as the kernel can keep in registers, where that is enough.
int striped_rows(int num_states, int num_lanes) {
  const int rows = (num_states + num_lanes - 1) / num_lanes;
  if (rows > 4 && rows <= 8) return 8;
  return rows > 8 && rows <= 16 ? 16 : rows;
}

// Left-right, no skips, and every state can be stayed in.
bool only_stays_and_goes(const std::vector<PossibilityChain>& chains, Join join) {
  const Topology& topology = chains.front().topology;
  return join == Join::product && topology.kind == Topology::Kind::left_right &&
         topology.max_jump == 1 && topology.num_states > 1 &&
         std::all_of(chains.begin(), chains.end(),
                     [](const PossibilityChain& c) { return c.band.diagonal().minCoeff() > 0; });
}

// What going on to state j saves compared with staying there, in steps; integers can hold so much.
bool rises_fit(const std::vector<PossibilityChain>& chains, double units) {
  for (const PossibilityChain& c : chains) {
    for (Eigen::Index j = 1; j < c.band.rows(); ++j) {
      const double go = from_log<std::int16_t>(std::log(c.band(j - 1, j)), units);
      const double stay = from_log<std::int16_t>(std::log(c.band(j, j)), units);
      if (go - stay > Bounds16::kLargestRise) return false;
    }
  }
  return true;
}

template <class T>
bool can_sweep(const std::vector<PossibilityChain>& chains, Join join, double units) {
  return only_stays_and_goes(chains, join) && (!std::is_integral_v<T> || rises_fit(chains, units));
}

template <class T>
ChainLayout layout_of(const std::vector<PossibilityChain>& chains, Join join, double units) {
  constexpr int kRegister = 64;
  // Two registers a row: while one waits for what its last frames came to, the other goes on.
  constexpr int kMostLanes = std::max(32, 2 * kRegister / static_cast<int>(sizeof(T)));
  static_assert(kMostLanes <= ChainLayout::kMaxLanes);
  return {static_cast<int>(chains.size()), chains.front().topology.num_states,
          can_sweep<T>(chains, join, units) ? kRegister / static_cast<int>(sizeof(T)) : 0,
          kMostLanes};
}

}  // namespace

ChainLayout::ChainLayout(int classes, int states, int stripe_lanes, int most_lanes)
    : num_classes(classes),
      num_states(states),
      striped(stripe_lanes > 0 && classes < kFewClasses && states > kFewStates) {
  if (striped) {
    num_lanes = stripe_lanes;
  } else if (stripe_lanes == 0 && classes < kFewClasses) {
    num_lanes = classes;
  } else {
    num_lanes = std::min(most_lanes, (classes + kAligned - 1) / kAligned * kAligned);
  }
  num_rows = striped ? striped_rows(states, num_lanes) : states;
  num_blocks = striped ? classes : (classes + num_lanes - 1) / num_lanes;
}

template <>
float from_log<float>(double log_value, double) {
  return static_cast<float>(log_value);
}
template <>
double from_log<double>(double log_value, double) {
  return log_value;
}
template <>
std::int16_t from_log<std::int16_t>(double log_value, double units) {
  if (!(log_value > -std::numeric_limits<double>::infinity())) return Bounds16::kImpossible;
  const double lowest = Bounds16::kLowestPossible;
  return static_cast<std::int16_t>(std::max(std::round(log_value * units), lowest));
}

template <class T>
T sum_of_entries(T a, T b) {
  if constexpr (std::is_integral_v<T>) {
    if (a == Bounds16::kImpossible || b == Bounds16::kImpossible) return Bounds16::kImpossible;
  }
  return static_cast<T>(a + b);
}
template float sum_of_entries<float>(float, float);
template double sum_of_entries<double>(double, double);
template std::int16_t sum_of_entries<std::int16_t>(std::int16_t, std::int16_t);

template <class T>
T PossibilityChains<T>::impossible() {
  if constexpr (std::is_integral_v<T>) return Bounds16::kFloor;
  return -std::numeric_limits<T>::infinity();
}

template <class T>
void ChainWorkspace<T>::reset(const ChainLayout& layout, int margin, T impossible, bool sweeps) {
  const auto size = static_cast<std::size_t>(layout.block_size());
  const auto lanes = static_cast<std::size_t>(layout.num_lanes);
  const std::size_t edge = static_cast<std::size_t>(margin) * lanes;
  const std::size_t total = 2 * (size + 2 * edge) + lanes;
  if (sweeps) {
    values_.resize(total);
  } else {
    values_.assign(total, impossible);
  }
  scale_.resize(lanes);
  state.phi = values_.data() + edge;
  state.next = state.phi + size + 2 * edge;
  state.lanes = state.next + size + edge;
  state.scale = scale_.data();
  state.num_frames = 0;
}

template <class T>
PossibilityChains<T>::PossibilityChains(const std::vector<PossibilityChain>& chains,
                                        const ChainRule<T>& rule, double units)
    : layout_(layout_of<T>(chains, rule.join, units)), rule_(rule) {
  rule_.floor = impossible();
  const auto total =
      static_cast<std::size_t>(layout_.num_blocks) * static_cast<std::size_t>(layout_.block_size());
  const T nothing = from_log<T>(-std::numeric_limits<double>::infinity(), units);
  starts_.assign(total, nothing);
  shifts_.assign(total, 0);
  ends_.assign(total, 0);
  const auto fill = [&](const VectorD PossibilityChain::*member, std::vector<T>* out) {
    out->assign(total, nothing);
    for (int c = 0; c < layout_.num_classes; ++c) {
      const VectorD& values = chains[static_cast<std::size_t>(c)].*member;
      T* block = out->data() + static_cast<std::ptrdiff_t>(layout_.block(c)) * layout_.block_size();
      for (int j = 0; j < layout_.num_states; ++j)
        block[layout_.position(c, j)] = from_log<T>(std::log(values[j]), units);
    }
  };
  fill(&PossibilityChain::start, &starts_);
  if (chains.front().topology.kind == Topology::Kind::rank_one_plus_band) {
    fill(&PossibilityChain::leave, &leaves_);
    fill(&PossibilityChain::land, &lands_);
  }
  if (chains.front().topology.kind == Topology::Kind::ergodic) {
    tabulate_dense(chains, units);
  } else {
    tabulate_bands(chains, units);
    if (can_sweep<T>(chains, rule.join, units)) free_the_steps();
  }
  shift_starts();
}

template <class T>
void PossibilityChains<T>::tabulate_bands(const std::vector<PossibilityChain>& chains,
                                          double units) {
  const Topology& topology = chains.front().topology;
  const int reach = std::min(topology.max_jump, topology.num_states - 1);
  for (int d = topology.kind == Topology::Kind::left_right ? 0 : -reach; d <= reach; ++d)
    offsets_.push_back(d);
  margin_ = reach;
  const auto num_bands = static_cast<std::ptrdiff_t>(offsets_.size());
  bands_.assign(static_cast<std::size_t>(layout_.num_blocks * num_bands * layout_.block_size()),
                from_log<T>(-std::numeric_limits<double>::infinity(), units));
  for (int c = 0; c < layout_.num_classes; ++c) {
    const MatrixD& s = chains[static_cast<std::size_t>(c)].band;
    for (std::ptrdiff_t k = 0; k < num_bands; ++k) {
      T* diagonal = bands_.data() + (layout_.block(c) * num_bands + k) * layout_.block_size();
      for (int j = 0; j < layout_.num_states; ++j) {
        const int i = j - offsets_[static_cast<std::size_t>(k)];
        if (i >= 0 && i < layout_.num_states)
          diagonal[layout_.position(c, j)] = from_log<T>(std::log(s(i, j)), units);
      }
    }
  }
}

template <class T>
void PossibilityChains<T>::tabulate_dense(const std::vector<PossibilityChain>& chains,
                                          double units) {
  const std::ptrdiff_t n = layout_.num_states;
  dense_.assign(static_cast<std::size_t>(layout_.num_blocks * n * layout_.block_size()),
                from_log<T>(-std::numeric_limits<double>::infinity(), units));
  for (int c = 0; c < layout_.num_classes; ++c) {
    const MatrixD& s = chains[static_cast<std::size_t>(c)].band;
    for (int i = 0; i < n; ++i) {
      T* to = dense_.data() + (layout_.block(c) * n + i) * layout_.block_size();
      for (int j = 0; j < n; ++j)
        to[layout_.position(c, j)] = from_log<T>(std::log(s(i, j)), units);
    }
  }
}

// With only "stay" and "go on", staying counts as part of the emission:
//   phi'(j) = (pi_j + stay_j) + max(phi(j), phi(j - 1) + go_j - stay_j).
// And with g(j) = g(j - 1) + go_j - stay_j, phi(j) - g(j) obeys the same recursion without any
// transition, if all of them are possible (and, for integers, g stays small). Both are exact.
template <class T>
void PossibilityChains<T>::free_the_steps() {
  const auto fits = [](double shift) {
    return std::isfinite(shift) &&
           (!std::is_integral_v<T> || std::abs(shift) <= Bounds16::kLargestShift);
  };
  bool all_fit = true;
  std::vector<T> shifted = starts_;
  for (int c = 0; c < layout_.num_classes; ++c) {
    const std::ptrdiff_t base =
        static_cast<std::ptrdiff_t>(layout_.block(c)) * layout_.block_size();
    const T* stay = bands_.data() + 2 * base;
    T* go = bands_.data() + 2 * base + layout_.block_size();
    double g = 0;
    for (int j = 0; j < layout_.num_states; ++j) {
      const int x = layout_.position(c, j);
      const auto at = static_cast<std::size_t>(base + x);
      shifts_[at] = stay[x];
      const bool goes = go[x] > impossible();
      if (goes) go[x] = static_cast<T>(go[x] - stay[x]);
      if (j > 0)
        g = goes ? g + static_cast<double>(go[x]) : -std::numeric_limits<double>::infinity();
      all_fit = all_fit && fits(g);
      if (fits(g)) ends_[at] = static_cast<T>(g);
      if (!(starts_[at] > impossible())) continue;
      starts_[at] = static_cast<T>(starts_[at] - stay[x]);
      if (fits(g)) shifted[at] = static_cast<T>(static_cast<double>(starts_[at]) - g);
    }
  }
  steps_ = all_fit ? Steps::free : Steps::free_stay;
  if (all_fit) {
    starts_ = std::move(shifted);
  } else {
    ends_.assign(ends_.size(), 0);
  }
}

// Integers begin as high as shifts will leave them, which gives the most room below.
template <class T>
void PossibilityChains<T>::shift_starts() {
  scales_.assign(static_cast<std::size_t>(layout_.num_blocks) * lanes(), 0);
  if constexpr (std::is_integral_v<T>) {
    const auto start = [this](int c, int j) -> T& {
      const auto size = static_cast<std::size_t>(layout_.block_size());
      return starts_[static_cast<std::size_t>(layout_.block(c)) * size +
                     static_cast<std::size_t>(layout_.position(c, j))];
    };
    for (int c = 0; c < layout_.num_classes; ++c) {
      int best = Bounds16::kImpossible;
      for (int j = 0; j < layout_.num_states; ++j) best = std::max<int>(best, start(c, j));
      if (best == Bounds16::kImpossible) continue;
      const int shift = Bounds16::kBest - best;
      for (int j = 0; j < layout_.num_states; ++j) {
        if (start(c, j) != Bounds16::kImpossible) start(c, j) = static_cast<T>(start(c, j) + shift);
      }
      const int lane = layout_.striped ? 0 : c % layout_.num_lanes;
      scales_[static_cast<std::size_t>(layout_.block(c)) * lanes() +
              static_cast<std::size_t>(lane)] = -shift;
    }
    std::replace(starts_.begin(), starts_.end(), static_cast<T>(Bounds16::kImpossible),
                 static_cast<T>(Bounds16::kFloor));
  }
}

template <class T>
void PossibilityChains<T>::reset(int block, ChainWorkspace<T>* workspace) const {
  workspace->reset(layout_, margin_, impossible(), steps_ != Steps::as_given);
  std::copy_n(scales_.data() + static_cast<std::size_t>(block) * lanes(), lanes(),
              workspace->state.scale);
}

template <class T>
void PossibilityChains<T>::advance(int block, const FrameTable<T>& frames,
                                   std::ptrdiff_t num_frames, ChainWorkspace<T>* workspace) const {
  ChainBlock<T> chains;
  chains.num_states = layout_.num_rows;
  chains.num_lanes = layout_.num_lanes;
  chains.num_bands = static_cast<int>(offsets_.size());
  chains.offsets = offsets_.data();
  const std::ptrdiff_t size = layout_.block_size();
  chains.bands = bands_.data() + block * chains.num_bands * size;
  chains.leave = leaves_.empty() ? nullptr : at(leaves_, block);
  chains.land = lands_.empty() ? nullptr : at(lands_, block);
  chains.dense = dense_.empty() ? nullptr : dense_.data() + block * layout_.num_rows * size;
  chains.steps = steps_;
  chains.striped = layout_.striped;
  detail::advance(chains, rule_, at(starts_, block), frames, num_frames, &workspace->state);
}

template <class T>
void PossibilityChains<T>::scores(int block, const ChainWorkspace<T>& workspace,
                                  double* out) const {
  const ChainState<T>& state = workspace.state;
  std::array<T, ChainLayout::kMaxLanes> best;
  best_of_lanes(state.phi, at(ends_, block), layout_.num_rows, layout_.num_lanes, impossible(),
                best.data());
  constexpr double kMinusInf = -std::numeric_limits<double>::infinity();
  if (layout_.striped) best[0] = *std::max_element(best.begin(), best.begin() + layout_.num_lanes);
  for (std::size_t l = 0; l < static_cast<std::size_t>(layout_.classes_a_block()); ++l) {
    const bool possible = best[l] > std::numeric_limits<T>::lowest();
    out[l] =
        possible ? static_cast<double>(best[l]) + static_cast<double>(state.scale[l]) : kMinusInf;
  }
}

template <class T>
void PossibilityChains<T>::drop(int c, ChainWorkspace<T>* workspace) const {
  for (int j = 0; j < layout_.num_states; ++j)
    workspace->state.phi[layout_.position(c, j)] = impossible();
}

template class ChainWorkspace<float>;
template class ChainWorkspace<double>;
template class ChainWorkspace<std::int16_t>;
template class PossibilityChains<float>;
template class PossibilityChains<double>;
template class PossibilityChains<std::int16_t>;

}  // namespace hri::detail
