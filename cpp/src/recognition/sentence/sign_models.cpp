// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/sign_models.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel_for.hpp"
#include "models/hmm/forward_backward.hpp"

namespace hri::detail {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kLeastStay = 0.05;
constexpr double kMostStay = 0.98;
constexpr double kPooledShare = 2.0 / 3;  // of a recording: what the variances of all words weigh
constexpr double kLeastVariance = 1e-8;
// Of a frame of a recording that is followed.
constexpr double kVariantStay = 0.33;
constexpr double kVariantSkip = 0.2;

// Sums over the frames of the states of a word.
struct SignSums {
  VectorD counts;
  MatrixD means;
  MatrixD squares;  // of the distances from the means
};

using Paths = std::vector<std::vector<int>>;

SignSums sums_of(const std::vector<MatrixF>& recordings, const Paths& paths, int num_states) {
  const Eigen::Index dim = recordings.front().cols();
  SignSums sums{VectorD::Zero(num_states), MatrixD::Zero(num_states, dim),
                MatrixD::Zero(num_states, dim)};
  const auto each_frame = [&](auto&& add) {
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      for (Eigen::Index t = 0; t < recordings[i].rows(); ++t)
        add(paths[i][static_cast<std::size_t>(t)], recordings[i].row(t).cast<double>());
    }
  };
  each_frame([&](int j, const auto& row) {
    sums.counts[j] += 1;
    sums.means.row(j) += row;
  });
  // A state that no recording reaches lies at the mean of all frames.
  const Eigen::RowVectorXd middle = sums.means.colwise().sum() / sums.counts.sum();
  for (int j = 0; j < num_states; ++j) {
    if (sums.counts[j] > 0) {
      sums.means.row(j) /= sums.counts[j];
    } else {
      sums.means.row(j) = middle;
      sums.counts[j] = 1;
    }
  }
  each_frame([&](int j, const auto& row) {
    sums.squares.row(j) += (row - sums.means.row(j)).cwiseAbs2();
  });
  return sums;
}

class ViterbiTrainer {
 public:
  ViterbiTrainer(const ClassSequences& words, const SentenceRecognizerOptions& options,
                 StopCheck should_stop)
      : words_(words), options_(options), should_stop_(std::move(should_stop)) {
    for (const std::vector<MatrixF>& recordings : words) {
      num_states_.push_back(num_states(recordings));
      Paths paths;
      for (const MatrixF& frames : recordings)
        paths.push_back(uniform_segmentation(frames.rows(), num_states_.back()));
      paths_.push_back(std::move(paths));
    }
  }

  SignModels run() {
    estimate();
    for (int i = 0; i < options_.max_iterations && align(); ++i) estimate();
    SignModels result;
    result.final_stays.resize(static_cast<Eigen::Index>(words_.size()));
    for (std::size_t c = 0; c < words_.size(); ++c) {
      const VectorD& stays = stays_[c];
      result.hmms.push_back(model(c));
      result.final_stays[static_cast<Eigen::Index>(c)] = stays[stays.size() - 1];
      add_variants(c, &result.variants);
    }
    return result;
  }

 private:
  [[nodiscard]] int num_states(const std::vector<MatrixF>& recordings) const {
    double frames = 0;
    for (const MatrixF& r : recordings) frames += static_cast<double>(r.rows());
    const double mean = frames / static_cast<double>(recordings.size());
    return std::clamp(static_cast<int>(std::lround(mean / options_.frames_per_state)),
                      std::min(2, options_.max_states), options_.max_states);
  }

  void estimate() {
    sums_.resize(words_.size());
    parallel_for(words_.size(), should_stop_, [&](std::size_t c, const StopCheck&) {
      sums_[c] = sums_of(words_[c], paths_[c], num_states_[c]);
    });
    Eigen::RowVectorXd pooled = Eigen::RowVectorXd::Zero(words_.front().front().cols());
    double free = 0;
    for (const SignSums& sums : sums_) {
      pooled += sums.squares.colwise().sum();
      free += (sums.counts.array() - 1).sum();
    }
    pooled = (pooled / std::max(free, 1.0)).cwiseMax(kLeastVariance);
    variances_.clear();
    stays_.clear();
    for (std::size_t c = 0; c < words_.size(); ++c) {
      const SignSums& sums = sums_[c];
      const auto num_recordings = static_cast<double>(words_[c].size());
      // Frames of one state are alike, so that it is recordings that count.
      const double prior = kPooledShare * sums.counts.sum() / (num_recordings * num_states_[c]);
      MatrixD variances = sums.squares.rowwise() + prior * pooled;
      variances.array().colwise() /= sums.counts.array() + prior;
      variances_.push_back(std::move(variances));
      stays_.emplace_back((1 - (sums.counts.array() / num_recordings).max(1.0).inverse())
                              .max(kLeastStay)
                              .min(kMostStay));
    }
  }

  // Whether any path has changed. A recording with fewer frames than states keeps its own.
  bool align() {
    std::vector<char> changed(words_.size(), 0);
    parallel_for(words_.size(), should_stop_, [&](std::size_t c, const StopCheck& stop) {
      for (std::size_t i = 0; i < words_[c].size(); ++i) {
        poll(stop);
        if (words_[c][i].rows() < num_states_[c]) continue;
        std::vector<int> path = best_path(c, words_[c][i]);
        if (path == paths_[c][i]) continue;
        paths_[c][i] = std::move(path);
        changed[c] = 1;
      }
    });
    return std::find(changed.begin(), changed.end(), 1) != changed.end();
  }

  // From the first state to the last one, none left out.
  [[nodiscard]] std::vector<int> best_path(std::size_t c, const MatrixF& frames) const {
    const int n = num_states_[c];
    const Eigen::Index num_frames = frames.rows();
    const Eigen::ArrayXd constants = -0.5 * variances_[c].array().log().rowwise().sum();
    const Eigen::ArrayXXd precisions = variances_[c].array().inverse();
    const Eigen::ArrayXd log_stay = stays_[c].array().log();
    const Eigen::ArrayXd log_go = (1 - stays_[c].array()).log();
    Eigen::ArrayXd best = Eigen::ArrayXd::Constant(n, kNever);
    Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> came(num_frames, n);
    for (Eigen::Index t = 0; t < num_frames; ++t) {
      const Eigen::RowVectorXd row = frames.row(t).cast<double>();
      const Eigen::ArrayXd emission =
          constants -
          0.5 * ((sums_[c].means.rowwise() - row).array().square() * precisions).rowwise().sum();
      if (t == 0) {
        best[0] = emission[0];
        came.row(0) = false;
        continue;
      }
      for (int j = n; j-- > 0;) {
        const double stayed = best[j] + log_stay[j];
        const double went = j > 0 ? best[j - 1] + log_go[j - 1] : kNever;
        came(t, j) = went > stayed;
        best[j] = std::max(stayed, went) + emission[j];
      }
    }
    std::vector<int> path(static_cast<std::size_t>(num_frames));
    int state = n - 1;
    for (Eigen::Index t = num_frames; t-- > 0;) {
      path[static_cast<std::size_t>(t)] = state;
      if (came(t, state)) --state;
    }
    return path;
  }

  [[nodiscard]] GaussianMixtureHmm model(std::size_t c) const {
    Topology topology;
    topology.num_states = num_states_[c];
    MatrixD transition = MatrixD::Zero(topology.num_states, topology.num_states);
    for (int j = 0; j + 1 < topology.num_states; ++j) {
      transition(j, j) = stays_[c][j];
      transition(j, j + 1) = 1 - stays_[c][j];
    }
    transition(topology.num_states - 1, topology.num_states - 1) = 1;
    return {MarkovChain(topology, initial_start(topology), std::move(transition)),
            MixtureBank(MatrixD::Ones(topology.num_states, 1), sums_[c].means, variances_[c])};
  }

  // Of more recordings than fit, those at equal distances.
  void add_variants(std::size_t c, std::vector<SignVariant>* variants) const {
    const std::size_t num_recordings = words_[c].size();
    std::size_t num_frames = 0;
    for (const MatrixF& r : words_[c]) num_frames += static_cast<std::size_t>(r.rows());
    const auto most = static_cast<std::size_t>(options_.max_variant_frames);
    const std::size_t num = std::min(num_recordings, most * num_recordings / num_frames);
    Eigen::Index left = kMostTransitions / static_cast<Eigen::Index>(words_.size());
    for (std::size_t i = 0; i < num; ++i) {
      const std::size_t r = i * num_recordings / num;
      const Eigen::Index length = words_[c][r].rows();
      if (length > kLongestVariant || length * length > left) continue;
      left -= length * length;
      variants->push_back({static_cast<int>(c), words_[c][r], paths_[c][r]});
    }
  }

  const ClassSequences& words_;
  const SentenceRecognizerOptions& options_;
  StopCheck should_stop_;
  std::vector<int> num_states_;
  std::vector<Paths> paths_;
  std::vector<SignSums> sums_;
  std::vector<MatrixD> variances_;
  std::vector<VectorD> stays_;
};

}  // namespace

SignModels train_sign_models(const ClassSequences& words, const SentenceRecognizerOptions& options,
                             const StopCheck& should_stop) {
  return ViterbiTrainer(words, options, should_stop).run();
}

GaussianMixtureHmm variant_model(const SignVariant& variant, const GaussianMixtureHmm& word,
                                 const SentenceRecognizerOptions& options) {
  const MixtureBank& bank = word.bank();
  const double weight = options.variant_weight;
  const Eigen::Index num_frames = variant.frames.rows();
  MatrixD means(num_frames, bank.dim());
  MatrixD variances(num_frames, bank.dim());
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    const int state = variant.states[static_cast<std::size_t>(t)];
    means.row(t) =
        (1 - weight) * bank.means().row(state) + weight * variant.frames.row(t).cast<double>();
    variances.row(t) = options.variant_variance * bank.variances().row(state);
  }
  Topology topology;
  topology.num_states = static_cast<int>(num_frames);
  return {MarkovChain::initial(topology),
          MixtureBank(MatrixD::Ones(num_frames, 1), std::move(means), std::move(variances))};
}

WordChain variant_chain(int num_states) {
  const double skip = std::log(kVariantSkip);
  const double go = std::log(1 - kVariantStay - kVariantSkip);
  WordChain chain{VectorD::Constant(num_states, kNever),
                  MatrixD::Constant(num_states, num_states, kNever),
                  VectorD::Constant(num_states, kNever)};
  chain.log_start[0] = std::log(1 - kVariantSkip);
  if (num_states > 1) chain.log_start[1] = skip;
  for (int j = 0; j < num_states; ++j) {
    chain.log_transition(j, j) = std::log(kVariantStay);
    if (j + 1 < num_states) chain.log_transition(j, j + 1) = go;
    if (j + 2 < num_states) chain.log_transition(j, j + 2) = skip;
  }
  chain.log_exit[num_states - 1] = std::log(1 - kVariantStay);
  if (num_states > 1) chain.log_exit[num_states - 2] = skip;
  return chain;
}

}  // namespace hri::detail
