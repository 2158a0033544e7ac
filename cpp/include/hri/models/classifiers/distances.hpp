// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Distances between feature vectors, histograms and Gaussians (thesis section 6.2 compares the
// first three).
#pragma once

#include <array>
#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

enum class Distance : std::uint8_t {
  euclidean,
  manhattan,
  cosine,         ///< 1 - cosine of the angle; 1 where a vector is zero
  bhattacharyya,  ///< of two histograms: -log sum sqrt(p q) after scaling each to sum 1; entries
                  ///< must be >= 0
};
constexpr auto enum_names(Distance) {
  return std::array{"euclidean", "manhattan", "cosine", "bhattacharyya"};
}

/// Distance of two vectors of one length, accumulated in double. Throws InvalidArgument for lengths
/// that differ, and for what bhattacharyya cannot take: negative entries or a sum of zero. Disjoint
/// histograms are infinitely far.
HRI_API double distance(Distance kind, Span<const float> a, Span<const float> b);

/// Bhattacharyya distance of two Gaussians (Fukunaga, Statistical Pattern Recognition, eq. 3.152):
/// 1/8 d' S^-1 d + 1/2 log(|S| / sqrt(|S_a| |S_b|)) with S the mean covariance and d the difference
/// of means. Throws InvalidArgument for shapes that differ or covariances that are not positive
/// definite.
HRI_API double bhattacharyya_gaussian(const VectorD& mean_a, ConstMatrixRefD covariance_a,
                                      const VectorD& mean_b, ConstMatrixRefD covariance_b);

}  // namespace hri
