// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Clips of NumPy arrays as views.
#pragma once

#include <string>
#include <vector>

#include "core/arrays.hpp"

namespace hri_bind {

inline std::vector<hri::ImageView> as_clip(const std::vector<ByteArray>& clip) {
  std::vector<hri::ImageView> views;
  views.reserve(clip.size());
  for (std::size_t i = 0; i < clip.size(); ++i)
    views.push_back(as_image(clip[i], 3, ("frame " + std::to_string(i)).c_str()));
  return views;
}

}  // namespace hri_bind
