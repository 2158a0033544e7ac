// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/adaptation/map_adaptation.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "models/adaptation/adaptation_statistics.hpp"
#include "models/least_variance.hpp"

namespace hri {
namespace {

// A Gaussian that met few frames, all alike, must not become a needle.
constexpr double kLeastVariance = 0.1;

MixtureBank with_variance_floor(const MixtureBank& bank, const MixtureBank& prior) {
  return {bank.weights(), bank.means(),
          bank.variances().cwiseMax(kLeastVariance * prior.variances())};
}

MixtureBank adapt(const MarkovChain& chain, const MixtureBank& prior,
                  const std::vector<MatrixF>& sequences, const MapAdaptationOptions& options) {
  validate(options);
  detail::check_adaptation_data(sequences, prior.dim());
  MixtureBank bank = prior;
  const VectorD widest = prior.variances().colwise().maxCoeff().transpose();
  const VectorD no_floor = VectorD::Constant(
      prior.dim(), detail::least_variance(VectorD::Zero(prior.dim()), widest, 1e-10));
  for (int i = 0; i < options.num_iterations; ++i) {
    MixtureAccumulator accumulator(prior.num_states(), prior.num_mixtures(), prior.dim());
    accumulator.add_prior(prior, options.prior_frames);
    detail::add_aligned(chain, bank, sequences, options.should_stop, &accumulator);
    bank = with_variance_floor(accumulator.estimate(bank, {no_floor, 0.0, 0.0, false}), prior);
  }
  return bank;
}

}  // namespace

GaussianMixtureHmm adapt_map(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences,
                             const MapAdaptationOptions& options) {
  if (sequences.empty()) return model;
  return {model.chain(), adapt(model.chain(), model.bank(), sequences, options)};
}

GaussianMixture adapt_map(const GaussianMixture& model, const std::vector<MatrixF>& sequences,
                          const MapAdaptationOptions& options) {
  if (sequences.empty()) return model;
  Topology one_state;
  one_state.num_states = 1;
  return GaussianMixture(adapt(MarkovChain::initial(one_state), model.bank(), sequences, options));
}

}  // namespace hri
