// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/few_samples.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/least_variance.hpp"
#include "models/possibility/possibilistic_rule.hpp"

namespace hri {
namespace {

// The mean variance inside the states of all known classes, feature by feature.
Eigen::RowVectorXd pooled_variance(const std::vector<GaussianMixtureHmm>& known) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(known.front().dim());
  double num_states = 0;
  for (const GaussianMixtureHmm& model : known) {
    const MixtureBank& bank = model.bank();
    const Eigen::Index k = bank.num_mixtures();
    for (Eigen::Index j = 0; j < bank.num_states(); ++j) {
      const Eigen::RowVectorXd weights = bank.weights().row(j);
      const MatrixD means = bank.means().middleRows(j * k, k);
      const Eigen::RowVectorXd mean = weights * means;
      sum += weights * (bank.variances().middleRows(j * k, k) + means.cwiseAbs2());
      sum -= mean.cwiseAbs2();
    }
    num_states += bank.num_states();
  }
  sum /= num_states;
  return sum.cwiseMax(detail::least_variance(VectorD::Zero(sum.size()), sum.transpose(), 1e-10));
}

// Recordings that weigh as much as the known classes, for the variance of a state and for the
// symbols that it emits.
constexpr double kVarianceRecordings = 2;
constexpr double kSymbolRecordings = 10;

// Sums over the frames of every state, one Gaussian each.
struct StateSums {
  VectorD counts;
  MatrixD sums;
  MatrixD squares;

  StateSums(int num_states, Eigen::Index dim)
      : counts(VectorD::Zero(num_states)),
        sums(MatrixD::Zero(num_states, dim)),
        squares(MatrixD::Zero(num_states, dim)) {}

  void add(const MatrixD& frames, const MatrixD& gamma) {
    counts += gamma.colwise().sum().transpose();
    sums += gamma.transpose() * frames;
    squares += gamma.transpose() * frames.cwiseAbs2();
  }

  // The bank; states that were not visited keep the means of `previous`.
  [[nodiscard]] MixtureBank estimate(const MatrixD& previous, const Eigen::RowVectorXd& pooled,
                                     double num_recordings) const {
    MatrixD means = previous;
    MatrixD variances = pooled.replicate(sums.rows(), 1);
    for (Eigen::Index j = 0; j < sums.rows(); ++j) {
      if (counts[j] < 1e-8) continue;
      means.row(j) = sums.row(j) / counts[j];
      const Eigen::RowVectorXd own =
          (squares.row(j) / counts[j] - means.row(j).cwiseAbs2()).cwiseMax(0.0);
      variances.row(j) = (kVarianceRecordings * pooled + num_recordings * own) /
                         (kVarianceRecordings + num_recordings);
    }
    return {MatrixD::Ones(sums.rows(), 1), std::move(means), std::move(variances)};
  }
};

// Every state has an equal part of every sequence.
MixtureBank first_bank(const std::vector<MatrixD>& sequences, int num_states,
                       const Eigen::RowVectorXd& pooled, double num_recordings) {
  StateSums sums(num_states, pooled.size());
  for (const MatrixD& frames : sequences) {
    MatrixD gamma = MatrixD::Zero(frames.rows(), num_states);
    const std::vector<int> states = detail::uniform_segmentation(frames.rows(), num_states);
    for (std::size_t t = 0; t < states.size(); ++t)
      gamma(static_cast<Eigen::Index>(t), states[t]) = 1;
    sums.add(frames, gamma);
  }
  // A sequence shorter than the states skips some: these begin at the mean of all.
  const MatrixD middle = (sums.sums.colwise().sum() / sums.counts.sum()).replicate(num_states, 1);
  return sums.estimate(middle, pooled, num_recordings);
}

template <class Model>
void check_known(const std::vector<Model>& known) {
  require(!known.empty(), "known must have at least one model");
  const Topology& topology = known.front().chain().topology();
  require(topology.kind == Topology::Kind::left_right, "the known models must be left-right");
  for (const Model& model : known) {
    require(detail::same_topology(model.chain().topology(), topology),
            "the known models need one topology");
  }
}

}  // namespace

GaussianMixtureHmm train_few(const std::vector<GaussianMixtureHmm>& known,
                             const std::vector<MatrixF>& sequences,
                             const FewSampleOptions& options) {
  validate(options);
  check_known(known);
  for (const GaussianMixtureHmm& model : known)
    require(model.dim() == known.front().dim(), "the known models need one dimension");
  const int n = known.front().num_states();
  const Eigen::Index dim = known.front().dim();
  if (global_statistics(sequences).mean.size() != dim) {  // names what is not finite
    fail(ErrorKind::invalid_argument, "the sequences have " +
                                          std::to_string(sequences.front().cols()) +
                                          " columns, the known models " + std::to_string(dim));
  }
  std::vector<MatrixD> frames;
  frames.reserve(sequences.size());
  for (const MatrixF& s : sequences) frames.push_back(s.cast<double>());

  const Eigen::RowVectorXd pooled = pooled_variance(known);
  MarkovChain chain = MarkovChain::initial(known.front().chain().topology());
  MixtureBank bank = first_bank(frames, n, pooled, options.num_recordings);
  MatrixD densities;
  MatrixD gamma;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    detail::ChainCounts counts(n);
    StateSums sums(n, dim);
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      poll(options.should_stop);
      bank.log_densities(sequences[s], &densities, nullptr);
      gamma.resize(densities.rows(), n);
      detail::forward_backward(chain, detail::rows_of(densities), gamma.data(), n, &counts);
      sums.add(frames[s], gamma);
    }
    detail::add_pseudo_counts(chain, 1.0, &counts);
    chain = detail::estimate_chain(counts, chain);
    bank = sums.estimate(bank.means(), pooled, options.num_recordings);
  }
  return {std::move(chain), std::move(bank)};
}

DiscreteHmm train_few(const std::vector<DiscreteHmm>& known,
                      const std::vector<SymbolSequence>& sequences, double emission_floor,
                      const FewSampleOptions& options) {
  validate(options);
  check_known(known);
  const int num_symbols = known.front().num_symbols();
  // P(symbol | another symbol), by way of the state that emits both.
  MatrixD together = MatrixD::Zero(num_symbols, num_symbols);
  for (const DiscreteHmm& model : known) {
    require(model.num_symbols() == num_symbols, "the known models need one number of symbols");
    together += model.emission().transpose() * model.emission();
  }
  together.array().colwise() /= together.rowwise().sum().array().max(1e-300);

  DiscreteHmmOptions training;
  training.topology = known.front().chain().topology();
  training.num_symbols = num_symbols;
  training.max_iterations = options.max_iterations;
  training.emission_floor = emission_floor;
  training.transition_prior = 1.0;
  training.should_stop = options.should_stop;
  const DiscreteHmm own = DiscreteHmm::train(sequences, training);
  const double share = options.num_recordings / (kSymbolRecordings + options.num_recordings);
  MatrixD emission = share * own.emission() + (1 - share) * own.emission() * together;
  emission = emission.cwiseMax(emission_floor);
  emission.array().colwise() /= emission.rowwise().sum().array();
  return {own.chain(), std::move(emission)};
}

}  // namespace hri
