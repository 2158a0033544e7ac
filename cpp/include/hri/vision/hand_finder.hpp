// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hands in clips and streams of colour pictures: by the colours that hand and background have in
// this clip or stream where they can be learned, else in every picture by itself.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/vision/person_hands.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads.
class HRI_API HandFinder : public HandSource {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit HandFinder(const HandFinderOptions& options = {});

  /// With a picture of the place without a person, by the same camera: every picture is segmented
  /// by itself, and what looks like skin in it or in the background, but not in both, is the hand.
  HandFinder(const HandFinderOptions& options, ImageView background);

  /// With a finder of faces: in clips in which a face is seen, hands are found as that person's
  /// (PersonHands), in others as without it; in streams, while one is seen in at least half of the
  /// last six looks. `person.max_hands` is ignored: find() looks for one hand, find_pair() for
  /// both. Throws InvalidArgument without a finder.
  HandFinder(const HandFinderOptions& options, std::shared_ptr<const FaceFinder> faces,
             const PersonOptions& person = {});

  [[nodiscard]] const HandFinderOptions& options() const { return options_; }

  using HandSource::find;
  using HandSource::find_pair;
  using HandSource::stream;
  /// Learns from clips of min_frames or more; shorter clips, and those in which no hand stands out,
  /// are segmented picture by picture. Throws InvalidArgument for a frame that is not a picture of
  /// three channels (names its index).
  [[nodiscard]] std::vector<HandObservation> find(Span<const ImageView> clip,
                                                  const FrameProgress& progress) const override;

  /// Both hands: that of the left side of the picture, then that of the right one, as they were
  /// when both were first seen; labels go with the hands when these touch or cross
  /// (HandPairTracker). Without a finder of faces, a face in view may be mistaken for a hand.
  [[nodiscard]] std::array<std::vector<HandObservation>, 2> find_pair(
      Span<const ImageView> clip, const FrameProgress& progress) const override;

  /// Learns colours from the last two seconds of the stream where `dynamic` and the options say
  /// so: after the first second, then looked after once a second, but never again in the middle of
  /// a gesture. New ones are taken when they show something that moves and the old ones do not, or
  /// show it more clearly. Until there are any, every picture is segmented by itself. Keeps copies
  /// of eight pictures.
  [[nodiscard]] std::unique_ptr<HandStream> stream(bool dynamic, int max_hands) const override;

 private:
  [[nodiscard]] std::vector<HandObservation> find(Span<const ImageView> clip, int max_hands,
                                                  const FrameProgress& progress,
                                                  bool* by_person) const;

  HandFinderOptions options_;
  std::shared_ptr<const FaceFinder> faces_;  // empty without one
  PersonOptions person_;
  std::vector<std::uint8_t> background_;  // empty without one
  int background_width_px_ = 0;
  int background_height_px_ = 0;
};

/// What a clip shows behind the person who moves in it: every pixel's median over up to 25 frames
/// spread over the clip, with three channels. What stays in place for half of the clip is part of
/// it. Throws InvalidArgument for a clip without frames, or of frames that differ in size.
HRI_API std::vector<std::uint8_t> background_of(Span<const ImageView> clip);

}  // namespace hri
