// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Static coefficients of one kind from those of another that says more.
#pragma once

#include "hri/core/types.hpp"
#include "hri/htk/feature_extractor.hpp"

namespace hri::htk::detail {

/// Whether frames of the one base kind can become the other: filters cepstra, linear prediction its
/// reflection coefficients and cepstra, and reflection coefficients the same.
bool is_convertible(BaseKind from, BaseKind to);

/// `statics` of kind `from`, its energy behind the others where it has _E, as base kind `to`; c0
/// stands behind the cepstra where `with_c0`. Reflection coefficients have HTK's sign.
MatrixF converted_statics(const MatrixF& statics, ParameterKind from, BaseKind to, bool with_c0,
                          const HtkFeatureOptions& options);

/// Reflection coefficients of a predictor, by Levinson's recursion backwards (HTK Book, section
/// 5.3): k[i] = -a[i] of order i. Throws InvalidArgument where one is not within -1..1.
void reflection_coefficients(Span<const double> a, Span<double> k);

}  // namespace hri::htk::detail
