// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hand's silhouette in a colour picture (thesis sections 4.6.2 and 5.1.1), by fixed HSV bounds
// as in the thesis or, by default, by a chroma threshold that adapts to each picture's light.
#pragma once

#include <memory>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads.
class HRI_API SilhouetteExtractor {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit SilhouetteExtractor(const SilhouetteOptions& options);

  /// With a picture of the background alone, by the same camera in the same place: what looks like
  /// skin in one of the two pictures but not in the other is the person (thesis section 5.1.1,
  /// exclusive or of the two masks). Throws InvalidArgument for a background that has not three
  /// channels and at least one pixel; extract() for a picture of another size.
  SilhouetteExtractor(const SilhouetteOptions& options, ImageView background);

  /// `bgr` has 3 channels (blue, green, red). Throws InvalidArgument for another layout or an empty
  /// picture.
  [[nodiscard]] HandObservation extract(ImageView bgr) const;

  /// The same into a silhouette whose memory is used again. With the default method and blur,
  /// pictures of one size allocate nothing from the second on where their sides are whole multiples
  /// of the working ones and there is but one region of skin.
  void extract(ImageView bgr, HandObservation* out) const;

 private:
  struct Background;
  SilhouetteOptions options_;
  std::shared_ptr<const Background> background_;  // empty without one
};

}  // namespace hri
