// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Estimation of mixture banks: statistics, k-means starts, as training begins with them.
#include "models/hmm/mixture_training.hpp"

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

// Rows of float, wherever they lie.
struct FloatRows {
  std::vector<const float*> rows;
  Eigen::Index dim;

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  const double* get(std::size_t r, double* buffer) const {
    for (Eigen::Index d = 0; d < dim; ++d) buffer[d] = static_cast<double>(rows[r][d]);
    return buffer;
  }
};

struct DoubleRows {
  const MatrixD& rows;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(rows.rows()); }
  const double* get(std::size_t r, double* /*buffer*/) const {
    return rows.data() + static_cast<Eigen::Index>(r) * rows.cols();
  }
};

// k-means of rows from `centres` on, which are moved; returns the cluster of each row.
template <class Rows>
std::vector<int> clusters_of(const Rows& rows, MatrixD* moved, const StopCheck& should_stop) {
  MatrixD& centres = *moved;
  const Eigen::Index num_clusters = centres.rows();
  const Eigen::Index dim = centres.cols();
  std::vector<int> nearest(rows.size(), 0);
  std::vector<double> buffer(static_cast<std::size_t>(dim));
  for (int iteration = 0; iteration < kStartIterations; ++iteration) {
    poll(should_stop);
    detail::NearestCentre search(centres);
    MatrixD sums = MatrixD::Zero(num_clusters, dim);
    VectorD counts = VectorD::Zero(num_clusters);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double* row = rows.get(r, buffer.data());
      const int best = search.find(row);
      nearest[r] = best;
      double* sum = sums.data() + best * dim;
      for (Eigen::Index d = 0; d < dim; ++d) sum[d] += row[d];
      counts[best] += 1;
    }
    for (Eigen::Index k = 0; k < num_clusters; ++k) {
      if (counts[k] > 0) centres.row(k) = sums.row(k) / counts[k];
    }
  }
  return nearest;
}

// As above from random rows.
std::vector<int> clusters_of(const FloatRows& rows, int num_clusters, Random* random) {
  MatrixD centres(num_clusters, rows.dim);
  for (int k = 0; k < num_clusters; ++k)
    rows.get(static_cast<std::size_t>(random->below(rows.size())), centres.data() + k * rows.dim);
  if (num_clusters == 1) return std::vector<int>(rows.size(), 0);
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
  clusters_of(DoubleRows{rows}, &centres, should_stop);
  detail::NearestCentre search(centres);
  std::vector<std::vector<int>> states;
  states.reserve(sequences.size());
  for (const MatrixF& s : sequences) {
    poll(should_stop);
    std::vector<int>& own = states.emplace_back();
    own.reserve(static_cast<std::size_t>(s.rows()));
    for (Eigen::Index t = 0; t < s.rows(); ++t) {
      const Eigen::RowVectorXd x = standardised(s, t);
      own.push_back(search.find(x.data()));
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
  return detail::initial_bank(sequences, states, num_states, num_mixtures, variance_floor, seed,
                              global_statistics(sequences));
}

MixtureBank detail::initial_bank(const std::vector<MatrixF>& sequences,
                                 const std::vector<std::vector<int>>& states, int num_states,
                                 int num_mixtures, const VectorD& variance_floor,
                                 std::uint64_t seed, const GlobalStatistics& global) {
  const auto dim = global.mean.size();
  const Eigen::Index k = num_mixtures;
  MatrixD weights = MatrixD::Constant(num_states, k, 1.0 / num_mixtures);
  MatrixD means(num_states * k, dim);
  MatrixD variances(num_states * k, dim);
  std::vector<FloatRows> members(static_cast<std::size_t>(num_states), FloatRows{{}, dim});
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    for (std::size_t t = 0; t < states[s].size(); ++t) {
      const int j = states[s][t];
      members[static_cast<std::size_t>(j)].rows.push_back(sequences[s].data() +
                                                          static_cast<Eigen::Index>(t) * dim);
    }
  }
  Random random(seed);
  VectorD row(dim);
  for (int j = 0; j < num_states; ++j) {
    const FloatRows& rows = members[static_cast<std::size_t>(j)];
    const std::vector<int> nearest =
        rows.size() == 0 ? std::vector<int>{} : clusters_of(rows, num_mixtures, &random);
    VectorD counts = VectorD::Zero(k);
    MatrixD sums = MatrixD::Zero(k, dim);
    MatrixD squares = MatrixD::Zero(k, dim);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      rows.get(i, row.data());
      sums.row(nearest[i]) += row.transpose();
      squares.row(nearest[i]) += row.cwiseAbs2().transpose();
      counts[nearest[i]] += 1;
    }
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Index at = j * k + c;
      if (counts[c] > 0) {
        means.row(at) = sums.row(c) / counts[c];
        variances.row(at) = squares.row(c) / counts[c] - means.row(at).cwiseAbs2();
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

}  // namespace hri
