// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HCompV: every Gaussian of a prototype at the mean and the variance of all frames, from which
// embedded training begins where no recording is segmented.
#pragma once

#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/model_set.hpp"

namespace hri::htk {

/// Sums over frames; their size does not depend on how many these are. Not for several threads.
class HRI_API FlatStart {
 public:
  /// Adds `frames` (num_frames, num_columns). Throws InvalidArgument for another number of columns
  /// than before, and values not finite.
  void add(ConstMatrixRefF frames);

  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }
  /// Of all frames, (num_columns); the variance divides by the number of frames. Throw
  /// InvalidArgument where there is none.
  [[nodiscard]] VectorD mean() const;
  [[nodiscard]] VectorD variance() const;

  /// The models with the variance in every Gaussian, at least `min_variance` each, and with
  /// `update_means` the mean. Throws InvalidArgument for models of another number of columns or
  /// discrete ones, a `min_variance` that is negative, and a column that is constant where that is
  /// 0.
  [[nodiscard]] ModelSet apply(const ModelSet& models, bool update_means,
                               double min_variance = 0) const;

  /// ~v "varFloor1" of `share` times the variance. Throws InvalidArgument for a share that is not
  /// above 0, and for a constant column.
  [[nodiscard]] ModelSet variance_floors(double share) const;

 private:
  std::int64_t num_frames_ = 0;
  VectorD origin_;  // the first frame: sums about it keep their digits
  VectorD sum_;
  VectorD squares_;
};

}  // namespace hri::htk
