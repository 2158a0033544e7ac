// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/knn.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "models/classifiers/row_kernels.hpp"

namespace hri {
namespace {

constexpr std::ptrdiff_t kRowsAtOnce = 32;    // rows asked for, and rows of the table beside them:
constexpr std::ptrdiff_t kTableAtOnce = 256;  // their distances stay in the first cache

struct Neighbour {
  float distance = 0;  // squared
  std::ptrdiff_t row = 0;
};

bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.distance < b.distance || (a.distance == b.distance && a.row < b.row);
}

// The nearest rows so far, the least near of them on top.
class Nearest {
 public:
  explicit Nearest(std::size_t count) : count_(count) { found_.reserve(count); }
  void clear() { found_.clear(); }

  // Distances of the table's rows first, first + 1, ... that come behind those added before.
  void add(const float* distances, std::ptrdiff_t first, std::ptrdiff_t count) {
    std::ptrdiff_t i = 0;
    for (; i < count && found_.size() < count_; ++i) {
      found_.push_back({distances[i], first + i});
      std::push_heap(found_.begin(), found_.end(), nearer);
    }
    // Of rows as far away those that came first stay.
    while ((i = kernels_.first_below(distances, i, count, found_.front().distance)) < count) {
      std::pop_heap(found_.begin(), found_.end(), nearer);
      found_.back() = {distances[i], first + i};
      std::push_heap(found_.begin(), found_.end(), nearer);
      ++i;
    }
  }

  // All of them, from near to far.
  Span<const Neighbour> sorted() {
    std::sort_heap(found_.begin(), found_.end(), nearer);
    return found_;
  }

 private:
  const detail::RowKernels& kernels_ = detail::row_kernels();
  std::size_t count_;
  std::vector<Neighbour> found_;
};

// Calls use(r, neighbours) for row r of `rows` with the `count` rows of the table that are nearest.
template <class Use>
void for_nearest(ConstMatrixRefF rows, const detail::RowTable& table, std::size_t count,
                 const Use& use) {
  const detail::RowKernels& kernels = detail::row_kernels();
  const std::ptrdiff_t num_rows = rows.rows();
  const std::ptrdiff_t together = std::min(kRowsAtOnce, num_rows);
  const std::ptrdiff_t beside = std::min(kTableAtOnce, table.padded_rows());
  std::vector<float> distances(static_cast<std::size_t>(together * beside));
  std::vector<Nearest> nearest;
  nearest.reserve(static_cast<std::size_t>(together));
  for (std::ptrdiff_t r = 0; r < together; ++r) nearest.emplace_back(count);
  for (std::ptrdiff_t first = 0; first < num_rows; first += together) {
    const std::ptrdiff_t now = std::min(together, num_rows - first);
    for (std::ptrdiff_t r = 0; r < now; ++r) nearest[static_cast<std::size_t>(r)].clear();
    for (std::ptrdiff_t k = 0; k < table.rows(); k += beside) {
      kernels.squared_distances(rows.data() + first * rows.outerStride(), rows.outerStride(), now,
                                table.layout(), k, std::min(beside, table.padded_rows() - k),
                                distances.data(), beside);
      for (std::ptrdiff_t r = 0; r < now; ++r) {
        nearest[static_cast<std::size_t>(r)].add(distances.data() + r * beside, k,
                                                 std::min(beside, table.rows() - k));
      }
    }
    for (std::ptrdiff_t r = 0; r < now; ++r)
      use(first + r, nearest[static_cast<std::size_t>(r)].sorted());
  }
}

}  // namespace

void Knn::keep(ConstMatrixRefF rows) {
  rows_ = std::make_shared<const detail::RowTable>(rows);
  dim_ = static_cast<int>(rows.cols());
}

Knn Knn::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
               const KnnOptions& options) {
  validate_rows(rows, classes, num_classes);
  validate(options);
  Knn model;
  model.keep(rows);
  model.classes_.assign(classes.begin(), classes.end());
  model.num_classes_ = num_classes;
  model.num_neighbours_ = options.num_neighbours;
  return model;
}

Knn Knn::with_class(int index, ConstMatrixRefF rows) const {
  require(index >= 0 && index <= num_classes_, "index must be a class or the next one");
  require(rows.rows() > 0, "rows must not be empty");
  validate_width(rows, dim());
  validate_finite(rows, "rows");
  MatrixF all(rows_->rows() + rows.rows(), rows.cols());
  all << rows_->matrix(), rows;
  Knn model;
  model.keep(all);
  model.classes_ = classes_;
  for (int& c : model.classes_) c += c < index ? 0 : 1;
  model.classes_.insert(model.classes_.end(), static_cast<std::size_t>(rows.rows()), index);
  model.num_classes_ = num_classes_ + 1;
  model.num_neighbours_ = num_neighbours_;
  return model;
}

VectorF Knn::decision_values(Span<const float> row) const {
  validate_row(row, dim());
  return decision_values(Eigen::Map<const MatrixF>(row.data(), 1, dim())).row(0).transpose();
}

MatrixF Knn::decision_values(ConstMatrixRefF rows) const {
  validate_width(rows, dim());
  validate_finite(rows, "rows");
  MatrixF values = MatrixF::Zero(rows.rows(), num_classes_);
  const std::size_t k = std::min(classes_.size(), static_cast<std::size_t>(num_neighbours_));
  const float vote = 1.0F / static_cast<float>(k);
  std::vector<std::ptrdiff_t> met(static_cast<std::size_t>(num_classes_), -1);
  for_nearest(rows, *rows_, k, [&](std::ptrdiff_t r, Span<const Neighbour> neighbours) {
    float bonus = 1e-3F;
    for (const Neighbour& neighbour : neighbours) {
      const int c = classes_[static_cast<std::size_t>(neighbour.row)];
      values(r, c) += vote;
      std::ptrdiff_t& last_met = met[static_cast<std::size_t>(c)];
      if (last_met == r) continue;
      last_met = r;
      values(r, c) += bonus;
      bonus *= 0.5F;
    }
  });
  return values;
}

float Knn::nearest_distance(Span<const float> row) const {
  validate_row(row, dim());
  float distance = 0;
  for_nearest(Eigen::Map<const MatrixF>(row.data(), 1, dim()), *rows_, 1,
              [&](std::ptrdiff_t /*r*/, Span<const Neighbour> neighbours) {
                distance = std::sqrt(neighbours[0].distance);
              });
  return distance;
}

void Knn::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "rows", rows_->matrix());
  VectorF classes(static_cast<Eigen::Index>(classes_.size()));
  for (std::size_t i = 0; i < classes_.size(); ++i)
    classes[static_cast<Eigen::Index>(i)] = static_cast<float>(classes_[i]);
  file.set_vector(prefix + "classes", classes);
  file.set_integer(prefix + "num_classes", num_classes_);
  file.set_integer(prefix + "num_neighbours", num_neighbours_);
}

Knn Knn::read(const ModelFile& file, const std::string& prefix) {
  Knn model;
  const MatrixF rows = file.matrix_f(prefix + "rows");
  const VectorF classes = file.vector_f(prefix + "classes");
  const std::int64_t num_classes = file.integer(prefix + "num_classes");
  const std::int64_t k = file.integer(prefix + "num_neighbours");
  if (rows.size() == 0 || classes.size() != rows.rows() || num_classes < 2 ||
      num_classes > 1000000 || k < 1 || k > 1000) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "rows' does not fit classes or num_neighbours");
  }
  model.keep(rows);
  model.num_classes_ = static_cast<int>(num_classes);
  model.num_neighbours_ = static_cast<int>(k);
  for (const float c : classes) {
    if (c < 0 || c >= static_cast<float>(num_classes) || c != std::floor(c)) {
      fail(ErrorKind::format,
           file.name() + ": field '" + prefix + "classes' holds " + std::to_string(c));
    }
    model.classes_.push_back(static_cast<int>(c));
  }
  return model;
}

}  // namespace hri
