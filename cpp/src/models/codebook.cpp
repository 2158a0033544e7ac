// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/simd.hpp"

namespace hri {
namespace {

HRI_SIMD_CLONES
float squared_distance(const float* a, const float* b, int dim) {
  constexpr int kLanes = 8;
  float lanes[kLanes] = {};
  int d = 0;
  for (; d + kLanes <= dim; d += kLanes) {
    for (int l = 0; l < kLanes; ++l) {
      const float diff = a[d + l] - b[d + l];
      lanes[l] += diff * diff;
    }
  }
  float sum = 0;
  for (; d < dim; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  for (const float lane : lanes) sum += lane;
  return sum;
}

struct Nearest {
  int index = 0;
  float distance = std::numeric_limits<float>::max();
};

Nearest nearest_row(const MatrixF& centroids, const float* x) {
  Nearest best;
  const int dim = static_cast<int>(centroids.cols());
  for (Eigen::Index k = 0; k < centroids.rows(); ++k) {
    const float distance = squared_distance(x, centroids.data() + k * dim, dim);
    if (distance < best.distance) best = {static_cast<int>(k), distance};
  }
  return best;
}

// One pass of k-means: assignments, cell sums, and how much of the distortion lies in each cell.
struct Pass {
  MatrixD sums;
  MatrixD squares;
  VectorD counts;
  VectorD distortions;
};

Pass assign(ConstMatrixRefF rows, const MatrixF& centroids) {
  Pass pass{MatrixD::Zero(centroids.rows(), rows.cols()), MatrixD::Zero(centroids.rows(), rows.cols()),
            VectorD::Zero(centroids.rows()), VectorD::Zero(centroids.rows())};
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const Nearest best = nearest_row(centroids, rows.data() + r * rows.outerStride());
    pass.sums.row(best.index) += rows.row(r).cast<double>();
    pass.squares.row(best.index) += rows.row(r).cast<double>().cwiseAbs2();
    pass.counts[best.index] += 1;
    pass.distortions[best.index] += static_cast<double>(best.distance);
  }
  return pass;
}

Eigen::RowVectorXf deviation(const Pass& pass, Eigen::Index k) {
  if (!(pass.counts[k] > 0)) return Eigen::RowVectorXf::Zero(pass.sums.cols());
  const Eigen::RowVectorXd mean = pass.sums.row(k) / pass.counts[k];
  return (pass.squares.row(k) / pass.counts[k] - mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt().cast<float>();
}

// Centroids of the cells; an empty one is put beside the codeword of the worst cell, which then gives up half.
void update(Pass* pass, double epsilon, MatrixF* centroids) {
  for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
    if (pass->counts[k] > 0) centroids->row(k) = (pass->sums.row(k) / pass->counts[k]).cast<float>();
  }
  for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
    if (pass->counts[k] > 0) continue;
    Eigen::Index worst = 0;
    if (!(pass->distortions.maxCoeff(&worst) > 0)) continue;  // every row sits on its codeword already
    centroids->row(k) = centroids->row(worst) + static_cast<float>(epsilon) * deviation(*pass, worst);
    pass->distortions[worst] = 0;
  }
}

MatrixF run_kmeans(ConstMatrixRefF rows, MatrixF centroids, const CodebookOptions& options, Pass* last) {
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
  require(options.num_codewords >= 1 && options.num_codewords <= 65536, "num_codewords must lie in 1..65536");
  require(options.max_iterations >= 1, "max_iterations must be at least 1");
  require(options.tolerance >= 0, "tolerance must not be negative");
  require(options.split_epsilon > 0, "split_epsilon must be positive");
  require(rows.rows() > 0 && rows.cols() > 0, "training needs at least one row and column");
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    if (!rows.row(r).allFinite()) {
      fail(ErrorKind::invalid_argument, "rows are not finite at row " + std::to_string(r));
    }
  }
}

}  // namespace

Codebook::Codebook(MatrixF centroids) : centroids_(std::move(centroids)) {
  require(centroids_.size() > 0 && centroids_.allFinite(), "a codebook needs at least one codeword, all finite");
}

Codebook Codebook::train_lbg(ConstMatrixRefF rows, const CodebookOptions& options) {
  check(rows, options);
  MatrixF centroids = rows.cast<double>().colwise().mean().cast<float>();
  Pass pass = assign(rows, centroids);
  while (centroids.rows() < options.num_codewords && pass.distortions.sum() > 0) {
    const Eigen::Index size = centroids.rows();
    const Eigen::Index grown = std::min<Eigen::Index>(2 * size, options.num_codewords);
    // The cells with the largest distortion split first, which matters where the last split is a partial one.
    std::vector<Eigen::Index> order(static_cast<std::size_t>(size));
    for (Eigen::Index k = 0; k < size; ++k) order[static_cast<std::size_t>(k)] = k;
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return pass.distortions[a] > pass.distortions[b]; });
    centroids.conservativeResize(grown, Eigen::NoChange);
    for (Eigen::Index i = 0; i < grown - size; ++i) {
      const Eigen::Index k = order[static_cast<std::size_t>(i)];
      const Eigen::RowVectorXf step = static_cast<float>(options.split_epsilon) * deviation(pass, k);
      centroids.row(size + i) = centroids.row(k) + step;
      centroids.row(k) -= step;
    }
    centroids = run_kmeans(rows, std::move(centroids), options, &pass);
  }
  return Codebook(std::move(centroids));
}

Codebook Codebook::train_kmeans(ConstMatrixRefF rows, ConstMatrixRefF centroids, const CodebookOptions& options) {
  check(rows, options);
  require(centroids.rows() > 0 && centroids.cols() == rows.cols(), "centroids must have as many columns as the rows");
  Pass pass;
  return Codebook(run_kmeans(rows, centroids, options, &pass));
}

int Codebook::quantise(Span<const float> frame) const {
  require(frame.size() == static_cast<std::size_t>(dim()), "frame must have dim() values");
  return nearest_row(centroids_, frame.data()).index;
}

void Codebook::quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const {
  require(frames.cols() == dim() && out.size() == static_cast<std::size_t>(frames.rows()),
          "frames must have dim() columns, out one place a row");
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    out[static_cast<std::size_t>(t)] = nearest_row(centroids_, frames.data() + t * frames.outerStride()).index;
  }
}

std::vector<std::int32_t> Codebook::quantise(ConstMatrixRefF frames) const {
  std::vector<std::int32_t> symbols(static_cast<std::size_t>(frames.rows()));
  quantise(frames, {symbols.data(), symbols.size()});
  return symbols;
}

double Codebook::distortion(ConstMatrixRefF frames) const {
  require(frames.rows() > 0 && frames.cols() == dim(), "frames must have rows, and dim() columns");
  double sum = 0;
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    sum += static_cast<double>(nearest_row(centroids_, frames.data() + t * frames.outerStride()).distance);
  }
  return sum / static_cast<double>(frames.rows());
}

void Codebook::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "centroids", centroids_);
}

Codebook Codebook::read(const ModelFile& file, const std::string& prefix) {
  MatrixF centroids = file.matrix_f(prefix + "centroids");
  if (centroids.size() == 0) fail(ErrorKind::format, file.name() + ": field '" + prefix + "centroids' is empty");
  return Codebook(std::move(centroids));
}

}  // namespace hri
