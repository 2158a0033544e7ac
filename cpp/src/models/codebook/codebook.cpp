// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook/codebook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/matrix_size.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/models/row_checks.hpp"
#include "models/codebook/nearest_codeword.hpp"

namespace hri {
namespace {

using detail::CellSums;
using detail::CodewordTable;

// Values between two polls of the stop check, about: some milliseconds.
constexpr double kValuesPerPoll = 1 << 27;

// Rows, the cells they lie in and the sums of the cells, kept from one iteration to the next.
class Assignment {
 public:
  Assignment(ConstMatrixRefF rows, const StopCheck& should_stop)
      : rows_(rows), should_stop_(should_stop), cells_(static_cast<std::size_t>(rows.rows())) {}

  void assign(const MatrixF& centroids) {
    const CodewordTable table(centroids);
    detail::fit_zeros(&cell_sums_.sums, centroids.rows(), centroids.cols());
    detail::fit_zeros(&cell_sums_.counts, centroids.rows(), 1);
    detail::fit_zeros(&cell_sums_.distortions, centroids.rows(), 1);
    const double per_row = static_cast<double>(centroids.size());
    const auto at_once = static_cast<Eigen::Index>(std::max(1.0, kValuesPerPoll / per_row));
    for (Eigen::Index first = 0; first < rows_.rows(); first += at_once) {
      poll(should_stop_);
      const Eigen::Index count = std::min(at_once, rows_.rows() - first);
      const float* rows = rows_.data() + first * rows_.outerStride();
      std::int32_t* cells = cells_.data() + first;
      detail::codeword_kernels().find_nearest(rows, rows_.outerStride(), count, table.layout(),
                                              cells, 1);
      detail::add_to_cells(rows, rows_.outerStride(), count, centroids, cells, &cell_sums_);
    }
  }

  // Standard deviations of the cells' rows.
  [[nodiscard]] MatrixF deviations() const {
    const VectorD sizes = counts().cwiseMax(1.0);
    const MatrixD means = sizes.cwiseInverse().asDiagonal() * cell_sums_.sums;
    MatrixD squares = MatrixD::Zero(means.rows(), means.cols());
    for (Eigen::Index r = 0; r < rows_.rows(); ++r) {
      const std::int32_t k = cells_[static_cast<std::size_t>(r)];
      // Differences from the mean lose nothing where a mean is large beside its deviation.
      squares.row(k) += (rows_.row(r).cast<double>() - means.row(k)).cwiseAbs2();
    }
    return (sizes.cwiseInverse().asDiagonal() * squares).cwiseSqrt().cast<float>();
  }

  [[nodiscard]] const VectorD& counts() const { return cell_sums_.counts; }
  [[nodiscard]] const VectorD& distortions() const { return cell_sums_.distortions; }
  [[nodiscard]] double mean_distortion() const {
    return cell_sums_.distortions.sum() / static_cast<double>(rows_.rows());
  }

  // Moves centroids to the middle of their cells; one of an empty cell is put beside the codeword
  // of the worst cell, which then gives up half.
  void update(double epsilon, MatrixF* centroids) const {
    for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
      if (counts()[k] > 0) centroids->row(k) = (cell_sums_.sums.row(k) / counts()[k]).cast<float>();
    }
    if (counts().minCoeff() > 0) return;
    const MatrixF steps = static_cast<float>(epsilon) * deviations();
    VectorD left = distortions();
    for (Eigen::Index k = 0; k < centroids->rows(); ++k) {
      if (counts()[k] > 0) continue;
      Eigen::Index worst = 0;
      if (!(left.maxCoeff(&worst) > 0)) continue;  // every row sits on its codeword already
      centroids->row(k) = centroids->row(worst) + steps.row(worst);
      left[worst] = 0;
    }
  }

 private:
  ConstMatrixRefF rows_;
  const StopCheck& should_stop_;
  std::vector<std::int32_t> cells_;
  CellSums cell_sums_;
};

MatrixF run_kmeans(MatrixF centroids, const CodebookOptions& options, Assignment* assignment,
                   CodebookReport* report) {
  double before = std::numeric_limits<double>::infinity();
  if (report != nullptr) report->converged = false;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    assignment->assign(centroids);
    const double distortion = assignment->mean_distortion();
    if (report != nullptr) {
      report->sizes.push_back(static_cast<int>(centroids.rows()));
      report->distortions.push_back(distortion);
    }
    assignment->update(options.split_epsilon, &centroids);
    const bool some_empty = assignment->counts().minCoeff() == 0;
    if (!some_empty && before - distortion <= options.tolerance * distortion) {
      if (report != nullptr) report->converged = true;
      break;
    }
    before = distortion;
  }
  assignment->assign(centroids);
  return centroids;
}

void check(ConstMatrixRefF rows, const CodebookOptions& options) {
  validate(options);
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
  table_ = std::make_shared<const CodewordTable>(centroids_);
}

Codebook Codebook::train_lbg(ConstMatrixRefF rows, const CodebookOptions& options,
                             CodebookReport* report) {
  check(rows, options);
  if (report != nullptr) *report = {};
  MatrixF centroids = rows.cast<double>().colwise().mean().cast<float>();
  Assignment assignment(rows, options.should_stop);
  assignment.assign(centroids);
  while (centroids.rows() < options.num_codewords && assignment.mean_distortion() > 0) {
    const Eigen::Index size = centroids.rows();
    const Eigen::Index grown = std::min<Eigen::Index>(2 * size, options.num_codewords);
    // The cells with the largest distortion split first, which matters where the last split is a
    // partial one.
    std::vector<Eigen::Index> order(static_cast<std::size_t>(size));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return assignment.distortions()[a] > assignment.distortions()[b];
    });
    const MatrixF steps = static_cast<float>(options.split_epsilon) * assignment.deviations();
    centroids.conservativeResize(grown, Eigen::NoChange);
    for (Eigen::Index i = 0; i < grown - size; ++i) {
      const Eigen::Index k = order[static_cast<std::size_t>(i)];
      centroids.row(size + i) = centroids.row(k) + steps.row(k);
      centroids.row(k) -= steps.row(k);
    }
    centroids = run_kmeans(std::move(centroids), options, &assignment, report);
  }
  return Codebook(without_empty(centroids, assignment.counts()));
}

Codebook Codebook::train_kmeans(ConstMatrixRefF rows, ConstMatrixRefF centroids,
                                const CodebookOptions& options, CodebookReport* report) {
  check(rows, options);
  require(centroids.rows() > 0 && centroids.cols() == rows.cols(),
          "centroids must have as many columns as the rows");
  validate_finite(centroids, "centroids");
  if (report != nullptr) *report = {};
  Assignment assignment(rows, options.should_stop);
  const MatrixF trained = run_kmeans(centroids, options, &assignment, report);
  return Codebook(without_empty(trained, assignment.counts()));
}

int Codebook::quantise(Span<const float> frame) const {
  validate_row(frame, dim());
  std::int32_t index = 0;
  detail::codeword_kernels().find_nearest(frame.data(), 0, 1, table_->layout(), &index, 1);
  return index;
}

void Codebook::quantise(ConstMatrixRefF frames, std::int32_t* out, std::ptrdiff_t stride) const {
  require(frames.cols() == dim(), "frames must have dim() columns");
  validate_finite(frames, "frames");
  detail::codeword_kernels().find_nearest(frames.data(), frames.outerStride(), frames.rows(),
                                          table_->layout(), out, stride);
}

void Codebook::quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const {
  require(out.size() == static_cast<std::size_t>(frames.rows()), "out must have one place a row");
  quantise(frames, out.data(), 1);
}

std::vector<std::int32_t> Codebook::quantise(ConstMatrixRefF frames) const {
  std::vector<std::int32_t> symbols(static_cast<std::size_t>(frames.rows()));
  quantise(frames, symbols.data(), 1);
  return symbols;
}

double Codebook::distortion(ConstMatrixRefF frames) const {
  require(frames.rows() > 0, "frames must have rows");
  const std::vector<std::int32_t> cells = quantise(frames);
  double sum = 0;
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const float* centroid = centroids_.row(cells[static_cast<std::size_t>(t)]).data();
    const float* frame = frames.data() + t * frames.outerStride();
    sum += static_cast<double>(detail::squared_distance(frame, centroid, dim()));
  }
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
