// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Where a still sign is held within a clip: hands are raised and lowered around it, and those
// frames show something else (thesis section 5.3, key frames).
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Frames [first, last) of a clip.
struct FrameRange {
  Eigen::Index first = 0;
  Eigen::Index last = 0;
};

/// The longest part of a clip in which the hand stays nearly as still as in its stillest quarter.
/// Change from frame to frame is measured on the hand's shape and on its track, each relative to
/// its mean over the clip, and averaged over five frames; clips of fewer than eight frames are kept
/// whole.
///
/// `features` has a row a frame, as GestureRecognizer::features gives them; its last
/// `num_track_columns` columns are the track.
HRI_API FrameRange key_frames(ConstMatrixRefF features, Eigen::Index num_track_columns);

}  // namespace hri
