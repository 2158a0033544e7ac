// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/adaptation/linear_adaptation.hpp"

#include <cmath>

#include "hri/core/error.hpp"
#include "models/adaptation/adaptation_statistics.hpp"

namespace hri {
namespace {

// Beyond these a transform says that the data are something else than speech.
constexpr double kLeastSlope = 0.2;
constexpr double kMostSlope = 2.0;
constexpr double kLeastSpread = 0.25;
constexpr double kMostSpread = 16.0;

// Sums over all components of all models, per dimension; every frame counts by its precision.
struct Sums {
  explicit Sums(Eigen::Index dim)
      : weight(VectorD::Zero(dim)),
        mean(VectorD::Zero(dim)),
        mean2(VectorD::Zero(dim)),
        x(VectorD::Zero(dim)),
        x2(VectorD::Zero(dim)),
        mean_x(VectorD::Zero(dim)) {}

  void add(const MixtureAccumulator& found, const MixtureBank& bank) {
    const VectorD counts = found.counts();
    const MatrixD sums = found.sums();
    const MatrixD squares = found.squares();
    count += counts.sum();
    for (Eigen::Index r = 0; r < counts.size(); ++r) {
      const Eigen::ArrayXd precision = bank.variances().row(r).array().inverse().transpose();
      const Eigen::ArrayXd m = bank.means().row(r).array().transpose();
      const Eigen::ArrayXd sum = sums.row(r).array().transpose();
      weight.array() += counts[r] * precision;
      mean.array() += counts[r] * precision * m;
      mean2.array() += counts[r] * precision * m.square();
      x.array() += precision * sum;
      x2.array() += precision * squares.row(r).array().transpose();
      mean_x.array() += precision * m * sum;
    }
  }

  double count = 0;
  VectorD weight, mean, mean2, x, x2, mean_x;
};

}  // namespace

MixtureBank LinearAdaptation::apply(const MixtureBank& bank) const {
  MatrixD means = bank.means();
  MatrixD variances = bank.variances();
  means.array().rowwise() *= slope.array().transpose();
  means.array().rowwise() += offset.array().transpose();
  variances.array().rowwise() *= spread.array().transpose();
  return {bank.weights(), std::move(means), std::move(variances)};
}

LinearAdaptation estimate_linear_adaptation(const std::vector<GaussianMixtureHmm>& models,
                                            const std::vector<std::vector<MatrixF>>& per_model,
                                            double prior_frames, const StopCheck& should_stop) {
  require(!models.empty() && models.size() == per_model.size(),
          "per_model needs one list a model, and there must be one model at least");
  require(prior_frames > 0 && std::isfinite(prior_frames),
          "prior_frames must be finite and positive");
  const int dim = models.front().dim();
  int num_states = 0;
  for (const GaussianMixtureHmm& model : models) num_states += model.num_states();
  Sums sums(dim);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const MixtureBank& bank = models[m].bank();
    require(bank.dim() == dim, "the models differ in their number of features");
    detail::check_adaptation_data(per_model[m], dim);
    MixtureAccumulator found(bank.num_states(), bank.num_mixtures(), dim);
    found.add_prior(bank, prior_frames / num_states);
    detail::add_aligned(models[m].chain(), bank, per_model[m], should_stop, &found);
    sums.add(found, bank);
  }
  // Weighted regression of x on the means, dimension by dimension.
  const Eigen::ArrayXd w = sums.weight.array();
  const Eigen::ArrayXd spread_of_means = (w * sums.mean2.array() - sums.mean.array().square());
  const Eigen::ArrayXd slope =
      (spread_of_means > 1e-9 * w.square())
          .select((w * sums.mean_x.array() - sums.mean.array() * sums.x.array()) / spread_of_means,
                  1.0)
          .max(kLeastSlope)
          .min(kMostSlope);
  const Eigen::ArrayXd offset = (sums.x.array() - slope * sums.mean.array()) / w;
  const Eigen::ArrayXd residual = sums.x2.array() -
                                  2.0 * (slope * sums.mean_x.array() + offset * sums.x.array()) +
                                  slope.square() * sums.mean2.array() +
                                  2.0 * slope * offset * sums.mean.array() + offset.square() * w;
  return {slope.matrix(), offset.matrix(),
          (residual / sums.count).max(kLeastSpread).min(kMostSpread).matrix()};
}

}  // namespace hri
