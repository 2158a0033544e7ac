// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/possibility/possibility_tables.hpp"

namespace hri {
namespace {

using detail::kMinusInf;
// Scores are read, which costs about as much as a frame, after so many frames.
constexpr int kPruneEvery = 4;

using Scores = std::array<double, detail::ChainLayout::kMaxLanes>;

}  // namespace

struct PossibilisticHmmStream::State {
  std::vector<detail::ChainWorkspace<float>> blocks;
  std::vector<char> block_active;
  std::vector<char> class_active;
  std::vector<double> scores;  // scratch, num_classes
};

PossibilisticHmmStream::PossibilisticHmmStream(const PossibilisticHmmSet& set,
                                               const HmmStreamOptions& options)
    : num_classes_(set.num_classes()),
      num_symbols_(set.num_symbols()),
      beam_(options.beam),
      tables_(set.tables_),
      state_(std::make_unique<State>()) {
  validate(options);
  state_->blocks.resize(static_cast<std::size_t>(tables_->scorer.num_blocks()));
  state_->scores.resize(static_cast<std::size_t>(num_classes_));
  reset();
}

PossibilisticHmmStream::~PossibilisticHmmStream() = default;
PossibilisticHmmStream::PossibilisticHmmStream(PossibilisticHmmStream&&) noexcept = default;
PossibilisticHmmStream& PossibilisticHmmStream::operator=(PossibilisticHmmStream&&) noexcept =
    default;

void PossibilisticHmmStream::reset() {
  for (std::size_t b = 0; b < state_->blocks.size(); ++b)
    tables_->scorer.chains().reset(static_cast<int>(b), &state_->blocks[b]);
  state_->block_active.assign(state_->blocks.size(), 1);
  state_->class_active.assign(static_cast<std::size_t>(num_classes_), 1);
  num_frames_ = 0;
}

void PossibilisticHmmStream::push(std::int32_t symbol) {
  detail::check_symbols({&symbol, 1}, num_symbols_);
  for (std::size_t b = 0; b < state_->blocks.size(); ++b) {
    if (state_->block_active[b] != 0)
      tables_->scorer.advance(static_cast<int>(b), {&symbol, 1}, &state_->blocks[b]);
  }
  ++num_frames_;
  if (std::isfinite(beam_) && num_frames_ % kPruneEvery == 0) prune();
}

void PossibilisticHmmStream::prune() {
  const detail::PossibilityChains<float>& chains = tables_->scorer.chains();
  const int num_lanes = chains.layout().classes_a_block();
  std::vector<double>& scores = state_->scores;
  Scores lanes{};
  double best = kMinusInf;
  for (std::size_t b = 0; b < state_->blocks.size(); ++b) {
    if (state_->block_active[b] == 0) continue;
    chains.scores(static_cast<int>(b), state_->blocks[b], lanes.data());
    const int first = static_cast<int>(b) * num_lanes;
    for (int l = 0; l < std::min(num_lanes, num_classes_ - first); ++l) {
      scores[static_cast<std::size_t>(first) + static_cast<std::size_t>(l)] =
          lanes[static_cast<std::size_t>(l)];
      best = std::max(best, lanes[static_cast<std::size_t>(l)]);
    }
  }
  for (std::size_t b = 0; b < state_->blocks.size(); ++b) {
    if (state_->block_active[b] == 0) continue;
    const int first = static_cast<int>(b) * num_lanes;
    state_->block_active[b] = 0;
    for (int l = 0; l < std::min(num_lanes, num_classes_ - first); ++l) {
      const auto c = static_cast<std::size_t>(first) + static_cast<std::size_t>(l);
      if (state_->class_active[c] == 0) continue;
      if (scores[c] >= best - beam_) {
        state_->block_active[b] = 1;
        continue;
      }
      state_->class_active[c] = 0;
      chains.drop(first + l, &state_->blocks[b]);
    }
  }
}

void PossibilisticHmmStream::log_possibilities(Span<float> out) const {
  require(out.size() == static_cast<std::size_t>(num_classes_), "out must have one value a class");
  if (num_frames_ == 0) {
    std::fill(out.begin(), out.end(), 0.0F);
    return;
  }
  const detail::PossibilityChains<float>& chains = tables_->scorer.chains();
  const int num_lanes = chains.layout().classes_a_block();
  Scores lanes{};
  for (std::size_t b = 0; b < state_->blocks.size(); ++b) {
    chains.scores(static_cast<int>(b), state_->blocks[b], lanes.data());
    const int first = static_cast<int>(b) * num_lanes;
    for (int l = 0; l < std::min(num_lanes, num_classes_ - first); ++l) {
      const auto c = static_cast<std::size_t>(first) + static_cast<std::size_t>(l);
      const double score =
          state_->class_active[c] != 0 ? lanes[static_cast<std::size_t>(l)] : kMinusInf;
      out[c] = static_cast<float>(score);
    }
  }
}

std::vector<int> PossibilisticHmmStream::nbest(int count) const {
  require(count >= 1, "count must be at least 1");
  std::vector<float> scores(static_cast<std::size_t>(num_classes_));
  log_possibilities(scores);
  const auto score = [&scores](int c) { return scores[static_cast<std::size_t>(c)]; };
  std::vector<int> ranked;
  for (int c = 0; c < num_classes_; ++c) {
    if (score(c) > -std::numeric_limits<float>::infinity()) ranked.push_back(c);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&score](int a, int b) { return score(a) > score(b); });
  if (ranked.size() > static_cast<std::size_t>(count))
    ranked.resize(static_cast<std::size_t>(count));
  return ranked;
}

int PossibilisticHmmStream::num_active() const {
  return static_cast<int>(
      std::count(state_->class_active.begin(), state_->class_active.end(), char{1}));
}

}  // namespace hri
