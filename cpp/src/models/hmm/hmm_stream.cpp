// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/hmm_stream.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/hmm/forward_pass.hpp"

namespace hri {
namespace {

using detail::kMinusInf;

int width_of(const DiscreteHmm& model) { return model.num_symbols(); }
int width_of(const GaussianMixtureHmm& model) { return model.dim(); }

void validate_frame(const DiscreteHmm& model, std::int32_t symbol, std::int64_t position) {
  if (symbol >= 0 && symbol < model.num_symbols()) return;
  fail(ErrorKind::invalid_argument, "symbol " + std::to_string(symbol) + " at position " +
                                        std::to_string(position) + " lies outside 0.." +
                                        std::to_string(model.num_symbols() - 1));
}

void validate_frame(const GaussianMixtureHmm& model, Span<const float> frame,
                    std::int64_t position) {
  if (frame.size() != static_cast<std::size_t>(model.dim())) {
    fail(ErrorKind::invalid_argument, "frame " + std::to_string(position) + " has " +
                                          std::to_string(frame.size()) + " values, the model has " +
                                          std::to_string(model.dim()));
  }
  for (std::size_t d = 0; d < frame.size(); ++d) {
    if (std::isfinite(frame[d])) continue;
    fail(ErrorKind::invalid_argument,
         "frame " + std::to_string(position) + " is not finite at column " + std::to_string(d));
  }
}

}  // namespace

template <class Model>
struct HmmStream<Model>::State {
  std::vector<Model> models;
  double beam = 0;
  std::vector<detail::ForwardPass> passes;
  std::vector<int> active;     // indices of models not dropped
  std::vector<double> scores;  // of the active ones, where there is a beam
  std::int64_t num_frames = 0;

  void drop() {
    double best = kMinusInf;
    for (std::size_t a = 0; a < active.size(); ++a) {
      scores[a] = passes[static_cast<std::size_t>(active[a])].log_likelihood();
      best = std::max(best, scores[a]);
    }
    if (best == kMinusInf) return;
    std::size_t kept = 0;
    for (std::size_t a = 0; a < active.size(); ++a) {
      if (scores[a] >= best - beam) active[kept++] = active[a];
    }
    active.resize(kept);
  }
};

template <class Model>
HmmStream<Model>::HmmStream(std::vector<Model> models, const HmmStreamOptions& options)
    : state_(std::make_unique<State>()) {
  require(!models.empty(), "a stream needs at least one model");
  validate(options);
  for (const Model& model : models) {
    require(width_of(model) == width_of(models.front()),
            "all models of a stream need the same number of symbols or dimensions");
  }
  state_->models = std::move(models);
  state_->beam = options.beam;
  state_->passes.resize(state_->models.size());
  state_->scores.resize(state_->models.size());
  reset();
}

template <class Model>
HmmStream<Model>::HmmStream(HmmStream&&) noexcept = default;
template <class Model>
HmmStream<Model>& HmmStream<Model>::operator=(HmmStream&&) noexcept = default;
template <class Model>
HmmStream<Model>::~HmmStream() = default;

template <class Model>
void HmmStream<Model>::reset() {
  State& s = *state_;
  s.num_frames = 0;
  s.active.resize(s.models.size());
  for (std::size_t m = 0; m < s.models.size(); ++m) {
    s.active[m] = static_cast<int>(m);
    s.models[m].begin(&s.passes[m]);
  }
}

template <class Model>
void HmmStream<Model>::push(Frame frame) {
  State& s = *state_;
  validate_frame(s.models.front(), frame, s.num_frames);
  for (const int m : s.active) {
    const auto index = static_cast<std::size_t>(m);
    s.models[index].advance(&s.passes[index], frame);
  }
  ++s.num_frames;
  if (s.beam < std::numeric_limits<double>::infinity()) s.drop();
}

template <class Model>
void HmmStream<Model>::log_likelihoods(Span<double> out) const {
  require(out.size() == state_->models.size(), "out must have num_models() values");
  std::fill(out.begin(), out.end(), kMinusInf);
  for (const int m : state_->active) {
    const auto index = static_cast<std::size_t>(m);
    out[index] = state_->passes[index].log_likelihood();
  }
}

template <class Model>
std::vector<int> HmmStream<Model>::nbest(int count) const {
  require(count >= 1, "count must be at least 1");
  std::vector<double> scores(state_->models.size());
  log_likelihoods(scores);
  std::vector<int> best;
  for (std::size_t m = 0; m < scores.size(); ++m) {
    if (scores[m] > kMinusInf) best.push_back(static_cast<int>(m));
  }
  std::stable_sort(best.begin(), best.end(), [&](int a, int b) {
    return scores[static_cast<std::size_t>(a)] > scores[static_cast<std::size_t>(b)];
  });
  best.resize(std::min(best.size(), static_cast<std::size_t>(count)));
  return best;
}

template <class Model>
int HmmStream<Model>::num_models() const {
  return static_cast<int>(state_->models.size());
}

template <class Model>
int HmmStream<Model>::num_active() const {
  return static_cast<int>(state_->active.size());
}

template <class Model>
std::int64_t HmmStream<Model>::num_frames() const {
  return state_->num_frames;
}

template <class Model>
const Model& HmmStream<Model>::model(int index) const {
  require(index >= 0 && index < num_models(), "index of a model out of range");
  return state_->models[static_cast<std::size_t>(index)];
}

template class HmmStream<DiscreteHmm>;
template class HmmStream<GaussianMixtureHmm>;

}  // namespace hri
