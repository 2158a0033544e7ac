// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What qualifiers add to static coefficients.
#pragma once

#include "hri/core/types.hpp"
#include "hri/htk/feature_extractor.hpp"

namespace hri::htk::detail {

/// `statics` with the differences that `kind` has behind them, and with the mean of all columns but
/// the energy subtracted where it has _Z.
MatrixF with_differences(const MatrixF& statics, ParameterKind kind,
                         const HtkFeatureOptions& options);

/// Without the column of the absolute energy, or of c0 where there is none.
MatrixF without_energy(const MatrixF& frames, ParameterKind kind);

}  // namespace hri::htk::detail
