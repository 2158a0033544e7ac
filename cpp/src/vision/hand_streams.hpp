// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The ways in which HandFinder finds hands in a stream.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/vision/hand_colours.hpp"
#include "hri/vision/person_hands.hpp"
#include "hri/vision/silhouette.hpp"

namespace hri::detail {

/// Every picture by itself.
class PlainHandStream : public HandStream {
 public:
  explicit PlainHandStream(SilhouetteExtractor extractor) : extractor_(std::move(extractor)) {}

  const HandObservation& push(ImageView bgr, double /*time_s*/, bool /*in_gesture*/) override {
    extractor_.extract(bgr, &found_);
    return found_;
  }

 private:
  SilhouetteExtractor extractor_;
  HandObservation found_;
};

/// By colours that are learned from the stream, see HandFinder::stream().
class LearningHandStream : public HandStream {
 public:
  explicit LearningHandStream(const HandFinderOptions& options)
      : options_(options), extractor_(options.silhouette) {}

  const HandObservation& push(ImageView bgr, double time_s, bool in_gesture) override;
  [[nodiscard]] bool renewed() const override { return renewed_; }

 private:
  static constexpr std::size_t kNumSamples = 8;
  struct Sample {
    std::vector<std::uint8_t> pixels;
    int width_px = 0;
    int height_px = 0;
  };
  using Outlines = std::array<GreyImage, 3>;

  void keep(ImageView bgr);
  [[nodiscard]] std::vector<ImageView> samples() const;
  void consider(const std::optional<HandColours>& found);
  [[nodiscard]] Outlines outlines(const HandColours& colours) const;

  HandFinderOptions options_;
  SilhouetteExtractor extractor_;
  std::optional<HandColours> colours_;
  std::array<Sample, kNumSamples> samples_;  // a ring: the oldest of `count_` is at `first_`
  std::size_t first_ = 0, count_ = 0;
  double sampled_s_ = -std::numeric_limits<double>::infinity();
  std::optional<double> tried_s_;
  bool renewed_ = false;
  HandObservation found_;
};

/// By the face of the person, where one is seen in at least half of the last looks; otherwise as
/// another stream finds hands. Which of the two it is does not change within a gesture.
class PersonHandStream : public HandStream {
 public:
  PersonHandStream(std::shared_ptr<const FaceFinder> faces, const PersonOptions& options,
                   std::unique_ptr<HandStream> others)
      : faces_(std::move(faces)), options_(options), hands_(options), others_(std::move(others)) {}

  const HandObservation& push(ImageView bgr, double time_s, bool in_gesture) override;
  [[nodiscard]] bool renewed() const override { return renewed_; }

 private:
  static constexpr std::size_t kNumLooks = 6;

  void look(ImageView bgr, bool in_gesture);

  std::shared_ptr<const FaceFinder> faces_;
  PersonOptions options_;
  PersonHands hands_;
  std::unique_ptr<HandStream> others_;
  std::array<bool, kNumLooks> seen_{};  // a ring
  std::size_t num_looks_ = 0;
  int num_pictures_ = 0;  // since the last look
  int width_px_ = 0, height_px_ = 0;
  Face face_;
  bool by_person_ = false;
  bool renewed_ = false;
  HandObservation found_;
};

/// The face with its centre in place and another side.
Face resized(const Face& face, double side_px);

}  // namespace hri::detail
