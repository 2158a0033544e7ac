// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Where observations of hands come from: hri/vision finds them in colour pictures; a program that
// has another camera or segmentation implements this.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// What was found in one picture, at the working scale. `mask` (255 is hand) has the size of
/// `grey`; without a hand it is all 0.
///
/// The quality is a product of four shares. Separation: the between-class share of the variance of
/// the values by which the hand was found (scores of colours, redness or grey), of pixels one pixel
/// off the outline on both sides. Size: 1 where the mask covers 3 to 35 % of the picture, down to 0
/// at 0.2 % (by logarithms) and 80 %. Border: 1 where it covers up to 20 % of the upper and side
/// borders, down to 0 at 50 %: there hands rarely are, and walls always. Outline: less than 1 where
/// rows cross it more often than an open hand, as in noise.
struct HandObservation {
  GreyImage grey;
  GreyImage mask;
  double quality = 0;     ///< 0 (no hand) .. 1: how far the mask can be trusted
  bool repaired = false;  ///< by the frames around it, see smooth_masks()
  bool touching = false;  ///< of one of two hands: one region holds both, the border between them
                          ///< is a guess
};

/// Called with how many frames of a clip are done, and of how many.
using FrameProgress = std::function<void(int done, int total)>;

/// The hand in one stream of pictures, or both in one mask. Not to be shared by threads.
class HRI_API HandStream {
 public:
  HandStream() = default;
  HandStream(const HandStream&) = delete;
  HandStream& operator=(const HandStream&) = delete;
  virtual ~HandStream() = default;

  /// The hand in the next picture (BGR); times never fall. `in_gesture` says that a gesture is
  /// being shown, in which the way hands are found should not change. What is returned is
  /// overwritten by the next call.
  virtual const HandObservation& push(ImageView bgr, double time_s, bool in_gesture) = 0;

  /// Whether hands are found in another way since the last picture, so that they look different
  /// although nothing moved.
  [[nodiscard]] virtual bool renewed() const { return false; }
};

/// Finds hands in clips and streams. Const calls are safe from several threads.
class HRI_API HandSource {
 public:
  HandSource() = default;
  HandSource(const HandSource&) = default;
  HandSource& operator=(const HandSource&) = default;
  virtual ~HandSource() = default;

  /// The hand in every frame of a clip, BGR.
  [[nodiscard]] virtual std::vector<HandObservation> find(Span<const ImageView> clip,
                                                          const FrameProgress& progress) const = 0;
  [[nodiscard]] std::vector<HandObservation> find(Span<const ImageView> clip) const {
    return find(clip, {});
  }

  /// Both hands: that of the left side of the picture, then that of the right one, as they were
  /// when both were first seen; labels go with the hands when these touch or cross. Throws
  /// InvalidArgument where the source finds one hand only.
  [[nodiscard]] virtual std::array<std::vector<HandObservation>, 2> find_pair(
      Span<const ImageView> clip, const FrameProgress& progress) const;
  [[nodiscard]] std::array<std::vector<HandObservation>, 2> find_pair(
      Span<const ImageView> clip) const {
    return find_pair(clip, {});
  }

  /// A stream of its own, whose masks hold up to `max_hands` hands (HandPairTracker decides which
  /// is which). `dynamic` says that gestures are movements of the hand rather than signs that it
  /// holds: then colours may be learned while it moves.
  [[nodiscard]] virtual std::unique_ptr<HandStream> stream(bool dynamic, int max_hands) const = 0;
  [[nodiscard]] std::unique_ptr<HandStream> stream(bool dynamic) const {
    return stream(dynamic, 1);
  }
};

}  // namespace hri
