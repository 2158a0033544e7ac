// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Where a hand is in its picture: the one definition of its centre.
#pragma once

#include <optional>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"

namespace hri {

/// In shares of the picture, 0..1. A pixel's centre lies half a pixel from its corner: the centre
/// of a hand that fills the picture is 0.5, 0.5.
struct HandPlace {
  double x = 0;
  double y = 0;
  double area = 0;
};

/// Nothing for a mask that is empty or all 0.
HRI_API std::optional<HandPlace> hand_place(ImageView mask);

}  // namespace hri
