// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sequences of any length brought to one length, for classifiers of fixed-length vectors.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// `frames` stretched or squeezed to `num_rows` rows by linear interpolation; the first and the
/// last row stay (one row alone: the middle). Throws InvalidArgument for no frames or num_rows
/// below 1.
HRI_API MatrixF normalise_time(ConstMatrixRefF frames, int num_rows);

}  // namespace hri
