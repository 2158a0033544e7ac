// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_source.hpp"

#include "hri/core/error.hpp"

namespace hri {

std::array<std::vector<HandObservation>, 2> HandSource::find_pair(
    Span<const ImageView> /*clip*/, const FrameProgress& /*progress*/) const {
  fail(ErrorKind::invalid_argument, "this source finds one hand only");
}

}  // namespace hri
