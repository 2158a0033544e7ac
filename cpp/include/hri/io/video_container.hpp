// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a video file says of its own length. Decoders play what is there of a file that was cut, and
// report no error; but half a gesture may be another one.
#pragma once

#include <string>

#include "hri/core/export.hpp"

namespace hri {

/// Throws IoError as `require_regular_file`, and FormatError for an AVI, MP4, QuickTime, Matroska
/// or WebM file that is shorter than its sizes say, and for any other: what else decoders read may
/// be a list that names other files. Sizes that were never filled in, as in a stream, say nothing.
HRI_API void require_whole_video(const std::string& path);

}  // namespace hri
