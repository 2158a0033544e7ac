// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hands of a person in a room, whose face is seen. The face shows the colours of the person's
// skin and how large a hand is; the room within reach shows which of these colours are also those
// of walls and furniture. A pixel is skin by the ratio of two histograms of Cr and Cb (Jones and
// Rehg 2002), that of the face and that of the room.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/vision/face_finder.hpp"

namespace hri {

struct HRI_API PersonOptions {
  int face_side_px = 32;
  double reach = 4.8;
  double signing_reach = 3.2;
  double min_area = 0.06;
  double max_area = 2.2;
  double min_log_ratio = 0;
  int num_rounds = 1;
  int face_interval = 5;
  int max_hands = 1;

  static constexpr const char* kName = "PersonOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("face_side_px", o.face_side_px, within(8, 512),
      "pictures with larger faces are scaled down to this first");
    v("reach", o.reach, within(0.5, 10),
      "distance of a hand's centre from that of the face, at most, in sides of the face");
    v("signing_reach", o.signing_reach, within(0.5, 10),
      "where one hand is looked for, one farther away hangs: it is chosen where there is no other");
    v("min_area", o.min_area, within(0, 100), "smallest area of a hand, in areas of the face");
    v("max_area", o.max_area, within(0, 100), "largest");
    v("min_log_ratio", o.min_log_ratio, within(-4, 4),
      "from which logarithm of the ratio of the histograms of skin and room on a pixel is skin");
    v("num_rounds", o.num_rounds, within(0, 10),
      "rounds of adding the colours of the hand that was found to those of the face");
    v("face_interval", o.face_interval, within(1, 1000),
      "the face is looked for in one frame of so many");
    v("max_hands", o.max_hands, within(1, 2),
      "regions that masks hold, the most likely; HandPairTracker decides which is which");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads.
class HRI_API PersonHands {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit PersonHands(const PersonOptions& options = {});

  /// The hands of the person with this face; the observation has the size of the scaled picture.
  /// Its quality is that of the mask in its own surroundings (the hand's rectangle, grown by half
  /// its sides), as hands are small in pictures of rooms; of two hands, the lower one. Throws
  /// InvalidArgument for a picture that has not three channels and at least one pixel, and for a
  /// face without a size or whose centre lies outside it.
  [[nodiscard]] HandObservation extract(ImageView bgr, const Face& face) const;

  /// The same into a silhouette whose memory is used again.
  void extract(ImageView bgr, const Face& face, HandObservation* out) const;

  /// The hands in every frame of a clip. Nothing where a face is seen in less than half of the
  /// frames in which it is looked for, or where frames differ in size; between those frames it
  /// stays where it was. Its side is the median of the clip, so that masks are of one size. Throws
  /// InvalidArgument for a frame that is not a picture of three channels (names its index).
  [[nodiscard]] std::optional<std::vector<HandObservation>> find(
      Span<const ImageView> clip, const FaceFinder& faces,
      const FrameProgress& progress = {}) const;

 private:
  PersonOptions options_;
};

}  // namespace hri
