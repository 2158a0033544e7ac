// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/landmark_pair.hpp"

#include <cmath>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr float kPairSlowing = 0.7F;  // of the way of a hand that is not seen, each frame

using detail::at;

// Root mean square distance of joints from those of another hand.
double apart(const MatrixF& a, const MatrixF& b) {
  return std::sqrt(static_cast<double>((a - b).squaredNorm()) / kNumLandmarks);
}

// The same of the joints from their centre.
double size_of(const MatrixF& joints) {
  const double squares =
      static_cast<double>((joints.rowwise() - joints.colwise().mean()).squaredNorm());
  return std::sqrt(squares / kNumLandmarks);
}

}  // namespace

LandmarkPairTracker::LandmarkPairTracker(const LandmarkPairOptions& options)
    : options_(validated(options)) {}

void LandmarkPairTracker::reset() {
  for (Track& t : tracks_) t.known = false;
  paired_ = false;
}

std::array<int, 2> LandmarkPairTracker::push(Span<const MatrixF> hands_px, int width_px) {
  require(width_px > 0, "width_px must be at least 1");
  for (const MatrixF& joints : hands_px) {
    require(joints.rows() == kNumLandmarks && joints.cols() == 2,
            "landmarks must have 21 rows of x and y");
    require(joints.allFinite(), "landmarks must be finite");
  }
  const int first = hands_px.empty() ? -1 : 0;
  int second = -1;
  for (int i = 1; i < static_cast<int>(hands_px.size()) && second < 0; ++i) {
    const double least = options_.min_apart * size_of(hands_px[0]);
    if (apart(hands_px[at(i)], hands_px[0]) >= least) second = i;
  }
  std::array<int, 2> found{-1, -1};
  if (second >= 0) {
    const MatrixF& a = hands_px[at(first)];
    const MatrixF& b = hands_px[at(second)];
    double straight = 0;
    double crossed = 0;
    if (paired_) {
      straight = far(0, a) + far(1, b);
      crossed = far(0, b) + far(1, a);
    } else {
      straight = static_cast<double>(a.col(0).mean());
      crossed = static_cast<double>(b.col(0).mean());
    }
    found = {first, second};
    if (crossed < straight) std::swap(found[0], found[1]);
    paired_ = true;
  } else if (first >= 0) {
    const MatrixF& hand = hands_px[at(first)];
    std::size_t side = 2 * hand.col(0).mean() < static_cast<float>(width_px) ? 0 : 1;
    if (tracks_[0].known && tracks_[1].known) {
      side = far(0, hand) <= far(1, hand) ? 0 : 1;
    } else if (tracks_[0].known || tracks_[1].known) {
      side = tracks_[0].known ? 0 : 1;
    }
    found[side] = first;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    found[side] >= 0 ? see(side, hands_px[at(found[side])]) : miss(side);
  }
  if (!tracks_[0].known && !tracks_[1].known) paired_ = false;
  return found;
}

void LandmarkPairTracker::see(std::size_t side, const MatrixF& joints) {
  Track& t = tracks_[side];
  if (t.known && t.num_unseen == 0) {
    t.dx += 0.5F * (joints.col(0).mean() - t.joints.col(0).mean() - t.dx);
    t.dy += 0.5F * (joints.col(1).mean() - t.joints.col(1).mean() - t.dy);
  } else {
    t.dx = t.dy = 0;
  }
  t.joints = joints;
  t.known = true;
  t.num_unseen = 0;
}

void LandmarkPairTracker::miss(std::size_t side) {
  Track& t = tracks_[side];
  if (!t.known) return;
  if (++t.num_unseen > options_.num_kept_frames) {
    t.known = false;
    return;
  }
  t.joints.col(0).array() += t.dx;
  t.joints.col(1).array() += t.dy;
  t.dx *= kPairSlowing;
  t.dy *= kPairSlowing;
}

// Mean square distance from where the hand's way would lead it; 0 of a hand that is not known.
double LandmarkPairTracker::far(std::size_t side, const MatrixF& joints) const {
  const Track& t = tracks_[side];
  if (!t.known) return 0;
  const auto gone = joints - t.joints;
  return static_cast<double>((gone.col(0).array() - t.dx).square().sum() +
                             (gone.col(1).array() - t.dy).square().sum());
}

}  // namespace hri
