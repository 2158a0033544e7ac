// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// GestureRecognizer and GestureStream of both hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/features/hand/landmarks.hpp"
#include "hri/features/hand/pair_rows.hpp"
#include "hri/recognition/gesture/gesture_stream.hpp"

namespace hri {
namespace {

constexpr int kFrames = 12, kWidth = 400, kHeight = 200;
constexpr double kFrame_s = 1.0 / 20;
const std::vector<std::string> kLabels{"alone", "apart", "together"};

struct Pair {
  double left_x = 0, right_x = 0;
  bool left_seen = true;
};

// Both hands go apart, come together, or the right one goes where it goes in "apart".
Pair shown(const std::string& label, double share, double start) {
  const double way = 60 * share;
  if (label == "together") return {80 + start + way, 320 + start - way};
  return {140 + start - way, 260 + start + way, label == "apart"};
}

GreyImage drawn(const Pair& pair) {
  GreyImage mask(kWidth, kHeight);
  const auto put = [&](int num_fingers, double x_px) {
    static const std::array<GreyImage, 2> kHands{hand_testing::hand(2, 100, 120, 0.6),
                                                 hand_testing::hand(4, 100, 120, 0.6)};
    const GreyImage& one = kHands[num_fingers == 2 ? 0 : 1];
    const int shift = static_cast<int>(std::lround(x_px)) - 100;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = std::max(0, -shift); x < 200 && x + shift < kWidth; ++x) {
        if (one.view().at(x, y) != 0)
          mask.pixels[static_cast<std::size_t>(y * kWidth + x + shift)] = 255;
      }
    }
  };
  if (pair.left_seen) put(4, pair.left_x);
  put(2, pair.right_x);
  return mask;
}

HandObservation observed(const GreyImage& mask) {
  return {hand_testing::grey(mask), mask, 1, false, false};
}

using Sides = std::array<std::vector<HandObservation>, 2>;

// The hands of a gesture, which rest before it.
Sides sides_of(const std::string& label, double start) {
  Sides sides;
  for (int t = -4; t < kFrames; ++t) {
    const Pair pair = shown(label, std::max(0, t) / (kFrames - 1.0), start);
    Pair left = pair;
    left.right_x = -200;
    sides[0].push_back(observed(drawn(left)));
    Pair right = pair;
    right.left_seen = false;
    sides[1].push_back(observed(drawn(right)));
  }
  return sides;
}

GestureRecognizerOptions both_hands(GestureModel model) {
  GestureRecognizerOptions options;
  options.num_hands = 2;
  options.model = model;
  options.num_states = 3;
  return options;
}

GestureRecognizer trained(GestureModel model) {
  const GestureRecognizerOptions options = both_hands(model);
  const GestureFeatureComputer computer(options.features, options.min_quality);
  std::vector<GestureSample> samples;
  for (int take = 0; take < 3; ++take) {
    for (const std::string& label : kLabels) {
      const Sides sides = sides_of(label, 4 * take - 8);
      samples.push_back({pair_rows(computer.compute_every(sides[0]),
                                   computer.compute_every(sides[1]), options.relation_weight),
                         label, ""});
    }
  }
  return GestureRecognizer::train(samples, options);
}

TEST(GestureRecognizerOfBothHands, TellsGesturesApartAndKeepsThemInItsFile) {
  for (const GestureModel model :
       {GestureModel::trajectory, GestureModel::hmm, GestureModel::ptbhmm, GestureModel::rbf}) {
    const GestureRecognizer recognizer = trained(model);
    const GestureRecognizer read = GestureRecognizer::from_model_file(recognizer.to_model_file());
    EXPECT_EQ(read.options().num_hands, 2);
    for (const std::string& label : kLabels) {
      const Sides sides = sides_of(label, 3);
      const Decision decision = recognizer.recognise(sides[0], sides[1]);
      EXPECT_EQ(decision.nbest.at(0).label, label) << static_cast<int>(model);
      EXPECT_EQ(read.recognise(sides[0], sides[1]).score, decision.score);
    }
  }
}

TEST(GestureRecognizerOfBothHands, RefusesAnotherNumberOfHands) {
  const GestureRecognizer recognizer = trained(GestureModel::trajectory);
  const Sides sides = sides_of("apart", 0);
  EXPECT_THROW(recognizer.recognise(sides[0]), InvalidArgument);
  EXPECT_THROW(recognizer.recognise(sides[0], Span<const HandObservation>(sides[1].data(), 3)),
               InvalidArgument);
  EXPECT_EQ(
      recognizer.recognise(Span<const HandObservation>{}, Span<const HandObservation>{}).status,
      DecisionStatus::no_input);
  GestureRecognizerOptions options = both_hands(GestureModel::trajectory);
  options.num_hands = 3;
  EXPECT_THROW(validate(options), InvalidArgument);
}

// Pictures of these tests are masks of both hands already.
class MaskStream : public HandStream {
 public:
  const HandObservation& push(ImageView bgr, double /*time_s*/, bool /*in_gesture*/) override {
    GreyImage mask(bgr.width_px, bgr.height_px);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = bgr.data[3 * i];
    found_ = observed(mask);
    return found_;
  }

 private:
  HandObservation found_;
};

class MaskSource : public HandSource {
 public:
  [[nodiscard]] std::vector<HandObservation> find(Span<const ImageView> /*clip*/,
                                                  const FrameProgress&) const override {
    return {};
  }
  [[nodiscard]] std::unique_ptr<HandStream> stream(bool /*dynamic*/, int max_hands) const override {
    EXPECT_EQ(max_hands, 2);
    return std::make_unique<MaskStream>();
  }
};

using Landmarks = std::function<std::vector<MatrixF>(const Pair&)>;

// The final decisions on a gesture that rests, moves and rests.
std::vector<std::string> watch(const GestureRecognizer& recognizer, const std::string& label,
                               const Landmarks& landmarks = {}) {
  const MaskSource source;
  GestureStream stream(recognizer, source);
  std::vector<std::string> labels;
  const auto keep = [&](const std::vector<GestureEvent>& events) {
    for (const GestureEvent& e : events) {
      if (e.kind == GestureEventKind::decision) labels.push_back(e.decision.nbest.at(0).label);
    }
  };
  for (int t = -24; t < kFrames + 14; ++t) {
    const Pair pair = shown(label, std::clamp(t / (kFrames - 1.0), 0.0, 1.0), 2);
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t v : drawn(pair).pixels) bgr.insert(bgr.end(), 3, v);
    const std::vector<MatrixF> points = landmarks ? landmarks(pair) : std::vector<MatrixF>{};
    keep(stream.push({bgr.data(), kWidth, kHeight, 3, std::ptrdiff_t{3} * kWidth},
                     (t + 24) * kFrame_s, points));
  }
  keep(stream.finish());
  return labels;
}

TEST(GestureStreamOfBothHands, DecidesOnMasksThatHoldBoth) {
  const GestureRecognizer recognizer = trained(GestureModel::trajectory);
  for (const std::string& label : kLabels) {
    const std::vector<std::string> found = watch(recognizer, label);
    ASSERT_FALSE(found.empty()) << label;
    EXPECT_EQ(found.back(), label);
  }
}

// Hands that were the left and the right one when the stream ended are so no longer.
TEST(GestureStreamOfBothHands, ReportsOfTheNextStreamWhatANewOneWould) {
  const GestureRecognizer recognizer = trained(GestureModel::trajectory);
  const MaskSource source;
  const auto scores_of = [](GestureStream* stream, const std::string& label, int frames,
                            int shift) {
    std::vector<float> scores;
    const auto keep = [&](const std::vector<GestureEvent>& events) {
      for (const GestureEvent& e : events) {
        if (e.kind != GestureEventKind::segment) scores.push_back(e.decision.score);
      }
    };
    for (int t = 0; t < frames; ++t) {
      Pair pair = shown(label, std::clamp((t - 16) / (kFrames - 1.0), 0.0, 1.0), 2);
      pair.left_x += shift;
      pair.right_x += shift;
      std::vector<std::uint8_t> bgr;
      for (const std::uint8_t v : drawn(pair).pixels) bgr.insert(bgr.end(), 3, v);
      keep(
          stream->push({bgr.data(), kWidth, kHeight, 3, std::ptrdiff_t{3} * kWidth}, t * kFrame_s));
    }
    keep(stream->finish());
    return scores;
  };
  for (const std::string& label : kLabels) {
    GestureStream fresh(recognizer, source);
    const std::vector<float> expected = scores_of(&fresh, label, 40, 0);
    ASSERT_FALSE(expected.empty());
    for (const bool interrupted : {false, true}) {
      GestureStream used(recognizer, source);
      // Both hands are far to the left, where the next left one is the nearest to the right one.
      for (const int shift : {-110, 60}) {
        std::vector<float> ignored = scores_of(&used, "apart", 4, shift);
        if (interrupted) {
          std::vector<std::uint8_t> bgr;
          for (const std::uint8_t v : drawn({140.0 + shift, 260.0 + shift, true}).pixels)
            bgr.insert(bgr.end(), 3, v);
          used.push({bgr.data(), kWidth, kHeight, 3, std::ptrdiff_t{3} * kWidth}, 0);
          used.interrupt();
        }
        EXPECT_EQ(scores_of(&used, label, 40, 0), expected) << label << " " << shift;
      }
    }
  }
}

// A wrist and straight fingers, in two forms.
MatrixF joints(double x, double spread) {
  MatrixF points(kNumLandmarks, 2);
  points.row(0) << static_cast<float>(x), 150.0F;
  for (int finger = 0; finger < 5; ++finger) {
    for (int joint = 0; joint < 4; ++joint) {
      const double r = 15 + 8 * joint;
      points.row(1 + 4 * finger + joint)
          << static_cast<float>(x + r * std::sin(spread * (finger - 2))),
          static_cast<float>(150 - r * std::cos(spread * (finger - 2)));
    }
  }
  return points;
}

std::vector<MatrixF> found_in(const Pair& pair) {
  std::vector<MatrixF> hands{joints(pair.right_x, 0.1)};
  if (pair.left_seen) hands.push_back(joints(pair.left_x, 0.3));
  return hands;
}

TEST(GestureStreamOfBothHands, DecidesOnLandmarksOfBoth) {
  GestureRecognizerOptions options = both_hands(GestureModel::trajectory);
  options.source = GestureSource::landmarks;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 4; ++take) {
    for (const std::string& label : kLabels) {
      MatrixF sides[2];
      for (MatrixF& side : sides)
        side = MatrixF::Constant(kFrames + 4, kNumLandmarkFeatures, std::nanf(""));
      for (int t = -4; t < kFrames; ++t) {
        const Pair pair = shown(label, std::max(0, t) / (kFrames - 1.0), 4 * take - 8);
        const auto hands = found_in(pair);
        for (std::size_t i = 0; i < hands.size(); ++i) {
          MatrixF& side = sides[i == 0 ? 1 : 0];
          landmark_features(hands[i], kWidth, kHeight,
                            {side.data() + (t + 4) * side.cols(), kNumLandmarkFeatures});
        }
      }
      samples.push_back({pair_rows(sides[0], sides[1], options.relation_weight), label, ""});
    }
  }
  const GestureRecognizer recognizer = GestureRecognizer::train(samples, options);
  for (const std::string& label : kLabels) {
    const std::vector<std::string> found = watch(recognizer, label, found_in);
    ASSERT_FALSE(found.empty()) << label;
    EXPECT_EQ(found.back(), label);
  }
}

TEST(HandSource, ThatFindsOneHandSaysSo) {
  const ImageView none;
  EXPECT_THROW(MaskSource().find_pair(Span<const ImageView>(&none, 1)), InvalidArgument);
}

}  // namespace
}  // namespace hri
