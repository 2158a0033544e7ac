// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The M step of Baum-Welch for mixture banks.
#include <algorithm>

#include "core/simd.hpp"
#include "hri/core/error.hpp"
#include "hri/models/hmm/mixture_bank.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/mixture_training.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kFramesTogether = 64;  // frames that are added together
constexpr Eigen::Index kRows = 4;             // components that are added together
constexpr double kLeastGamma = 1e-12;

// x, its squares, and 1.
HRI_SIMD_CLONES
void write_moments(const float* x, Eigen::Index dim, double* out) {
  for (Eigen::Index d = 0; d < dim; ++d) {
    const auto value = static_cast<double>(x[d]);
    out[d] = value;
    out[dim + d] = value * value;
  }
  out[2 * dim] = 1;
}

// The weight of every component for frame t; 0 where it is left out.
void write_weights(const detail::Alignment& a, Eigen::Index t, Eigen::Index num_states,
                   Eigen::Index num_mixtures, double* out) {
  const double* gamma = a.gamma + t * a.gamma_stride;
  for (Eigen::Index j = 0; j < num_states; ++j, out += num_mixtures) {
    if (!(gamma[j] > kLeastGamma)) {
      std::fill_n(out, num_mixtures, 0.0);
    } else if (num_mixtures == 1) {
      out[0] = gamma[j];
    } else {
      const double* shares = a.shares + t * a.share_stride + j * num_mixtures;
      for (Eigen::Index c = 0; c < num_mixtures; ++c) out[c] = gamma[j] * shares[c];
    }
  }
}

}  // namespace

MixtureAccumulator::MixtureAccumulator(int num_states, int num_mixtures, int dim)
    : num_mixtures_(num_mixtures),
      dim_(dim),
      totals_(static_cast<std::ptrdiff_t>(num_states) * num_mixtures, 2 * dim + 1, 0) {}

void MixtureAccumulator::add(ConstMatrixRefF frames, const MatrixD& gamma, const MatrixD& shares) {
  const Eigen::Index num_rows = totals_.num_rows();
  require(gamma.rows() == frames.rows() && gamma.cols() * num_mixtures_ == num_rows,
          "gamma must have shape (num_frames, num_states)");
  require(num_mixtures_ == 1 || (shares.rows() == frames.rows() && shares.cols() == num_rows),
          "shares must have shape (num_frames, num_states * num_mixtures)");
  add(frames, {gamma.data(), gamma.cols(), shares.data(), shares.cols()});
}

// A weight of 0 adds nothing, to the bit, so that products of whole blocks may be summed.
void MixtureAccumulator::add(ConstMatrixRefF frames, const detail::Alignment& alignment) {
  detail::require_width(frames, dim_);
  const Eigen::Index num_rows = totals_.num_rows();
  const std::ptrdiff_t width = detail::padded(num_rows);
  thread_local detail::PaddedMatrix moments;
  thread_local detail::PaddedMatrix weights;
  moments.resize(kFramesTogether, totals_.stride());
  weights.resize(kFramesTogether, width);
  for (Eigen::Index t = 0; t < kFramesTogether; ++t)
    std::fill(moments.row(t) + 2 * dim_ + 1, moments.row(t) + totals_.stride(), 0.0);
  const auto visited = [&](Eigen::Index t, Eigen::Index r, Eigen::Index count) {
    const double* w = weights.row(t) + r;
    return std::any_of(w, w + count, [](double value) { return value > 0; });
  };
  for (Eigen::Index first = 0; first < frames.rows(); first += kFramesTogether) {
    const Eigen::Index count = std::min(kFramesTogether, frames.rows() - first);
    for (Eigen::Index t = 0; t < count; ++t) {
      write_moments(frames.data() + (first + t) * frames.outerStride(), dim_, moments.row(t));
      write_weights(alignment, first + t, num_rows / num_mixtures_, num_mixtures_, weights.row(t));
    }
    for (Eigen::Index r = 0; r < num_rows; r += kRows) {
      const Eigen::Index rows = std::min(kRows, num_rows - r);
      Eigen::Index begin = 0;
      Eigen::Index end = count;
      while (begin < end && !visited(begin, r, rows)) ++begin;
      while (end > begin && !visited(end - 1, r, rows)) --end;
      detail::dense_kernels().add_products(
          weights.row(begin) + r, weights.stride(), moments.row(begin), moments.stride(),
          static_cast<int>(end - begin), static_cast<int>(rows), totals_.stride(), totals_.row(r));
    }
  }
}

void MixtureAccumulator::add_prior(const MixtureBank& prior, double frames_per_state) {
  const Eigen::Index k = prior.num_mixtures();
  for (Eigen::Index r = 0; r < totals_.num_rows(); ++r) {
    const double frames = frames_per_state * prior.weights()(r / k, r % k);
    double* row = totals_.row(r);
    for (Eigen::Index d = 0; d < dim_; ++d) {
      const double mean = prior.means()(r, d);
      row[d] += frames * mean;
      row[dim_ + d] += frames * (prior.variances()(r, d) + mean * mean);
    }
    row[2 * dim_] += frames;
  }
}

VectorD MixtureAccumulator::counts() const { return columns(2 * dim_, 1); }

MatrixD MixtureAccumulator::columns(Eigen::Index first, Eigen::Index count) const {
  MatrixD result(totals_.num_rows(), count);
  for (Eigen::Index r = 0; r < result.rows(); ++r)
    std::copy_n(totals_.row(r) + first, count, result.data() + r * count);
  return result;
}

MixtureBank MixtureAccumulator::estimate(const MixtureBank& previous,
                                         const BankEstimation& options) const {
  const VectorD total_counts = counts();
  const MatrixD total_sums = sums();
  const MatrixD total_squares = squares();
  MatrixD weights = previous.weights();
  MatrixD means = previous.means();
  MatrixD variances = previous.variances();
  const auto floor = options.variance_floor.transpose();
  const Eigen::Index k = weights.cols();
  constexpr double kUnvisited = 1e-8;
  Eigen::RowVectorXd spread = Eigen::RowVectorXd::Zero(means.cols());  // of all components
  double spread_count = 0;
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    const double total = total_counts.segment(j * k, k).sum();
    if (total < kUnvisited) continue;
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Index r = j * k + c;
      weights(j, c) = std::max((total_counts[r] + options.weight_prior) /
                                   (total + options.weight_prior * static_cast<double>(k)),
                               options.weight_floor);
      if (total_counts[r] < kUnvisited) continue;
      means.row(r) = total_sums.row(r) / total_counts[r];
      const Eigen::RowVectorXd variance =
          total_squares.row(r) / total_counts[r] - means.row(r).cwiseAbs2();
      variances.row(r) = variance.cwiseMax(floor);
      spread += total_counts[r] * variance;
      spread_count += total_counts[r];
    }
    weights.row(j) /= weights.row(j).sum();
  }
  if (options.tied_variance && spread_count > 0)
    variances.rowwise() = (spread / spread_count).cwiseMax(floor);
  return {weights, means, variances};
}

}  // namespace hri
