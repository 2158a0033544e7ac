// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Copies of training gestures with the hand turned in the plane of the picture. People hold their
// hands at other angles than those who were recorded, in front of cameras that hang at others.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "recognition/gesture/trajectory_centres.hpp"

namespace hri::detail {

/// Appends two copies of every trajectory, whose hands are turned by options.turn_degrees to either
/// side; none for 0. Points have `num_columns` values, at the beginning the shape of one hand, or
/// of two, as the options say; what follows stays, and rows of other kinds are not copied.
void append_turned(const GestureRecognizerOptions& options, Eigen::Index num_columns,
                   std::vector<KnownTrajectory>* trajectories);

}  // namespace hri::detail
