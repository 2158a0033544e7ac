// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A movement is a path through shapes and places of the hand. It is resampled at a few points,
// spaced by how much changes rather than by time, so that pauses and tempo matter little.
#pragma once

#include "hri/core/types.hpp"

namespace hri::detail {

constexpr Eigen::Index kNumPoints = 8;  ///< of a path
constexpr Eigen::Index kFewRows = 8;    ///< in which no rest is looked for

/// The path of a gesture as one vector of kNumPoints points; the place of the hand counts from
/// where it began. A single row gives the path of a hand that does not move. `shape_scale` brings
/// shapes to unit length.
VectorF path_vector(ConstMatrixRefF gesture, float shape_scale);

/// Where a gesture rests, by its rows.
struct Rests {
  Eigen::Index first_movement = 0;  ///< its first row; 0 where it does not begin at rest
  Eigen::Index last_movement = 0;   ///< its first row; 0 where there is but one movement
};

Rests find_rests(ConstMatrixRefF gesture, float shape_scale);

/// Log of how far the path gets from its first point.
double max_displacement(const VectorF& path);

}  // namespace hri::detail
