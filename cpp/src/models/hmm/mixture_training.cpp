// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Estimation of mixture banks: statistics, k-means starts, and the M step of Baum-Welch.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/models/hmm/mixture_bank.hpp"

namespace hri {
namespace {

constexpr int kStartIterations = 10;

// Rows far apart: each is drawn with a probability that grows with the squared distance to those
// already chosen (k-means++).
MatrixD distant_rows(const MatrixD& rows, int count, Random* random) {
  MatrixD chosen(count, rows.cols());
  chosen.row(0) =
      rows.row(static_cast<Eigen::Index>(random->below(static_cast<std::uint64_t>(rows.rows()))));
  VectorD distance = VectorD::Constant(rows.rows(), std::numeric_limits<double>::infinity());
  for (int k = 1; k < count; ++k) {
    distance = distance.cwiseMin((rows.rowwise() - chosen.row(k - 1)).rowwise().squaredNorm());
    double left = random->uniform() * distance.sum();
    Eigen::Index at = 0;
    while (at + 1 < rows.rows() && left >= distance[at]) left -= distance[at++];
    chosen.row(k) = rows.row(at);
  }
  return chosen;
}

// k-means of `rows` from `centres` on, which are moved; returns the cluster of each row.
std::vector<int> clusters_of(const MatrixD& rows, MatrixD* moved, const StopCheck& should_stop) {
  MatrixD& centres = *moved;
  const Eigen::Index num_clusters = centres.rows();
  std::vector<int> nearest(static_cast<std::size_t>(rows.rows()), 0);
  for (int iteration = 0; iteration < kStartIterations; ++iteration) {
    poll(should_stop);
    MatrixD sums = MatrixD::Zero(num_clusters, rows.cols());
    VectorD counts = VectorD::Zero(num_clusters);
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      Eigen::Index best = 0;
      (centres.rowwise() - rows.row(r)).rowwise().squaredNorm().minCoeff(&best);
      nearest[static_cast<std::size_t>(r)] = static_cast<int>(best);
      sums.row(best) += rows.row(r);
      counts[best] += 1;
    }
    for (Eigen::Index k = 0; k < num_clusters; ++k) {
      if (counts[k] > 0) centres.row(k) = sums.row(k) / counts[k];
    }
  }
  return nearest;
}

// As above from random rows.
std::vector<int> clusters_of(const MatrixD& rows, int num_clusters, Random* random) {
  MatrixD centres(num_clusters, rows.cols());
  for (int k = 0; k < num_clusters; ++k)
    centres.row(k) =
        rows.row(static_cast<Eigen::Index>(random->below(static_cast<std::uint64_t>(rows.rows()))));
  return clusters_of(rows, &centres, {});
}

}  // namespace

std::vector<std::vector<int>> cluster_frames(const std::vector<MatrixF>& sequences, int num_states,
                                             std::uint64_t seed, const StopCheck& should_stop) {
  const GlobalStatistics global = global_statistics(sequences);
  const Eigen::RowVectorXd scale =
      (global.variance.array() > 0).select(global.variance.array().rsqrt(), 1.0).transpose();
  const auto standardised = [&](const MatrixF& s, Eigen::Index t) {
    return ((s.row(t).cast<double>() - global.mean.transpose()).array() * scale.array()).matrix();
  };
  // Evenly spaced frames are enough to place the centres.
  constexpr std::ptrdiff_t kMostFrames = 20000;
  std::ptrdiff_t total = 0;
  for (const MatrixF& s : sequences) total += s.rows();
  const std::ptrdiff_t every = std::max<std::ptrdiff_t>(1, (total + kMostFrames - 1) / kMostFrames);
  MatrixD rows((total + every - 1) / every, global.mean.size());
  std::ptrdiff_t frame = 0;
  for (const MatrixF& s : sequences) {
    for (Eigen::Index t = 0; t < s.rows(); ++t, ++frame) {
      if (frame % every == 0) rows.row(frame / every) = standardised(s, t);
    }
  }
  Random random(seed);
  MatrixD centres = distant_rows(rows, num_states, &random);
  clusters_of(rows, &centres, should_stop);
  std::vector<std::vector<int>> states;
  states.reserve(sequences.size());
  for (const MatrixF& s : sequences) {
    poll(should_stop);
    std::vector<int>& own = states.emplace_back();
    own.reserve(static_cast<std::size_t>(s.rows()));
    for (Eigen::Index t = 0; t < s.rows(); ++t) {
      Eigen::Index best = 0;
      const Eigen::RowVectorXd x = standardised(s, t);
      (centres.rowwise() - x).rowwise().squaredNorm().minCoeff(&best);
      own.push_back(static_cast<int>(best));
    }
  }
  return states;
}

GlobalStatistics global_statistics(const std::vector<MatrixF>& sequences) {
  require(!sequences.empty(), "training needs at least one sequence");
  const Eigen::Index dim = sequences.front().cols();
  VectorD sum = VectorD::Zero(dim);
  VectorD squares = VectorD::Zero(dim);
  double count = 0;
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const MatrixF& m = sequences[s];
    if (m.rows() == 0)
      fail(ErrorKind::invalid_argument, "sequence " + std::to_string(s) + " has no frames");
    if (m.cols() != dim) {
      fail(ErrorKind::invalid_argument, "sequence " + std::to_string(s) + " has " +
                                            std::to_string(m.cols()) + " columns, the first has " +
                                            std::to_string(dim));
    }
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      if (std::isfinite(m.data()[i])) continue;
      fail(ErrorKind::invalid_argument, "sequence " + std::to_string(s) + " is not finite at row " +
                                            std::to_string(i / dim) + ", column " +
                                            std::to_string(i % dim));
    }
    sum += m.cast<double>().colwise().sum().transpose();
    count += static_cast<double>(m.rows());
  }
  const VectorD mean = sum / count;
  for (const MatrixF& m : sequences) {
    squares += (m.cast<double>().rowwise() - mean.transpose())
                   .array()
                   .square()
                   .matrix()
                   .colwise()
                   .sum()
                   .transpose();
  }
  return {mean, squares / count};
}

MixtureBank initial_bank(const std::vector<MatrixF>& sequences,
                         const std::vector<std::vector<int>>& states, int num_states,
                         int num_mixtures, const VectorD& variance_floor, std::uint64_t seed) {
  const GlobalStatistics global = global_statistics(sequences);
  const auto dim = global.mean.size();
  const Eigen::Index k = num_mixtures;
  MatrixD weights = MatrixD::Constant(num_states, k, 1.0 / num_mixtures);
  MatrixD means(num_states * k, dim);
  MatrixD variances(num_states * k, dim);
  Random random(seed);
  for (int j = 0; j < num_states; ++j) {
    std::vector<Eigen::RowVectorXd> members;
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      for (std::size_t t = 0; t < states[s].size(); ++t) {
        if (states[s][t] == j)
          members.emplace_back(sequences[s].row(static_cast<Eigen::Index>(t)).cast<double>());
      }
    }
    MatrixD rows(static_cast<Eigen::Index>(members.size()), dim);
    for (std::size_t i = 0; i < members.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = members[i];
    const std::vector<int> nearest =
        members.empty() ? std::vector<int>{} : clusters_of(rows, num_mixtures, &random);
    VectorD counts = VectorD::Zero(k);
    for (Eigen::Index c = 0; c < k; ++c) {
      VectorD sum = VectorD::Zero(dim);
      VectorD squares = VectorD::Zero(dim);
      for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i] != c) continue;
        const auto row = rows.row(static_cast<Eigen::Index>(i)).transpose();
        sum += row;
        squares += row.cwiseAbs2();
        counts[c] += 1;
      }
      const Eigen::Index at = j * k + c;
      if (counts[c] > 0) {
        means.row(at) = (sum / counts[c]).transpose();
        variances.row(at) = (squares / counts[c]).transpose() - means.row(at).cwiseAbs2();
      } else {
        means.row(at) = global.mean.transpose();
        variances.row(at) = global.variance.transpose();
      }
      if (counts[c] < 2) variances.row(at) = global.variance.transpose();
      variances.row(at) = variances.row(at).cwiseMax(variance_floor.transpose());
    }
    // Laplace's rule keeps a mixture without frames alive.
    weights.row(j) =
        ((counts.array() + 1.0) / (counts.sum() + static_cast<double>(k))).matrix().transpose();
  }
  return {weights, means, variances};
}

MixtureAccumulator::MixtureAccumulator(int num_states, int num_mixtures, int dim)
    : counts_(VectorD::Zero(num_states * num_mixtures)),
      sums_(MatrixD::Zero(num_states * num_mixtures, dim)),
      squares_(MatrixD::Zero(num_states * num_mixtures, dim)) {}

void MixtureAccumulator::add(ConstMatrixRefF frames, const MatrixD& gamma,
                             const MatrixD& components, const MatrixD& densities) {
  const Eigen::Index k = components.cols() / gamma.cols();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const Eigen::RowVectorXd x = frames.row(t).cast<double>();
    const Eigen::RowVectorXd x2 = x.cwiseAbs2();
    for (Eigen::Index r = 0; r < components.cols(); ++r) {
      const Eigen::Index j = r / k;
      if (!(gamma(t, j) > 1e-12)) continue;
      const double w = gamma(t, j) * (k == 1 ? 1.0 : std::exp(components(t, r) - densities(t, j)));
      if (!(w > 0)) continue;
      counts_[r] += w;
      sums_.row(r) += w * x;
      squares_.row(r) += w * x2;
    }
  }
}

void MixtureAccumulator::add_prior(const MixtureBank& prior, double frames_per_state) {
  const Eigen::Index k = prior.num_mixtures();
  for (Eigen::Index r = 0; r < counts_.size(); ++r) {
    const double frames = frames_per_state * prior.weights()(r / k, r % k);
    counts_[r] += frames;
    sums_.row(r) += frames * prior.means().row(r);
    squares_.row(r) += frames * (prior.variances().row(r) + prior.means().row(r).cwiseAbs2());
  }
}

MixtureBank MixtureAccumulator::estimate(const MixtureBank& previous,
                                         const BankEstimation& options) const {
  MatrixD weights = previous.weights();
  MatrixD means = previous.means();
  MatrixD variances = previous.variances();
  const auto floor = options.variance_floor.transpose();
  const Eigen::Index k = weights.cols();
  constexpr double kUnvisited = 1e-8;
  Eigen::RowVectorXd spread = Eigen::RowVectorXd::Zero(means.cols());  // of all components
  double spread_count = 0;
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    const double total = counts_.segment(j * k, k).sum();
    if (total < kUnvisited) continue;
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Index r = j * k + c;
      weights(j, c) = std::max((counts_[r] + options.weight_prior) /
                                   (total + options.weight_prior * static_cast<double>(k)),
                               options.weight_floor);
      if (counts_[r] < kUnvisited) continue;
      means.row(r) = sums_.row(r) / counts_[r];
      const Eigen::RowVectorXd variance = squares_.row(r) / counts_[r] - means.row(r).cwiseAbs2();
      variances.row(r) = variance.cwiseMax(floor);
      spread += counts_[r] * variance;
      spread_count += counts_[r];
    }
    weights.row(j) /= weights.row(j).sum();
  }
  if (options.tied_variance && spread_count > 0)
    variances.rowwise() = (spread / spread_count).cwiseMax(floor);
  return {weights, means, variances};
}

}  // namespace hri
