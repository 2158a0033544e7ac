// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Both hands of a stream of masks, kept apart from frame to frame: also while they touch, and where
// they cross.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/features/hand/regions.hpp"

namespace hri {

struct HandPairOptions {
  double min_area = 0.004;
  double min_share = 0.25;
  int num_kept_frames = 10;

  static constexpr const char* kName = "HandPairOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("min_area", o.min_area, within(0, 1), "smallest share of the picture that a hand covers");
    v("min_share", o.min_share, within(0, 1),
      "least area of the smaller region, as a share of the larger, to be a hand");
    v("num_kept_frames", o.num_kept_frames, within(0, 1000),
      "frames for which the place of a hand out of sight is kept");
  }
};

/// One of two hands in a frame. `mask` has the size of the frame's; without a hand it is all 0.
struct PairedHand {
  GreyImage mask;
  bool seen = false;
  bool touching = false;  ///< one region holds both hands: the border between them is a guess
  double x_px = 0;        ///< middle; of a hand that is not seen, where it may be
  double y_px = 0;
};

/// The left hand of the picture, then the right one, as they were when both were first seen: labels
/// go with the hands when these cross. Until then, a single hand is the left one in the left half
/// of the picture.
///
/// Two regions are given to the hands whose way goes on there. Where one region holds both hands,
/// the shapes that they had before are moved over it so that they cover it together, each close to
/// where its way would lead it; every pixel is then of the hand that covers it, or is nearer. Hands
/// that hide one another wholly, stop there and turn back can leave with labels swapped.
class HRI_API HandPairTracker {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit HandPairTracker(const HandPairOptions& options);

  /// Takes the next mask, of any number of regions. The result is overwritten by the next call; a
  /// stream of masks of one size allocates nothing once hands touched. A mask of another size
  /// begins a new stream. Throws InvalidArgument for an empty mask or one of several channels.
  const std::array<PairedHand, 2>& push(ImageView mask);

  /// Forgets both hands.
  void reset();

 private:
  struct Run {
    int dy, first, end;  // relative to the middle
  };
  // What is known of a hand from frames before.
  struct Track {
    bool known = false;
    int num_unseen = 0;
    double x = 0, y = 0, dx = 0, dy = 0;  // middle, and its way in a frame
    double area = 0;
    std::vector<Run> shape;  // when it was last seen apart
  };

  void find_hands();
  void assign_two();
  void assign_one();
  void split_region();
  void see(int side, const Region& region);
  void miss(int side);
  [[nodiscard]] bool holds_both(const Region& region);
  void sum_rows(const GreyImage& image);
  void weigh_beside(const Track& hand);
  [[nodiscard]] int covered(const Track& hand, int x, int y) const;
  void settle(Track* hand, double x, double y);
  void share_out();
  void forget_hidden();
  void remember_shape(Track* hand, const GreyImage& mask);

  HandPairOptions options_;
  RegionFinder finder_;
  std::vector<Region> regions_;  // that may be hands, at most two, the larger first
  GreyImage mask_, region_, rest_;
  std::vector<int> sums_;  // of the pixels left of every place, row by row
  bool paired_ = false;    // both were seen apart
  int num_hidden_ = 0;     // frames in which one hand hides the other
  std::array<Track, 2> tracks_;
  std::array<PairedHand, 2> hands_;
};

}  // namespace hri
