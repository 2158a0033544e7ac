// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/turned_trajectories.hpp"

#include <algorithm>
#include <utility>

#include "hri/features/hand/hand_turn.hpp"
#include "recognition/gesture/gesture_scorer.hpp"
#include "recognition/gesture/trajectory.hpp"

namespace hri::detail {
namespace {

constexpr Eigen::Index kMostHands = 2;

HandTurn make_turn(const GestureRecognizerOptions& options, double degrees) {
  return options.source == GestureSource::landmarks ? HandTurn::of_landmarks(degrees)
                                                    : HandTurn(options.features, degrees);
}

VectorF turned(const VectorF& trajectory, Eigen::Index num_hands, const HandTurn& turn) {
  VectorF result = trajectory;
  const Eigen::Index num_columns = trajectory.size() / kNumPoints;
  const auto length = static_cast<std::size_t>(turn.num_features());
  for (Eigen::Index point = 0; point < kNumPoints; ++point) {
    for (Eigen::Index hand = 0; hand < num_hands; ++hand) {
      const Eigen::Index at = point * num_columns + hand * turn.num_features();
      turn.apply({trajectory.data() + at, length}, {result.data() + at, length});
    }
  }
  return result;
}

}  // namespace

void append_turned(const GestureRecognizerOptions& options, Eigen::Index num_columns,
                   std::vector<KnownTrajectory>* trajectories) {
  if (!(options.turn_degrees > 0)) return;
  const std::size_t count = trajectories->size();
  for (const double degrees : {-options.turn_degrees, options.turn_degrees}) {
    const HandTurn turn = make_turn(options, degrees);
    const Eigen::Index num_hands =
        std::min(kMostHands, (num_columns - kNumTrackColumns) / turn.num_features());
    if (num_hands == 0) return;
    for (std::size_t i = 0; i < count; ++i) {
      KnownTrajectory copy = (*trajectories)[i];
      copy.trajectory = turned(copy.trajectory, num_hands, turn);
      trajectories->push_back(std::move(copy));
    }
  }
}

}  // namespace hri::detail
