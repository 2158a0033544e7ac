// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Rows of features of both hands, made of those of each: the shapes of both, the way from one to
// the other, and where the pair is. They are laid out as rows of one hand are, whose last columns
// are its place: what classifies one hand classifies a pair.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

constexpr int kNumPlaceColumns = 3;     ///< the last of every row: x, y and the log of the area
constexpr int kNumRelationColumns = 3;  ///< from the left hand to the right one: x, y, distance

/// Columns of a pair's row, of hands that have `num_hand_features` each, their place among them.
constexpr int num_pair_features(int num_hand_features) {
  return 2 * (num_hand_features - kNumPlaceColumns) + kNumRelationColumns + kNumPlaceColumns;
}

/// Rows of a gesture of both hands. `left` and `right` have a row for every frame, all NaN in a
/// frame that does not show the hand; the last columns are the hand's centre and the log of its
/// area, in units of the frame. The result has a row for every frame that shows a hand: the shape
/// of the right hand, that of the left one, each of length 1; the way from left to right, times
/// `relation_weight`; the middle of both centres and the log of both areas.
///
/// A hand out of sight stays as it was last seen, before that as it is first seen. One that is
/// seen in less than a fifth of the frames that show a hand is absent: its shape and the way to it
/// are 0, the pair is where the other one is. What is shown by one hand alone has it in the place
/// of the right one, whichever it is. Throws InvalidArgument for rows that differ in number or
/// columns, have no shape, are NaN in part or infinite, and a weight that is negative or not
/// finite.
HRI_API MatrixF pair_rows(ConstMatrixRefF left, ConstMatrixRefF right, double relation_weight);

/// Rows of a gesture of which only places are known, for recognisers of rows: the features of
/// TwoHandFeatureComputer, without deltas, of both hands (one: of the right hand alone); then the
/// middle of the hands in the same units and 0, as points have no area. `tracks` and `scale_px` are
/// those of TwoHandFeatureComputer; scale_px 0: hand_scale_px(). Throws InvalidArgument as it does.
HRI_API MatrixF track_rows(ConstMatrixRefF tracks, double scale_px, int num_hands);

}  // namespace hri
