// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/features/hand/landmarks.hpp"

namespace hri {
namespace {

using detail::kPi;

double radians(double degrees) { return degrees * kPi / 180; }

// Two neighbours and their shares of a place between them.
struct Neighbours {
  explicit Neighbours(double place)
      : first(static_cast<int>(std::floor(place))),
        weights{1 - (place - std::floor(place)), place - std::floor(place)} {}
  int first;
  std::array<double, 2> weights;
};

}  // namespace

HandTurn::HandTurn(const HandFeatureOptions& options, double degrees) {
  require(std::isfinite(degrees), "degrees must be finite");
  const int num_features = HandFeatureComputer(options).num_features();
  if (options.use_grey) add_histogram(options.histogram, degrees);
  if (options.use_silhouette) add_histogram(options.histogram, degrees);
  add_unchanged(num_features - static_cast<int>(ends_.size()));
}

HandTurn HandTurn::of_landmarks(double degrees) {
  require(std::isfinite(degrees), "degrees must be finite");
  const auto cosine = static_cast<float>(std::cos(radians(degrees)));
  const auto sine = static_cast<float>(std::sin(radians(degrees)));
  HandTurn result;
  for (int x = 0; x < kNumLandmarkFeatures - kNumLandmarkTrackColumns; x += 2) {
    result.taps_.push_back({x, cosine});
    result.taps_.push_back({x + 1, -sine});
    result.end_feature();
    result.taps_.push_back({x, sine});
    result.taps_.push_back({x + 1, cosine});
    result.end_feature();
  }
  return result;
}

void HandTurn::add_histogram(const OrientationHistogramOptions& options, double degrees) {
  const auto base = static_cast<int>(ends_.size());
  const int num_blocks = std::max(options.num_cells - 1, 1);  // a side
  for (int y = 0; y < num_blocks; ++y) {
    for (int x = 0; x < num_blocks; ++x) add_block(options, degrees, y, x, base);
  }
}

// The block in row y and column x, of 2 x 2 cells. A cell takes from those in the same corner of
// blocks, whose values were normalised alike.
void HandTurn::add_block(const OrientationHistogramOptions& options, double degrees, int y, int x,
                         int base) {
  const int num_blocks = std::max(options.num_cells - 1, 1);
  const int block_side = options.num_cells == 1 ? 1 : 2;
  const int cells = block_side * block_side;
  const double middle = 0.5 * (options.num_cells - 1);
  const double cosine = std::cos(radians(degrees));
  const double sine = std::sin(radians(degrees));
  for (int cell = 0; cell < cells; ++cell) {
    const int dy = cell / block_side;
    const int dx = cell % block_side;
    const double to_y = y + dy - middle;
    const double to_x = x + dx - middle;
    const Neighbours rows(cosine * to_y - sine * to_x + middle - dy);
    const Neighbours columns(sine * to_y + cosine * to_x + middle - dx);
    for (int bin = 0; bin < options.num_bins; ++bin) {
      const Neighbours bins(bin - degrees / 180 * options.num_bins);
      for (int i = 0; i < 8; ++i) {
        const int from_y = rows.first + i / 4;
        const int from_x = columns.first + i / 2 % 2;
        const double weight = rows.weights[static_cast<std::size_t>(i / 4)] *
                              columns.weights[static_cast<std::size_t>(i / 2 % 2)] *
                              bins.weights[static_cast<std::size_t>(i % 2)];
        const bool inside =
            from_y >= 0 && from_y < num_blocks && from_x >= 0 && from_x < num_blocks;
        if (!inside || !(weight > 0)) continue;
        // Bins lie on a circle.
        const int from_bin =
            ((bins.first + i % 2) % options.num_bins + options.num_bins) % options.num_bins;
        const int from =
            ((from_y * num_blocks + from_x) * cells + cell) * options.num_bins + from_bin;
        taps_.push_back({base + from, static_cast<float>(weight)});
      }
      end_feature();
    }
  }
}

void HandTurn::add_unchanged(int count) {
  for (int i = 0; i < count; ++i) {
    taps_.push_back({static_cast<int>(ends_.size()), 1.0F});
    end_feature();
  }
}

void HandTurn::apply(Span<const float> shape, Span<float> turned) const {
  require(shape.size() == ends_.size() && turned.size() == ends_.size(),
          "shape and turned must have num_features() values");
  std::size_t tap = 0;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    float sum = 0;
    for (; tap < ends_[i]; ++tap)
      sum += taps_[tap].weight * shape[static_cast<std::size_t>(taps_[tap].from)];
    turned[i] = sum;
  }
}

}  // namespace hri
