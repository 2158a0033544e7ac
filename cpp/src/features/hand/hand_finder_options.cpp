// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_finder_options.hpp"

namespace hri {

const char* SilhouetteOptions::conflict() const {
  if (min_contrast > sure_contrast) return "min_contrast must not exceed sure_contrast";
  return min_area <= max_area ? nullptr : "min_area must not exceed max_area";
}

const char* HandColourOptions::conflict() const {
  return min_area <= max_area ? nullptr : "min_area must not exceed max_area";
}

}  // namespace hri
