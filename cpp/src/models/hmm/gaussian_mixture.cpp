// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/gaussian_mixture.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "models/hmm/mixture_training.hpp"
#include "models/least_variance.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kRowsBetweenLooks = 1024;  // rows between two looks whether to stop
constexpr double kWideVariance = 25;              // times the variance of all rows

MixtureBank with_wide_component(const MixtureBank& bank, const GlobalStatistics& all,
                                double weight) {
  const Eigen::Index count = bank.num_mixtures();
  MatrixD weights(1, count + 1);
  MatrixD means(count + 1, bank.dim());
  MatrixD variances(count + 1, bank.dim());
  weights << (1 - weight) * bank.weights(), weight;
  means << bank.means(), all.mean.transpose();
  const double least = detail::least_variance(all.mean, all.variance, 1e-10);
  variances << bank.variances(), kWideVariance * all.variance.cwiseMax(least).transpose();
  return {std::move(weights), std::move(means), std::move(variances)};
}

}  // namespace

GaussianMixture::GaussianMixture(MixtureBank bank) : bank_(std::move(bank)) {
  require(bank_.num_states() == 1, "a mixture over single frames has one state");
}

GaussianMixture GaussianMixture::train(ConstMatrixRefF rows, const GaussianMixtureOptions& options,
                                       TrainingReport* report) {
  validate(options);
  require(rows.rows() > 0, "training needs at least one row");
  const std::vector<MatrixF> sequence{rows};
  const GlobalStatistics all = global_statistics(sequence);
  const VectorD floor = (all.variance * options.variance_floor)
                            .cwiseMax(detail::least_variance(all.mean, all.variance, 1e-10));
  MixtureBank bank =
      detail::initial_bank(sequence, {std::vector<int>(static_cast<std::size_t>(rows.rows()), 0)},
                           1, options.num_mixtures, floor, options.seed, all);
  const double certain = 1;
  TrainingReport local;
  VectorD densities(rows.rows());
  detail::PaddedMatrix shares(kRowsBetweenLooks, options.num_mixtures, 0);
  for (int iteration = 0; iteration < options.max_iterations && !local.converged; ++iteration) {
    MixtureAccumulator accumulator(1, options.num_mixtures, bank.dim());
    for (Eigen::Index first = 0; first < rows.rows(); first += kRowsBetweenLooks) {
      poll(options.should_stop);
      const auto block = rows.middleRows(first, std::min(kRowsBetweenLooks, rows.rows() - first));
      double* of_block = densities.data() + first;
      detail::log_densities_of_finite(bank, block, of_block, 1, shares.row(0), shares.stride());
      accumulator.add(block, {&certain, 0, shares.row(0), shares.stride()});
    }
    const double total = densities.sum();
    if (!local.log_likelihoods.empty()) {
      local.converged = (total - local.log_likelihoods.back()) / static_cast<double>(rows.rows()) <
                        options.tolerance;
    }
    local.log_likelihoods.push_back(total);
    bank = accumulator.estimate(bank, {floor, 0.0, 0.0, false});
  }
  if (report != nullptr) *report = std::move(local);
  if (options.wide_weight > 0) bank = with_wide_component(bank, all, options.wide_weight);
  return GaussianMixture(std::move(bank));
}

double GaussianMixture::log_likelihood(ConstMatrixRefF frames) const {
  MatrixF densities(frames.rows(), 1);
  bank_.log_densities(frames, densities);
  return densities.cast<double>().sum();
}

GaussianMixture GaussianMixture::read(const ModelFile& file, const std::string& prefix) {
  MixtureBank bank = MixtureBank::read(file, prefix);
  if (bank.num_states() != 1)
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' needs one row");
  return GaussianMixture(std::move(bank));
}

}  // namespace hri
