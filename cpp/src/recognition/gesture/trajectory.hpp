// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A gesture is a trajectory through shapes and places of the hand. It is resampled at a few points,
// spaced by how much changes rather than by time, so that pauses and tempo matter little.
#pragma once

#include "hri/core/types.hpp"

namespace hri::detail {

constexpr Eigen::Index kNumPoints = 8;  ///< of a trajectory
constexpr Eigen::Index kFewRows = 8;    ///< in which no rest is looked for

/// The trajectory of a gesture as one vector of kNumPoints points; the place of the hand counts
/// from where it began. A single row gives the trajectory of a hand that does not move.
/// `shape_scale` brings shapes to unit length.
VectorF trajectory_vector(ConstMatrixRefF gesture, float shape_scale);

/// Where a gesture rests, by its rows.
struct Rests {
  Eigen::Index first_stroke = 0;  ///< its first row; 0 where it does not begin at rest
  Eigen::Index final_stroke = 0;  ///< its first row; 0 where there is but one stroke
};

Rests find_rests(ConstMatrixRefF gesture, float shape_scale);

/// Log of how far the trajectory gets from its first point.
double max_displacement(const VectorF& trajectory);

}  // namespace hri::detail
