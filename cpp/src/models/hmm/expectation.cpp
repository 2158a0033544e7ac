// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/expectation.hpp"

#include <algorithm>
#include <array>

#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/log_steps.hpp"
#include "models/hmm/mixture_training.hpp"

namespace hri::detail {
namespace {

constexpr std::size_t kSideBySide = kLogPasses;

bool fits(const MarkovChain& chain) {
  return chain.num_states() <= kLanes && chain.by_one()[kStay] != nullptr;
}

// The first row of a forward pass.
void start(const MarkovChain& chain, const double* log_b, double* alpha) {
  const int n = chain.num_states();
  std::fill_n(alpha, kLanes, kMinusInf);
  for (int j = 0; j < n; ++j) alpha[j] = chain.log_start()[j] + log_b[j];
}

double log_total(const LogPass& pass, int num_states) {
  const double* last = pass.alpha + (pass.num_frames - 1) * pass.alpha_stride;
  return log_sum(0, num_states, [&](int i) { return last[i]; });
}

// A sequence on its way through the model.
class Passage {
 public:
  Passage(const GaussianMixtureHmm& model, const ByOneRows& chain) : model_(model), chain_(chain) {}

  LogPass begin(const MatrixF& frames) {
    const std::ptrdiff_t num_frames = frames.rows();
    for (PaddedMatrix* matrix : {&log_b_, &alpha_, &after_, &beta_, &gamma_})
      matrix->resize(num_frames, kLanes);
    shares_.resize(num_frames, model_.bank().means().rows());
    const int n = model_.num_states();
    for (std::ptrdiff_t t = 0; t < num_frames && n < kLanes; ++t)
      std::fill(log_b_.row(t) + n, log_b_.row(t) + kLanes, 0.0);
    const bool mixed = model_.bank().num_mixtures() > 1;
    log_densities_of_finite(model_.bank(), frames, log_b_.row(0), kLanes,
                            mixed ? shares_.row(0) : nullptr, shares_.stride());
    start(model_.chain(), log_b_.row(0), alpha_.row(0));
    std::fill_n(beta_.row(num_frames - 1), kLanes, kMinusInf);
    std::fill_n(beta_.row(num_frames - 1), n, 0.0);
    pass_ = {chain_.data(), log_b_.row(0), num_frames,  alpha_.row(0),
             kLanes,        after_.row(0), beta_.row(0)};
    return pass_;
  }

  double end(const MatrixF& frames, ChainCounts* counts, MixtureAccumulator* accumulator) {
    const MarkovChain& chain = model_.chain();
    const int n = chain.num_states();
    const double total = log_total(pass_, n);
    if (total == kMinusInf) return total;
    StepSums sums;
    if (dense_kernels().posteriors(pass_, total, gamma_.row(0), &sums)) {
      for (int i = 0; i < n; ++i) {
        counts->band(i, i) += chain.band()(i, i) * sums.stay[i];
        if (i + 1 < n) counts->band(i, i + 1) += chain.band()(i, i + 1) * sums.go[i];
        counts->start[i] += gamma_.row(0)[i];
      }
    } else {
      forward_backward(chain, {log_b_.row(0), kLanes, frames.rows(), nullptr}, gamma_.row(0),
                       kLanes, counts);
    }
    accumulator->add(frames, {gamma_.row(0), kLanes, shares_.row(0), shares_.stride()});
    return total;
  }

 private:
  const GaussianMixtureHmm& model_;
  const ByOneRows& chain_;
  LogPass pass_;
  PaddedMatrix log_b_, alpha_, after_, beta_, gamma_, shares_;
};

double add_side_by_side(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences,
                        const StopCheck& should_stop, ChainCounts* counts,
                        MixtureAccumulator* accumulator) {
  const ByOneRows chain = model.chain().by_one();
  std::vector<Passage> passages(std::min(kSideBySide, sequences.size()), Passage(model, chain));
  std::array<LogPass, kSideBySide> passes;
  double total = 0;
  for (std::size_t first = 0; first < sequences.size(); first += kSideBySide) {
    const std::size_t count = std::min(kSideBySide, sequences.size() - first);
    for (std::size_t c = 0; c < count; ++c) {
      poll(should_stop);
      passes[c] = passages[c].begin(sequences[first + c]);
    }
    dense_kernels().forward_logs(passes.data(), static_cast<int>(count));
    dense_kernels().backward_logs(passes.data(), static_cast<int>(count));
    for (std::size_t c = 0; c < count; ++c)
      total += passages[c].end(sequences[first + c], counts, accumulator);
  }
  return total;
}

}  // namespace

double add_expectations(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences,
                        const StopCheck& should_stop, ChainCounts* counts,
                        MixtureAccumulator* accumulator) {
  if (fits(model.chain()))
    return add_side_by_side(model, sequences, should_stop, counts, accumulator);
  const int n = model.num_states();
  MatrixD densities;
  MatrixD shares;
  MatrixD gamma;
  double total = 0;
  for (const MatrixF& s : sequences) {
    poll(should_stop);
    densities.resize(s.rows(), n);
    shares.resize(s.rows(), model.bank().means().rows());
    log_densities_of_finite(model.bank(), s, densities.data(), n, shares.data(), shares.cols());
    gamma.resize(s.rows(), n);
    total += forward_backward(model.chain(), rows_of(densities), gamma.data(), n, counts);
    accumulator->add(s, gamma, shares);
  }
  return total;
}

VectorF log_likelihoods(const std::vector<GaussianMixtureHmm>& models, ConstMatrixRefF frames) {
  VectorF result(static_cast<Eigen::Index>(models.size()));
  const std::ptrdiff_t num_frames = frames.rows();
  thread_local std::vector<float> densities;
  thread_local AlignedVector log_b;
  const auto size = static_cast<std::size_t>(num_frames * kLanes);
  std::size_t c = 0;
  while (c < models.size()) {
    std::array<LogPass, kSideBySide> passes;
    std::array<ByOneRows, kSideBySide> chains;
    alignas(64) std::array<std::array<double, kLanes>, kSideBySide> alpha;
    std::size_t count = 0;
    for (; count < kSideBySide && c + count < models.size(); ++count) {
      const GaussianMixtureHmm& model = models[c + count];
      const int n = model.num_states();
      if (num_frames == 0 || !fits(model.chain())) break;
      if (densities.size() < size) densities.resize(size);
      if (log_b.size() < kSideBySide * size) log_b.resize(kSideBySide * size);
      const Eigen::Map<MatrixF> of_model(densities.data(), num_frames, n);
      model.bank().log_densities(frames, of_model);
      double* rows = log_b.data() + count * size;
      for (std::ptrdiff_t t = 0; t < num_frames; ++t) {
        for (int j = 0; j < n; ++j) rows[t * kLanes + j] = static_cast<double>(of_model(t, j));
        std::fill(rows + t * kLanes + n, rows + (t + 1) * kLanes, 0.0);
      }
      chains[count] = model.chain().by_one();
      start(model.chain(), rows, alpha[count].data());
      passes[count] = {
          chains[count].data(), rows, num_frames, alpha[count].data(), 0, nullptr, nullptr};
    }
    if (count == 0) {
      result[static_cast<Eigen::Index>(c)] = static_cast<float>(models[c].log_likelihood(frames));
      ++c;
      continue;
    }
    dense_kernels().forward_logs(passes.data(), static_cast<int>(count));
    for (std::size_t i = 0; i < count; ++i, ++c) {
      result[static_cast<Eigen::Index>(c)] =
          static_cast<float>(log_total(passes[i], models[c].num_states()));
    }
  }
  return result;
}

}  // namespace hri::detail
