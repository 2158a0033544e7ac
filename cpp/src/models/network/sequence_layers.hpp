// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What training and use of SequenceNetwork have in common.
#pragma once

#include "hri/core/types.hpp"
#include "models/network/product_kernels.hpp"

namespace hri::detail {

/// Frames from one output of the first convolution to the next.
constexpr int kFirstStep = 2;
constexpr int kMaxNetworkSize = 4096;

template <class Index>
Index whole_columns(Index columns) {
  return (columns + kProductColumns - 1) / kProductColumns * kProductColumns;
}

/// `frames` with columns of zeros, so that there is a multiple of kProductColumns.
inline MatrixF with_whole_columns(ConstMatrixRefF frames) {
  MatrixF result = MatrixF::Zero(frames.rows(), whole_columns(frames.cols()));
  result.leftCols(frames.cols()) = frames;
  return result;
}

}  // namespace hri::detail
