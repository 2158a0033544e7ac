// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How hands are found in pictures. Kept apart from hri/vision, which finds them, so that a
// recogniser can own and save its finder's options without OpenCV.
#pragma once

#include <array>
#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"

namespace hri {

enum class SilhouetteMethod : std::uint8_t {
  chroma_otsu,  ///< Otsu's threshold on Cr - Cb: skin is redder than what is behind it, in any
                ///< light that has colour
  hsv_narrow,   ///< fixed bounds of thesis section 5.1.1: hue 0..50 degrees, saturation
                ///< 0.25..0.57, value 40..255; they fail in coloured or poor light
  hsv_wide,     ///< those of section 4.6.2: hue 0..198 degrees, saturation above 0.2, to 0.95
  grey_otsu,    ///< Otsu's threshold on grey, for a dark hand before a plain bright background
};
constexpr auto enum_names(SilhouetteMethod) {
  return std::array{"chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu"};
}

struct HRI_API SilhouetteOptions {
  SilhouetteMethod method = SilhouetteMethod::chroma_otsu;
  int max_side_px = 320;
  int blur_px = 5;
  double min_contrast = 1.5;
  double sure_contrast = 5;
  double min_quality = 0.7;
  double min_area = 0.005;
  double max_area = 0.8;
  bool remove_face = true;
  int max_hands = 1;

  static constexpr const char* kName = "SilhouetteOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("method", o.method, any_value, "how a hand differs from what is behind it");
    v("max_side_px", o.max_side_px, within(32, 4096),
      "larger pictures are scaled down to this first");
    v("blur_px", o.blur_px, within(1, 31).odd(),
      "size of the Gaussian blur before and of the median after the threshold");
    v("min_contrast", o.min_contrast, within(0, 255),
      "least difference of the two classes' means, in grey levels");
    v("sure_contrast", o.sure_contrast, within(0, 255),
      "below this, as in poor light, the classes must also be separated by min_quality");
    v("min_quality", o.min_quality, within(0, 1),
      "least separation of the classes; camera noise alone gives 0.64");
    v("min_area", o.min_area, within(0, 1), "smallest share of the picture that a hand covers");
    v("max_area", o.max_area, within(0, 1), "largest");
    v("remove_face", o.remove_face, any_value,
      "of more skin regions than hands the one most like an ellipse is a face");
    v("max_hands", o.max_hands, within(1, 2),
      "regions that masks hold, the largest; HandPairTracker decides which is which");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

struct HRI_API HandColourOptions {
  int max_side_px = 160;
  int fit_side_px = 80;
  int num_fit_frames = 8;
  int num_rounds = 4;
  double min_area = 0.004;
  double max_area = 0.6;
  double min_quality = 0.3;
  bool remove_still = true;
  int max_hands = 1;

  static constexpr const char* kName = "HandColourOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("max_side_px", o.max_side_px, within(32, 4096),
      "larger pictures are scaled down to this before they are segmented");
    v("fit_side_px", o.fit_side_px, within(32, 4096), "and to this for learning");
    v("num_fit_frames", o.num_fit_frames, within(1, 256),
      "frames learned from, spread over the clip");
    v("num_rounds", o.num_rounds, within(1, 100),
      "rounds of segmenting and learning from the segments");
    v("min_area", o.min_area, within(0, 1), "smallest share of the picture that a hand covers");
    v("max_area", o.max_area, within(0, 1), "largest, averaged over the frames learned from");
    v("min_quality", o.min_quality, within(0, 1),
      "a discriminant that separates the pixels on both sides of the hand's outline worse than "
      "this is no hand");
    v("remove_still", o.remove_still, any_value,
      "what has the hand's colours but stays in place while something else of them moves, such as "
      "a face, is no hand");
    v("max_hands", o.max_hands, within(1, 2),
      "regions that masks hold, the largest; HandPairTracker decides which is which");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

struct MaskSmoothingOptions {
  int max_gap = 2;
  double min_agreement = 0.6;
  double max_overlap = 0.5;

  static constexpr const char* kName = "MaskSmoothingOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("max_gap", o.max_gap, within(0, 10), "frames in a row that may be repaired; 0: none");
    v("min_agreement", o.min_agreement, within(0, 1),
      "what the masks on both sides must share, of what either covers");
    v("max_overlap", o.max_overlap, within(0, 1),
      "what a mask that jumps may share with either, as a share of what these share");
  }
};

/// Where the colours of hand and background come from.
enum class ColourLearning : std::uint8_t {
  automatic,  ///< from the clip, or from the stream, where it is long enough and a hand stands out
  never,      ///< every picture is segmented by itself
};
constexpr auto enum_names(ColourLearning) { return std::array{"automatic", "never"}; }

struct HandFinderOptions {
  ColourLearning learning = ColourLearning::automatic;
  int min_frames = 8;
  SilhouetteOptions silhouette;
  HandColourOptions colours;
  bool smooth = true;
  MaskSmoothingOptions smoothing;

  static constexpr const char* kName = "HandFinderOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("learning", o.learning, any_value, "where the colours of hand and background come from");
    v("min_frames", o.min_frames, within(1, 1000000),
      "length of a clip from which on its colours are learned");
    v("silhouette", o.silhouette, any_value, "of pictures that are segmented by themselves");
    v("colours", o.colours, any_value, "of clips and streams whose colours are learned");
    v("smooth", o.smooth, any_value, "repair masks of clips that jump for a frame or two");
    v("smoothing", o.smoothing, any_value, "which masks are repaired");
  }
};

}  // namespace hri
