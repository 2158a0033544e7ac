// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What every model of rows demands of its input.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Of a row that belongs to no class.
constexpr int kNoClass = -1;

/// Throws InvalidArgument unless every value is finite; the message names `what`, row and column.
HRI_API void validate_finite(ConstMatrixRefF rows, const char* what);

/// Throws InvalidArgument unless the row has `dim` values, all finite; the message names the index.
HRI_API void validate_row(Span<const float> row, int dim);

/// Throws InvalidArgument unless the rows have `dim` columns.
HRI_API void validate_width(ConstMatrixRefF rows, int dim);

/// What every classifier of rows demands: throws InvalidArgument for shapes that differ, rows not
/// finite (names row and column), fewer than two classes, classes outside
/// lowest_class..num_classes - 1 or without a row (names them); kNoClass needs no row.
HRI_API void validate_rows(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                           int lowest_class = 0);

}  // namespace hri
