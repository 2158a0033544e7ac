// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/row_checks.hpp"

#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"

namespace hri {

void validate_finite(ConstMatrixRefF rows, const char* what) {
  // One walk over a contiguous matrix; the rows are looked at only to name the bad one.
  const auto size = static_cast<std::size_t>(rows.size());
  const bool contiguous = rows.rows() <= 1 || rows.outerStride() == rows.cols();
  if (contiguous && first_not_finite(rows.data(), size) == size) return;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const auto dim = static_cast<std::size_t>(rows.cols());
    const std::size_t c = first_not_finite(rows.data() + r * rows.outerStride(), dim);
    if (c == dim) continue;
    fail(ErrorKind::invalid_argument,
         std::string(what) + " are not finite at row " + std::to_string(r) + ", column " +
             std::to_string(c) + ": " + std::to_string(rows(r, static_cast<Eigen::Index>(c))));
  }
}

void validate_row(Span<const float> row, int dim) {
  if (row.size() != static_cast<std::size_t>(dim)) {
    fail(ErrorKind::invalid_argument,
         "row has " + std::to_string(row.size()) + " values, the model has " + std::to_string(dim));
  }
  const std::size_t i = first_not_finite(row.data(), row.size());
  if (i < row.size()) {
    fail(ErrorKind::invalid_argument,
         "row[" + std::to_string(i) + "] is not finite: " + std::to_string(row[i]));
  }
}

void validate_width(ConstMatrixRefF rows, int dim) {
  if (rows.cols() != dim) {
    fail(ErrorKind::invalid_argument, "rows have " + std::to_string(rows.cols()) +
                                          " columns, the model has " + std::to_string(dim));
  }
}

void validate_rows(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                   int lowest_class) {
  require(rows.rows() > 0 && rows.cols() > 0, "training needs at least one row and column");
  if (static_cast<std::size_t>(rows.rows()) != classes.size()) {
    fail(ErrorKind::invalid_argument, "there are " + std::to_string(rows.rows()) + " rows and " +
                                          std::to_string(classes.size()) + " classes");
  }
  require(num_classes >= 2, "num_classes must be at least 2");
  validate_finite(rows, "rows");
  std::vector<int> counts(static_cast<std::size_t>(num_classes), 0);
  for (std::size_t r = 0; r < classes.size(); ++r) {
    if (classes[r] < lowest_class || classes[r] >= num_classes) {
      fail(ErrorKind::invalid_argument,
           "row " + std::to_string(r) + ": class " + std::to_string(classes[r]) + " lies outside " +
               std::to_string(lowest_class) + ".." + std::to_string(num_classes - 1));
    }
    if (classes[r] != kNoClass) ++counts[static_cast<std::size_t>(classes[r])];
  }
  for (int c = 0; c < num_classes; ++c) {
    if (counts[static_cast<std::size_t>(c)] == 0) {
      fail(ErrorKind::invalid_argument, "class " + std::to_string(c) + " has no row");
    }
  }
}

}  // namespace hri
