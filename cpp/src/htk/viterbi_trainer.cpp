// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/viterbi_trainer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/codebook/codebook.hpp"
#include "htk/composite_pass.hpp"
#include "htk/embedded_sums.hpp"
#include "htk/shared_parameters.hpp"

namespace hri::htk {
namespace {

constexpr double kNoPath = -std::numeric_limits<double>::infinity();
constexpr double kWeightOfFloor = 1e-5;
constexpr double kPositiveVariance = 1e-10;  // of a column that is constant

std::size_t index_of(int number) { return static_cast<std::size_t>(number); }

const MacroDefinition& hmm_of(const ModelSet& models, const std::string& hmm) {
  const MacroDefinition* macro = models.find('h', hmm);
  if (macro == nullptr) fail(ErrorKind::invalid_argument, "there is no model '" + hmm + "'");
  return *macro;
}

int shortest_way(const MacroDefinition& macro) {
  const int frames = detail::LogChain(macro.hmm.transitions.values).min_frames;
  if (frames == detail::LogChain::kNoWay)
    fail(ErrorKind::invalid_argument, "no path leads through the model '" + macro.name + "'");
  return frames;
}

// The states of the best path, entry and exit not among them, and its log probability.
struct BestPath {
  std::vector<int> states;
  double log_probability = kNoPath;
};

BestPath best_path(const detail::LogChain& chain, const MatrixD& log_densities) {
  const auto frames = log_densities.rows();
  const int n = chain.num_states();
  std::vector<double> score(index_of(n));
  std::vector<double> next(index_of(n));
  std::vector<std::vector<int>> from(static_cast<std::size_t>(frames),
                                     std::vector<int>(index_of(n), -1));
  for (int j = 0; j < n; ++j) score[index_of(j)] = chain.start[index_of(j)] + log_densities(0, j);
  for (Eigen::Index t = 1; t < frames; ++t) {
    for (int j = 0; j < n; ++j) {
      double best = kNoPath;
      for (const detail::LogChain::Step& step : chain.previous[index_of(j)]) {
        const double candidate = score[index_of(step.state)] + step.log_weight;
        if (!(candidate > best)) continue;
        best = candidate;
        from[static_cast<std::size_t>(t)][index_of(j)] = step.state;
      }
      next[index_of(j)] = best + log_densities(t, j);
    }
    score.swap(next);
  }
  BestPath path;
  int last = -1;
  for (int j = 0; j < n; ++j) {
    const double candidate = score[index_of(j)] + chain.exit[index_of(j)];
    if (!(candidate > path.log_probability)) continue;
    path.log_probability = candidate;
    last = j;
  }
  if (last < 0) return path;
  path.states.resize(static_cast<std::size_t>(frames));
  for (auto t = static_cast<std::size_t>(frames); t-- > 0;) {
    path.states[t] = last;
    last = from[t][index_of(last)];
  }
  return path;
}

class ViterbiTrainer {
 public:
  ViterbiTrainer(const ModelSet& models, const std::string& hmm,
                 const std::vector<MatrixF>& recordings, const ViterbiTrainerOptions& options)
      : options_(validated(options)),
        recordings_(recordings),
        parameters_(models),
        floor_(detail::variance_floor(models, std::max(options.min_variance, kPositiveVariance))) {
    const int least = shortest_way(hmm_of(models, hmm));
    require(!recordings.empty(), "there is no recording to train on");
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      const std::string name = "recordings[" + std::to_string(r) + "]";
      if (recordings[r].cols() != models.vector_size)
        fail(ErrorKind::invalid_argument, name + " has another number of columns than the models");
      parameters_.require_frames(recordings[r], name);
      if (recordings[r].rows() < std::max(least, 1))
        fail(ErrorKind::invalid_argument, name + " is shorter than the model");
    }
    hmm_ = parameters_.hmms[index_of(parameters_.find(hmm))];
    marked_.assign(parameters_.states.size(), false);
    for (const int state : hmm_.states) marked_[index_of(state)] = true;
  }

  ViterbiTraining run(const ModelSet& models) {
    ViterbiTraining made;
    if (options_.uniform_start) start_from_equal_parts();
    for (int pass = 0; pass < options_.max_iterations && !made.converged; ++pass) {
      const double found = align();
      if (!made.log_probabilities.empty()) {
        const double gain = found - made.log_probabilities.back();
        made.converged = gain < options_.tolerance * static_cast<double>(recordings_.size());
      }
      made.log_probabilities.push_back(found);
    }
    made.models = parameters_.applied_to(models);
    return made;
  }

 private:
  // Equal parts of the recordings, one a state in the order of states, whatever their steps.
  void start_from_equal_parts() {
    const auto n = static_cast<Eigen::Index>(hmm_.states.size());
    std::vector<std::vector<std::pair<std::size_t, Eigen::Index>>> frames(
        parameters_.states.size());
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const Eigen::Index count = recordings_[r].rows();
      for (Eigen::Index t = 0; t < count; ++t) {
        const auto part = static_cast<std::size_t>(t * n / count);
        frames[index_of(hmm_.states[part])].emplace_back(r, t);
      }
    }
    detail::SharedSums sums(parameters_);
    for (std::size_t s = 0; s < frames.size(); ++s) {
      if (!frames[s].empty()) add_clusters(static_cast<int>(s), frames[s], &sums);
    }
    estimate(sums);
  }

  void add_clusters(int state, const std::vector<std::pair<std::size_t, Eigen::Index>>& frames,
                    detail::SharedSums* sums) const {
    MatrixF rows(static_cast<Eigen::Index>(frames.size()), recordings_.front().cols());
    for (std::size_t i = 0; i < frames.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = recordings_[frames[i].first].row(frames[i].second);
    const std::size_t slots = parameters_.states[index_of(state)].components.size();
    std::vector<std::int32_t> clusters(frames.size(), 0);
    if (slots == 0) {
      for (std::size_t i = 0; i < frames.size(); ++i)
        clusters[i] = static_cast<std::int32_t>(rows(static_cast<Eigen::Index>(i), 0)) - 1;
    } else if (slots > 1 && frames.size() > 1) {
      CodebookOptions options;
      options.num_codewords = static_cast<int>(std::min(slots, frames.size()));
      // Distances in units of the deviation of each column.
      const VectorF mean = rows.colwise().mean();
      const VectorF deviation =
          (rows.rowwise() - mean.transpose()).cwiseAbs2().colwise().mean().cwiseSqrt();
      const MatrixF scaled =
          (rows.rowwise() - mean.transpose()).array().rowwise() /
          deviation.transpose().array().max(std::numeric_limits<float>::min()).eval();
      clusters = Codebook::train_lbg(scaled, options).quantise(scaled);
    }
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const VectorD frame = rows.row(static_cast<Eigen::Index>(i)).transpose().cast<double>();
      sums->add(state, static_cast<std::size_t>(clusters[i]), frame, 1);
    }
  }

  // One pass along the best paths; gives their log probability before it.
  double align() {
    detail::SharedDensities densities(parameters_);
    detail::SharedSums sums(parameters_);
    const detail::LogChain chain(parameters_.transitions[index_of(hmm_.transitions)]);
    MatrixD& counts = sums.transitions[index_of(hmm_.transitions)];
    double total = 0;
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const MatrixD frames = recordings_[r].cast<double>();
      MatrixD log_densities(frames.rows(), chain.num_states());
      for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        for (int s = 0; s < chain.num_states(); ++s)
          log_densities(t, s) = densities.state(hmm_.states[index_of(s)], frames.row(t));
      }
      const BestPath path = best_path(chain, log_densities);
      if (path.states.empty())
        fail(ErrorKind::invalid_argument,
             "recordings[" + std::to_string(r) + "] has no path through the model");
      total += path.log_probability;
      int before = 0;
      for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        const int state = path.states[static_cast<std::size_t>(t)];
        counts(before, state + 1) += 1;
        before = state + 1;
        densities.state(hmm_.states[index_of(state)], frames.row(t));
        const auto& all = densities.components();
        const auto best = std::max_element(all.begin(), all.end()) - all.begin();
        sums.add(hmm_.states[index_of(state)],
                 densities.first_slot() + static_cast<std::size_t>(best), frames.row(t), 1);
      }
      counts(before, counts.cols() - 1) += 1;
    }
    estimate(sums);
    return total;
  }

  void estimate(const detail::SharedSums& sums) {
    detail::SharedParameters made = parameters_;
    if (options_.update_weights)
      sums.estimate_weights(marked_, options_.weight_floor * kWeightOfFloor, &made);
    if (options_.update_means) sums.estimate_means(marked_, &made);
    if (options_.update_variances) sums.estimate_variances(marked_, floor_, &made);
    if (options_.update_transitions) {
      const MatrixD& counts = sums.transitions[index_of(hmm_.transitions)];
      MatrixD& transitions = made.transitions[index_of(hmm_.transitions)];
      for (Eigen::Index i = 0; i + 1 < counts.rows(); ++i) {
        if (const double sum = counts.row(i).sum(); sum > 0)
          transitions.row(i) = counts.row(i) / sum;
      }
    }
    parameters_ = std::move(made);
  }

  ViterbiTrainerOptions options_;
  const std::vector<MatrixF>& recordings_;
  detail::SharedParameters parameters_;
  VectorD floor_;
  detail::SharedHmm hmm_;
  std::vector<bool> marked_;  // shared states that are the model's
};

}  // namespace

ViterbiTraining train_by_viterbi(const ModelSet& models, const std::string& hmm,
                                 const std::vector<MatrixF>& recordings,
                                 const ViterbiTrainerOptions& options) {
  return ViterbiTrainer(models, hmm, recordings, options).run(models);
}

int min_frames_of(const ModelSet& models, const std::string& hmm) {
  return shortest_way(hmm_of(models, hmm));
}

}  // namespace hri::htk
