// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Moments of a mask up to the third order, and Hu's seven invariants of them (IRE Trans.
// Information Theory 8, 1962). Every pixel above 0 weighs 1 and lies at its centre, as in OpenCV.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Sums over pixels of x^p y^q (m), of the same from the centroid (mu), and mu / m00^(1 + (p + q) /
/// 2) (nu). All 0 for an empty mask.
struct ShapeMoments {
  double m00 = 0, m10 = 0, m01 = 0;
  double m20 = 0, m11 = 0, m02 = 0;
  double m30 = 0, m21 = 0, m12 = 0, m03 = 0;
  double mu20 = 0, mu11 = 0, mu02 = 0;
  double mu30 = 0, mu21 = 0, mu12 = 0, mu03 = 0;
  double nu20 = 0, nu11 = 0, nu02 = 0;
  double nu30 = 0, nu21 = 0, nu12 = 0, nu03 = 0;
};

/// Of a one-channel mask.
HRI_API ShapeMoments shape_moments(ImageView mask);

/// The longer axis of the ellipse that has the same second moments.
struct ShapeAxis {
  double angle_rad = 0;   ///< from the x axis towards y (down), in (-pi / 2, pi / 2]
  double elongation = 0;  ///< 0 (round, no direction) .. 1 (a line)
};
HRI_API ShapeAxis shape_axis(const ShapeMoments& moments);

constexpr int kNumHuMoments = 7;

/// h1 .. h7: the same for a shape moved, scaled or turned; h7 changes its sign in a mirror.
HRI_API void hu_moments(const ShapeMoments& moments, Span<double> out);

/// The same as features: the root of each by its degree in the moments, with its sign, so that none
/// is many powers of ten smaller than the others. Throws InvalidArgument for an empty mask.
HRI_API void hu_features(ImageView mask, Span<float> out);

}  // namespace hri
