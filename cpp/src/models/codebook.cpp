// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "nearest_codeword.hpp"

namespace hri {
namespace {

using detail::Nearest;

std::vector<Nearest> nearest_codewords(ConstMatrixRefF rows, const MatrixF& columns) {
  std::vector<Nearest> nearest(static_cast<std::size_t>(rows.rows()));
  detail::find_nearest(rows.data(), rows.outerStride(), rows.rows(), columns, nearest.data());
  return nearest;
}

// One pass of k-means: assignments, cell sums, and how much of the distortion lies in each cell.
struct Pass {
  MatrixD sums;
  MatrixD squares;
  VectorD counts;
  VectorD distortions;
};

Pass assign(ConstMatrixRefF rows, const MatrixF& centroids) {
  Pass pass{MatrixD::Zero(centroids.rows(), rows.cols()),
            MatrixD::Zero(centroids.rows(), rows.cols()), VectorD::Zero(centroids.rows()),
            VectorD::Zero(centroids.rows())};
  const std::vector<Nearest> nearest = nearest_codewords(rows, detail::codeword_columns(centroids));
  const auto dim = static_cast<int>(rows.cols());
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const Nearest& best = nearest[static_cast<std::size_t>(r)];
    const Eigen::Index cell = best.index * rows.cols();
    detail::accumulate(rows.data() + r * rows.outerStride(), dim, pass.sums.data() + cell,
                       pass.squares.data() + cell);
    pass.counts[best.index] += 1;
    pass.distortions[best.index] += static_cast<double>(best.distance);
  }
  return pass;
}

Eigen::RowVectorXf deviation(const Pass& pass, Eigen::Index k) {
  if (!(pass.counts[k] > 0)) return Eigen::RowVectorXf::Zero(pass.sums.cols());
  const Eigen::RowVectorXd mean = pass.sums.row(k) / pass.counts[k];
  return (pass.squares.row(k) / pass.counts[k] - mean.cwiseAbs2())
      .cwiseMax(0)
      .cwiseSqrt()
      .cast<float>();
}

// Centroids of the cells; an empty one is put beside the codeword of the worst cell, which then
// gives up half.
void update(Pass* pass, double epsilon, MatrixF* centroids) {
  for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
    if (pass->counts[k] > 0)
      centroids->row(k) = (pass->sums.row(k) / pass->counts[k]).cast<float>();
  }
  for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
    if (pass->counts[k] > 0) continue;
    Eigen::Index worst = 0;
    if (!(pass->distortions.maxCoeff(&worst) > 0))
      continue;  // every row sits on its codeword already
    centroids->row(k) =
        centroids->row(worst) + static_cast<float>(epsilon) * deviation(*pass, worst);
    pass->distortions[worst] = 0;
  }
}

MatrixF run_kmeans(ConstMatrixRefF rows, MatrixF centroids, const CodebookOptions& options,
                   Pass* last) {
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    poll(options.should_stop);
    *last = assign(rows, centroids);
    const double total = last->distortions.sum();
    const bool some_empty = last->counts.minCoeff() == 0;
    update(last, options.split_epsilon, &centroids);
    if (!some_empty && before - total <= options.tolerance * total) break;
    before = total;
  }
  *last = assign(rows, centroids);
  return centroids;
}

void check(ConstMatrixRefF rows, const CodebookOptions& options) {
  require(options.num_codewords >= 1 && options.num_codewords <= 65536,
          "num_codewords must lie in 1..65536");
  require(options.max_iterations >= 1, "max_iterations must be at least 1");
  require(options.tolerance >= 0, "tolerance must not be negative");
  require(options.split_epsilon > 0, "split_epsilon must be positive");
  require(rows.rows() > 0 && rows.cols() > 0, "training needs at least one row and column");
  validate_finite(rows, "rows");
}

// Drops codewords without rows: fewer different rows than codewords leave some over.
MatrixF without_empty(const MatrixF& centroids, const VectorD& counts) {
  MatrixF kept(centroids.rows(), centroids.cols());
  Eigen::Index size = 0;
  for (Eigen::Index k = 0; k < centroids.rows(); ++k) {
    if (counts[k] > 0) kept.row(size++) = centroids.row(k);
  }
  return kept.topRows(size);
}

}  // namespace

Codebook::Codebook(MatrixF centroids) : centroids_(std::move(centroids)) {
  require(centroids_.size() > 0, "a codebook needs at least one codeword");
  validate_finite(centroids_, "centroids");
  columns_ = detail::codeword_columns(centroids_);
}

Codebook Codebook::train_lbg(ConstMatrixRefF rows, const CodebookOptions& options) {
  check(rows, options);
  MatrixF centroids = rows.cast<double>().colwise().mean().cast<float>();
  Pass pass = assign(rows, centroids);
  while (centroids.rows() < options.num_codewords && pass.distortions.sum() > 0) {
    const Eigen::Index size = centroids.rows();
    const Eigen::Index grown = std::min<Eigen::Index>(2 * size, options.num_codewords);
    // The cells with the largest distortion split first, which matters where the last split is a
    // partial one.
    std::vector<Eigen::Index> order(static_cast<std::size_t>(size));
    for (Eigen::Index k = 0; k < size; ++k) order[static_cast<std::size_t>(k)] = k;
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return pass.distortions[a] > pass.distortions[b];
    });
    centroids.conservativeResize(grown, Eigen::NoChange);
    for (Eigen::Index i = 0; i < grown - size; ++i) {
      const Eigen::Index k = order[static_cast<std::size_t>(i)];
      const Eigen::RowVectorXf step =
          static_cast<float>(options.split_epsilon) * deviation(pass, k);
      centroids.row(size + i) = centroids.row(k) + step;
      centroids.row(k) -= step;
    }
    centroids = run_kmeans(rows, std::move(centroids), options, &pass);
  }
  return Codebook(without_empty(centroids, pass.counts));
}

Codebook Codebook::train_kmeans(ConstMatrixRefF rows, ConstMatrixRefF centroids,
                                const CodebookOptions& options) {
  check(rows, options);
  require(centroids.rows() > 0 && centroids.cols() == rows.cols(),
          "centroids must have as many columns as the rows");
  validate_finite(centroids, "centroids");
  Pass pass;
  const MatrixF trained = run_kmeans(rows, centroids, options, &pass);
  return Codebook(without_empty(trained, pass.counts));
}

int Codebook::quantise(Span<const float> frame) const {
  validate_row(frame, dim());
  Nearest nearest;
  detail::find_nearest(frame.data(), 0, 1, columns_, &nearest);
  return nearest.index;
}

void Codebook::quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const {
  require(frames.cols() == dim() && out.size() == static_cast<std::size_t>(frames.rows()),
          "frames must have dim() columns, out one place a row");
  validate_finite(frames, "frames");
  const std::vector<Nearest> nearest = nearest_codewords(frames, columns_);
  for (std::size_t t = 0; t < nearest.size(); ++t) out[t] = nearest[t].index;
}

std::vector<std::int32_t> Codebook::quantise(ConstMatrixRefF frames) const {
  std::vector<std::int32_t> symbols(static_cast<std::size_t>(frames.rows()));
  quantise(frames, {symbols.data(), symbols.size()});
  return symbols;
}

double Codebook::distortion(ConstMatrixRefF frames) const {
  require(frames.rows() > 0 && frames.cols() == dim(), "frames must have rows, and dim() columns");
  validate_finite(frames, "frames");
  double sum = 0;
  for (const Nearest& n : nearest_codewords(frames, columns_))
    sum += static_cast<double>(n.distance);
  return sum / static_cast<double>(frames.rows());
}

void Codebook::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "centroids", centroids_);
}

Codebook Codebook::read(const ModelFile& file, const std::string& prefix) {
  MatrixF centroids = file.matrix_f(prefix + "centroids");
  if (centroids.size() == 0)
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "centroids' is empty");
  return Codebook(std::move(centroids));
}

}  // namespace hri
