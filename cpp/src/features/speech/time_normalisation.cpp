// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/time_normalisation.hpp"

#include <algorithm>

#include "hri/core/error.hpp"

namespace hri {

MatrixF normalise_time(ConstMatrixRefF frames, int num_rows) {
  require(frames.rows() > 0, "frames has no row");
  require(num_rows >= 1, "num_rows must be at least 1");
  const auto last = static_cast<double>(frames.rows() - 1);
  MatrixF result(num_rows, frames.cols());
  for (int r = 0; r < num_rows; ++r) {
    const double place = num_rows == 1 ? 0.5 * last : last * r / (num_rows - 1);
    const Eigen::Index before =
        std::min(static_cast<Eigen::Index>(place), std::max<Eigen::Index>(frames.rows() - 2, 0));
    const Eigen::Index after = std::min(before + 1, frames.rows() - 1);
    const auto share = static_cast<float>(place - static_cast<double>(before));
    result.row(r) = (1.0F - share) * frames.row(before) + share * frames.row(after);
  }
  return result;
}

}  // namespace hri
