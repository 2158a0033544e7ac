// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/knn.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {

Knn Knn::train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
               const KnnOptions& options) {
  validate_rows(rows, classes, num_classes);
  validate(options);
  Knn model;
  model.rows_ = rows;
  model.classes_.assign(classes.begin(), classes.end());
  model.num_classes_ = num_classes;
  model.num_neighbours_ = options.num_neighbours;
  return model;
}

VectorF Knn::squared_distances(Span<const float> row) const {
  validate_row(row, dim());
  const Eigen::Map<const VectorF> x(row.data(), dim());
  return (rows_.rowwise() - x.transpose()).rowwise().squaredNorm();
}

VectorF Knn::decision_values(Span<const float> row) const {
  const VectorF distances = squared_distances(row);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(distances.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const std::size_t k = std::min(order.size(), static_cast<std::size_t>(num_neighbours_));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k), order.end(),
                    [&](Eigen::Index a, Eigen::Index b) {
                      return distances[a] < distances[b] || (distances[a] == distances[b] && a < b);
                    });
  VectorF votes = VectorF::Zero(num_classes_);
  std::vector<bool> met(static_cast<std::size_t>(num_classes_), false);
  float bonus = 1e-3F;
  for (std::size_t i = 0; i < k; ++i) {
    const int c = classes_[static_cast<std::size_t>(order[i])];
    votes[c] += 1.0F / static_cast<float>(k);
    if (met[static_cast<std::size_t>(c)]) continue;
    met[static_cast<std::size_t>(c)] = true;
    votes[c] += bonus;
    bonus *= 0.5F;
  }
  return votes;
}

float Knn::nearest_distance(Span<const float> row) const {
  return std::sqrt(squared_distances(row).minCoeff());
}

void Knn::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "rows", rows_);
  VectorF classes(static_cast<Eigen::Index>(classes_.size()));
  for (std::size_t i = 0; i < classes_.size(); ++i)
    classes[static_cast<Eigen::Index>(i)] = static_cast<float>(classes_[i]);
  file.set_vector(prefix + "classes", classes);
  file.set_integer(prefix + "num_classes", num_classes_);
  file.set_integer(prefix + "num_neighbours", num_neighbours_);
}

Knn Knn::read(const ModelFile& file, const std::string& prefix) {
  Knn model;
  model.rows_ = file.matrix_f(prefix + "rows");
  const VectorF classes = file.vector_f(prefix + "classes");
  const std::int64_t num_classes = file.integer(prefix + "num_classes");
  const std::int64_t k = file.integer(prefix + "num_neighbours");
  if (model.rows_.size() == 0 || classes.size() != model.rows_.rows() || num_classes < 2 ||
      num_classes > 1000000 || k < 1 || k > 1000) {
    fail(ErrorKind::format,
         file.name() + ": field '" + prefix + "rows' does not fit classes or num_neighbours");
  }
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
