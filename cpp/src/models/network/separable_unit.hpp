// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The layer that SequenceNetwork is made of: a time-channel separable convolution. Every channel is
// filtered along time by a kernel of its own, then every frame is multiplied by one matrix
// (Kriman et al., "QuartzNet", ICASSP 2020). Frames are rows, channels columns.
#pragma once

#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Sequences one below the other in one matrix: where each begins, and behind them the number of
/// all rows.
using RowOffsets = std::vector<Eigen::Index>;

/// Rows that `step` leaves of every sequence: those of the 1st, the (1 + step)th ... frame.
RowOffsets thinned(const RowOffsets& offsets, int step);

/// y(t, c) = sum over k of kernel(k, c) x(t step + k - K / 2, c) within each sequence, whose frames
/// have zeros around them.
void filter(const MatrixF& x, const RowOffsets& offsets, ConstMatrixRefF kernel, int step,
            MatrixF* y);

/// The slopes of a loss by `kernel` and by x, from those by y.
void filter_slopes(const MatrixF& x, const RowOffsets& offsets, ConstMatrixRefF kernel, int step,
                   const MatrixF& by_y, MatrixF* by_kernel, MatrixF* by_x);

}  // namespace hri::detail
