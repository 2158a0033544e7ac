// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How hands are found in pictures. Kept apart from hri/vision, which finds them, so that a
// recogniser can own and save its finder's options without OpenCV.
#pragma once

#include <cstdint>

#include "hri/core/export.hpp"

namespace hri {

enum class SilhouetteMethod : std::uint8_t {
  chroma_otsu,  ///< Otsu's threshold on Cr - Cb: skin is redder than what is behind it, in any
                ///< light that has colour
  hsv,        ///< the thesis's fixed bounds of hue and saturation; fails in coloured or poor light
  grey_otsu,  ///< Otsu's threshold on grey, for a dark hand before a plain bright background
};

struct SilhouetteOptions {
  SilhouetteMethod method = SilhouetteMethod::chroma_otsu;
  int max_side_px = 320;  ///< larger pictures are scaled down to this first, 32..4096
  int blur_px = 5;        ///< Gaussian blur before and median after the threshold, odd, 1..31
  double min_contrast =
      1.5;                   ///< least difference of the two classes' means, in grey levels, 0..255
  double sure_contrast = 5;  ///< below this, as in poor light, the classes must also be well apart:
  double min_quality = 0.7;  ///< quality at least this, 0..1; camera noise alone gives 0.64
  double min_area = 0.005;   ///< smallest share of the picture a hand covers, 0..1
  double max_area = 0.8;     ///< largest, 0..1
  bool remove_face =
      true;           ///< of more skin regions than hands the one most like an ellipse is a face
  int max_hands = 1;  ///< regions that masks hold, the largest, 1..2; HandPairTracker tells which
                      ///< is which
};

struct HandColourOptions {
  int max_side_px = 160;   ///< pictures are scaled down to this before they are segmented, 32..4096
  int fit_side_px = 80;    ///< and to this for learning, 32..4096
  int num_fit_frames = 8;  ///< frames learned from, spread over the clip, 1..256
  int num_rounds = 4;      ///< of segmenting and learning from the segments, 1..100
  double min_area = 0.004;   ///< smallest share of the picture a hand covers, 0..1
  double max_area = 0.6;     ///< largest, averaged over the frames learned from, 0..1
  double min_quality = 0.3;  ///< a discriminant that separates the pixels on both sides of the
                             ///< hand's outline worse than this is no hand, 0..1
  bool remove_still = true;  ///< what has the hand's colours but stays in place while something
                             ///< else of them moves, such as a face, is no hand
  int max_hands = 1;         ///< regions that masks hold, the largest, 1..2; HandPairTracker tells
                             ///< which is which
};

struct MaskSmoothingOptions {
  int max_gap = 2;             ///< frames in a row that may be repaired, 0 (none)..10
  double min_agreement = 0.6;  ///< what the masks on both sides must share, of what either covers,
                               ///< 0..1
  double max_overlap = 0.5;    ///< what a mask that jumps may share with either, as a share of what
                               ///< these share, 0..1
};

/// Where the colours of hand and background come from.
enum class ColourLearning : std::uint8_t {
  automatic,  ///< from the clip, or from the stream, where it is long enough and a hand stands out
  never,      ///< every picture is segmented by itself
};

struct HandFinderOptions {
  ColourLearning learning = ColourLearning::automatic;
  int min_frames = 8;            ///< of a clip whose colours are learned, 1..1000000
  SilhouetteOptions silhouette;  ///< of pictures that are segmented by themselves
  HandColourOptions colours;
  bool smooth = true;  ///< repair masks of clips that jump for a frame or two
  MaskSmoothingOptions smoothing;
};

/// Each throws InvalidArgument naming the field that is out of range.
HRI_API void validate(const SilhouetteOptions& options);
HRI_API void validate(const HandColourOptions& options);
HRI_API void validate(const MaskSmoothingOptions& options);
HRI_API void validate(const HandFinderOptions& options);

}  // namespace hri
