// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_finder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/features/hand/hand_pair.hpp"
#include "hri/vision/hand_colours.hpp"
#include "hri/vision/mask_smoothing.hpp"
#include "hri/vision/silhouette.hpp"
#include "vision/hand_streams.hpp"

namespace hri {
namespace {

void require_pictures(Span<const ImageView> clip) {
  for (std::size_t i = 0; i < clip.size(); ++i) {
    if (!clip[i].empty() && clip[i].channels == 3) continue;
    fail(ErrorKind::invalid_argument,
         "frame " + std::to_string(i) + " must have three channels and at least one pixel");
  }
}

}  // namespace

HandFinder::HandFinder(const HandFinderOptions& options) : options_(validated(options)) {}

HandFinder::HandFinder(const HandFinderOptions& options, ImageView background)
    : HandFinder(options) {
  static_cast<void>(SilhouetteExtractor(options.silhouette, background));  // refuses what is none
  background_width_px_ = background.width_px;
  background_height_px_ = background.height_px;
  const std::size_t length = 3 * static_cast<std::size_t>(background.width_px);
  background_.resize(length * static_cast<std::size_t>(background.height_px));
  for (int y = 0; y < background.height_px; ++y)
    std::copy_n(background.row(y), length,
                background_.data() + static_cast<std::size_t>(y) * length);
}

HandFinder::HandFinder(const HandFinderOptions& options, std::shared_ptr<const FaceFinder> faces,
                       const PersonOptions& person)
    : HandFinder(options) {
  require(faces != nullptr, "a finder of faces must be given");
  faces_ = std::move(faces);
  person_ = validated(person);
}

std::vector<HandObservation> HandFinder::find(Span<const ImageView> clip, int max_hands,
                                              const FrameProgress& progress,
                                              bool* by_person) const {
  require_pictures(clip);
  *by_person = false;
  if (faces_) {
    PersonOptions person = person_;
    person.max_hands = max_hands;
    if (auto of_person = PersonHands(person).find(clip, *faces_, progress)) {
      if (options_.smooth) smooth_masks(options_.smoothing, &*of_person);
      *by_person = true;
      return std::move(*of_person);
    }
  }
  std::optional<HandColours> colours;
  const bool learns = options_.learning == ColourLearning::automatic && background_.empty();
  if (learns && clip.size() >= static_cast<std::size_t>(options_.min_frames)) {
    HandColourOptions of_clip = options_.colours;
    of_clip.max_hands = max_hands;
    colours = HandColours::learn({clip.begin(), clip.end()}, of_clip);
  }
  std::optional<SilhouetteExtractor> extractor;
  if (!colours) {
    SilhouetteOptions alone = options_.silhouette;
    alone.max_hands = max_hands;
    if (background_.empty()) {
      extractor.emplace(alone);
    } else {
      extractor.emplace(
          alone, ImageView{background_.data(), background_width_px_, background_height_px_, 3,
                           std::ptrdiff_t{3} * background_width_px_});
    }
  }
  std::vector<HandObservation> found(clip.size());
  for (std::size_t i = 0; i < clip.size(); ++i) {
    colours ? colours->extract(clip[i], &found[i]) : extractor->extract(clip[i], &found[i]);
    if (progress) progress(static_cast<int>(i) + 1, static_cast<int>(clip.size()));
  }
  if (options_.smooth) smooth_masks(options_.smoothing, &found);
  return found;
}

std::vector<HandObservation> HandFinder::find(Span<const ImageView> clip,
                                              const FrameProgress& progress) const {
  bool by_person = false;
  return find(clip, 1, progress, &by_person);
}

std::array<std::vector<HandObservation>, 2> HandFinder::find_pair(
    Span<const ImageView> clip, const FrameProgress& progress) const {
  std::array<std::vector<HandObservation>, 2> sides;
  bool by_person = false;
  std::vector<HandObservation> found = find(clip, 2, progress, &by_person);
  HandPairOptions options;
  if (by_person) options.min_area = 0;  // the face said how large hands are
  HandPairTracker tracker(options);
  for (HandObservation& both : found) {
    const std::array<PairedHand, 2>& hands = tracker.push(both.mask.view());
    for (std::size_t side = 0; side < 2; ++side) {
      const double quality = hands[side].seen ? both.quality : 0;
      sides[side].push_back(
          {both.grey, hands[side].mask, quality, both.repaired, hands[side].touching});
    }
  }
  return sides;
}

std::unique_ptr<HandStream> HandFinder::stream(bool dynamic, int max_hands) const {
  HandFinderOptions options = options_;
  options.silhouette.max_hands = options.colours.max_hands = max_hands;
  validate(options);
  if (!background_.empty()) {
    return std::make_unique<detail::PlainHandStream>(SilhouetteExtractor(
        options.silhouette, {background_.data(), background_width_px_, background_height_px_, 3,
                             std::ptrdiff_t{3} * background_width_px_}));
  }
  std::unique_ptr<HandStream> result;
  if (dynamic && options.learning == ColourLearning::automatic) {
    result = std::make_unique<detail::LearningHandStream>(options);
  } else {
    result = std::make_unique<detail::PlainHandStream>(SilhouetteExtractor(options.silhouette));
  }
  if (!faces_) return result;
  PersonOptions person = person_;
  person.max_hands = max_hands;
  return std::make_unique<detail::PersonHandStream>(faces_, person, std::move(result));
}

std::vector<std::uint8_t> background_of(Span<const ImageView> clip) {
  constexpr std::size_t kMostFrames = 25;
  require_pictures(clip);
  const bool alike = std::all_of(clip.begin(), clip.end(), [&](const ImageView& frame) {
    return frame.width_px == clip[0].width_px && frame.height_px == clip[0].height_px;
  });
  require(!clip.empty() && alike, "a background needs frames, all of one size");
  const double step = static_cast<double>(clip.size() - 1) / (kMostFrames - 1);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < kMostFrames; ++k) {
    const auto i = static_cast<std::size_t>(std::nearbyint(step * static_cast<double>(k)));
    if (chosen.empty() || i != chosen.back()) chosen.push_back(i);
  }
  const int width = clip[0].width_px;
  std::vector<std::uint8_t> result;
  result.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(clip[0].height_px));
  std::vector<std::uint8_t> values(chosen.size());
  for (int y = 0; y < clip[0].height_px; ++y) {
    for (int x = 0; x < 3 * width; ++x) {
      for (std::size_t k = 0; k < chosen.size(); ++k) values[k] = clip[chosen[k]].row(y)[x];
      std::sort(values.begin(), values.end());
      const int both = values[(values.size() - 1) / 2] + values[values.size() / 2];
      result.push_back(static_cast<std::uint8_t>(both / 2));
    }
  }
  return result;
}

}  // namespace hri
