// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/two_hand_features.hpp"

#include <cmath>
#include <string>

#include "hri/core/error.hpp"
#include "hri/features/speech/dynamics.hpp"

namespace hri {
namespace {

constexpr float kMaxPx = 1e6F;
enum Point : Eigen::Index { kLeft = 0, kRight = 2, kReference = 4 };

bool seen(ConstMatrixRefF tracks, Eigen::Index t, Point point) {
  return !std::isnan(tracks(t, point));
}

// The first frame that shows the point, or the number of frames.
Eigen::Index first_seen(ConstMatrixRefF tracks, Point point) {
  Eigen::Index t = 0;
  while (t < tracks.rows() && !seen(tracks, t, point)) ++t;
  return t;
}

void check(ConstMatrixRefF tracks) {
  require(tracks.rows() > 0 && tracks.cols() == kNumTwoHandTrackColumns,
          "tracks must have at least one row and 6 columns");
  for (Eigen::Index t = 0; t < tracks.rows(); ++t) {
    for (Eigen::Index c = 0; c < tracks.cols(); ++c) {
      const float value = tracks(t, c);
      const bool other_seen = !std::isnan(tracks(t, c % 2 == 0 ? c + 1 : c - 1));
      if (std::isnan(value) ? other_seen : !(std::abs(value) <= kMaxPx)) {
        fail(ErrorKind::invalid_argument,
             "tracks: " + std::string(kTwoHandTrackColumns[static_cast<std::size_t>(c)]) +
                 " of frame " + std::to_string(t) + " is " + std::to_string(value) +
                 (other_seen && std::isnan(value) ? ", but the other half of the point is known"
                                                  : ", must lie within 1e6"));
      }
    }
  }
  require(first_seen(tracks, kReference) < tracks.rows(), "tracks: no frame shows the reference");
  require(first_seen(tracks, kLeft) < tracks.rows() || first_seen(tracks, kRight) < tracks.rows(),
          "tracks: no frame shows a hand");
}

// Where a point is, or was last seen, or will first be seen.
struct Place {
  Eigen::Index row;
  Point point;
  bool known;

  Place(ConstMatrixRefF tracks, Point of) : row(first_seen(tracks, of)), point(of) {
    known = row < tracks.rows();
  }
  void move_to(ConstMatrixRefF tracks, Eigen::Index t) {
    if (known && t > row && seen(tracks, t, point)) row = t;
  }
};

// x and y from the reference.
void write_offset(ConstMatrixRefF tracks, const Place& hand, const Place& reference, double scale,
                  float* out) {
  for (Eigen::Index i = 0; i < 2; ++i) {
    const float from = tracks(reference.row, reference.point + i);
    out[i] =
        hand.known ? static_cast<float>((tracks(hand.row, hand.point + i) - from) / scale) : 0.0F;
  }
}

// Distance, cosine, sine; all 0 at the reference.
void write_polar(const float* offset, float* out) {
  out[0] = std::hypot(offset[0], offset[1]);
  out[1] = out[0] > 0 ? offset[0] / out[0] : 0.0F;
  out[2] = out[0] > 0 ? offset[1] / out[0] : 0.0F;
}

}  // namespace

const char* TwoHandFeatureOptions::conflict() const {
  return use_relation && !use_left ? "use_relation needs use_left" : nullptr;
}

double hand_scale_px(ConstMatrixRefF tracks) {
  check(tracks);
  double sum = 0;
  double count = 0;
  for (Eigen::Index t = 0; t < tracks.rows(); ++t) {
    for (const Point hand : {kLeft, kRight}) {
      if (!seen(tracks, t, hand) || !seen(tracks, t, kReference)) continue;
      const double dx = tracks(t, hand) - tracks(t, kReference);
      const double dy = tracks(t, hand + 1) - tracks(t, kReference + 1);
      sum += dx * dx + dy * dy;
      count += 1;
    }
  }
  require(sum > 0, "tracks: no frame shows a hand away from the reference");
  return std::sqrt(sum / count);
}

TwoHandFeatureComputer::TwoHandFeatureComputer(const TwoHandFeatureOptions& options)
    : options_(validated(options)) {}

int TwoHandFeatureComputer::num_static() const {
  const int num_hands = options_.use_left ? 2 : 1;
  return num_hands * (options_.use_polar ? 5 : 2) + (options_.use_relation ? 3 : 0);
}

std::vector<int> TwoHandFeatureComputer::known_columns(ConstMatrixRefF tracks) const {
  check(tracks);
  const bool right = first_seen(tracks, kRight) < tracks.rows();
  const bool left = first_seen(tracks, kLeft) < tracks.rows();
  std::vector<bool> known;  // in the order of compute()
  const auto append = [&known](int count, bool value) {
    known.insert(known.end(), static_cast<std::size_t>(count), value);
  };
  for (const int count : {2, options_.use_polar ? 3 : 0}) {
    append(count, right);
    if (options_.use_left) append(count, left);
  }
  if (options_.use_relation) append(3, left && right);
  std::vector<int> columns;
  for (int order = 0; order <= options_.delta_orders; ++order) {
    for (int c = 0; c < num_static(); ++c) {
      if (known[static_cast<std::size_t>(c)]) columns.push_back(order * num_static() + c);
    }
  }
  return columns;
}

void TwoHandFeatureComputer::compute(ConstMatrixRefF tracks, double scale_px,
                                     MatrixRefF out) const {
  check(tracks);
  require(scale_px > 0 && scale_px <= kMaxPx, "scale_px must lie above 0, within 1e6");
  require(out.rows() == tracks.rows() && out.cols() == num_features(),
          "out must have a row for each frame and num_features() columns");
  Place left(tracks, kLeft);
  Place right(tracks, kRight);
  Place reference(tracks, kReference);
  const int num_hands = options_.use_left ? 2 : 1;
  for (Eigen::Index t = 0; t < tracks.rows(); ++t) {
    left.move_to(tracks, t);
    right.move_to(tracks, t);
    reference.move_to(tracks, t);
    float* const offsets = out.data() + t * out.outerStride();
    write_offset(tracks, right, reference, scale_px, offsets);
    if (options_.use_left) write_offset(tracks, left, reference, scale_px, offsets + 2);
    float* next = offsets + 2 * num_hands;
    for (int h = 0; options_.use_polar && h < num_hands; ++h, next += 3)
      write_polar(offsets + 2 * h, next);
    if (options_.use_relation) {
      next[0] = offsets[0] - offsets[2];
      next[1] = offsets[1] - offsets[3];
      next[2] = std::hypot(next[0], next[1]);
    }
  }
  for (int order = 0; order < options_.delta_orders; ++order)
    append_deltas(out, order * num_static(), num_static(), options_.delta_window);
}

MatrixF TwoHandFeatureComputer::compute(ConstMatrixRefF tracks, double scale_px) const {
  MatrixF out(tracks.rows(), num_features());
  compute(tracks, scale_px, out);
  return out;
}

MatrixF TwoHandFeatureComputer::compute(ConstMatrixRefF tracks) const {
  return compute(tracks, hand_scale_px(tracks));
}

}  // namespace hri
