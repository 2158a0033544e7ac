// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "models/hmm/mixture_kernels.hpp"
#include "models/hmm/mixture_training.hpp"

namespace hri::detail {

// The kernel weighs distances; here every weight is 1.
NearestCentre::NearestCentre(const MatrixD& centres)
    : centres_(centres),
      columns_(static_cast<std::size_t>(2 * centres.cols() * padded(centres.rows())), 1.0),
      distances_(static_cast<std::size_t>(padded(centres.rows()))) {
  const std::ptrdiff_t stride = padded(centres.rows());
  for (Eigen::Index k = 0; k < centres.rows(); ++k) {
    for (Eigen::Index d = 0; d < centres.cols(); ++d)
      columns_[static_cast<std::size_t>(d * stride + k)] = centres(k, d);
  }
}

int NearestCentre::find(const double* row) {
  const auto dim = static_cast<int>(centres_.cols());
  const auto stride = static_cast<std::ptrdiff_t>(distances_.size());
  mixture_kernels().distances(row, {columns_.data(), columns_.data() + dim * stride, stride, dim},
                              distances_.data());
  double best = std::numeric_limits<double>::infinity();
  double second = best;
  int place = 0;
  for (int k = 0; k < static_cast<int>(centres_.rows()); ++k) {
    const double distance = distances_[static_cast<std::size_t>(k)];
    if (distance < best) {
      second = best;
      best = distance;
      place = k;
    } else if (distance < second) {
      second = distance;
    }
  }
  // Sums of the same squares in another order differ by dim epsilons at most.
  const double sure = 1 + 4 * dim * std::numeric_limits<double>::epsilon();
  if (second > best * sure) return place;
  Eigen::Index exact = 0;
  (centres_.rowwise() - Eigen::Map<const Eigen::RowVectorXd>(row, dim))
      .rowwise()
      .squaredNorm()
      .minCoeff(&exact);
  return static_cast<int>(exact);
}

}  // namespace hri::detail
