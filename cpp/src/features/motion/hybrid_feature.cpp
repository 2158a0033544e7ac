// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/motion/hybrid_feature.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/features/hand/hand_crop.hpp"
#include "hri/features/hand/hand_place.hpp"
#include "hri/signal/dwt2.hpp"

namespace hri {
namespace {

using detail::kPi;
constexpr int kNumDirections = 8;
constexpr int kSecondLevel = 2;

struct Place {
  double x_px = 0;
  double y_px = 0;
  std::size_t frame = 0;
};

// Of the silhouette's edges; an edge from dark to bright has the same as one from bright to dark.
struct Orientation {
  double angle_rad = 0;  // 0 <= angle < pi, from x towards y (down)
  double share = 0;      // 0: edges of every direction, 1: of one
};

struct CropWorkspace {
  MatrixF crop;
  std::array<Dwt2<float>, kSecondLevel> levels;
};

void fit(Dwt2<float>* level, Dwt2Shape shape) {
  for (MatrixF* band : {&level->approx, &level->horizontal, &level->vertical, &level->diagonal})
    band->resize(shape.rows, shape.cols);
}

// Eq. 5.5 of every coefficient, averaged as orientations are, by doubled angles, with the squared
// magnitude for a weight.
Orientation orientation_of(ImageView mask, int crop_px, const Wavelet& wavelet) {
  thread_local CropWorkspace w;
  w.crop.resize(crop_px, crop_px);
  crop(mask, hand_box(mask), w.crop);
  const MatrixF* image = &w.crop;
  for (Dwt2<float>& level : w.levels) {
    fit(&level, dwt2_shape(image->rows(), image->cols(), wavelet.dec_lo.size(), Border::symmetric));
    dwt2<float>(*image, wavelet, Border::symmetric,
                {level.approx, level.horizontal, level.vertical, level.diagonal});
    image = &level.approx;
  }
  const Dwt2<float>& second = w.levels.back();
  double along = 0;
  double across = 0;
  double all = 0;
  for (Eigen::Index i = 0; i < second.vertical.size(); ++i) {
    const double fg = second.horizontal.data()[i];
    const double gf = second.vertical.data()[i];
    along += gf * gf - fg * fg;
    across += 2 * gf * fg;
    all += gf * gf + fg * fg;
  }
  if (!(all > 0)) return {};
  double angle = std::atan2(across, along) / 2;
  if (angle < 0) angle += kPi;
  return {std::min(angle, std::nextafter(kPi, 0.0)), std::hypot(along, across) / all};
}

float* put_angle(double share_of_circle, double length, HybridAngles form, float* to) {
  if (form == HybridAngles::number) {
    *to++ = static_cast<float>(share_of_circle);
    return to;
  }
  const double angle = 2 * kPi * share_of_circle;
  *to++ = static_cast<float>(std::clamp(0.5 + 0.5 * length * std::cos(angle), 0.0, 1.0));
  *to++ = static_cast<float>(std::clamp(0.5 + 0.5 * length * std::sin(angle), 0.0, 1.0));
  return to;
}

// By their largest (eq. 5.10); zeros stay.
void divide_by_largest(MatrixRefF values) {
  if (values.size() == 0) return;
  const float largest = values.maxCoeff();
  if (largest > 0) values /= largest;
}

struct Way {
  std::vector<double> speed;     // share of the largest
  std::vector<int> from_middle;  // codes
  std::vector<int> step;
};

// A code for each place; where there is no direction, that of the place before, and before the
// first step that of the first.
void fill_codes(const std::vector<Place>& places, double middle_x, double middle_y, Way* way) {
  int last_step = 0;
  int last_from_middle = 0;
  bool moved = false;
  for (std::size_t t = 0; t < places.size(); ++t) {
    const double dx = places[t].x_px - middle_x;
    const double dy = places[t].y_px - middle_y;
    if (dx != 0 || dy != 0) last_from_middle = direction_code(dx, dy);
    way->from_middle[t] = last_from_middle;
    if (t + 1 < places.size()) {
      const double step_x = places[t + 1].x_px - places[t].x_px;
      const double step_y = places[t + 1].y_px - places[t].y_px;
      if (step_x != 0 || step_y != 0) {
        last_step = direction_code(step_x, step_y);
        if (!moved) std::fill_n(way->step.begin(), t, last_step);
        moved = true;
      }
    }
    way->step[t] = last_step;
  }
}

void follow(const std::vector<Place>& places, Way* way) {
  const std::size_t count = places.size();
  way->speed.assign(count, 0);
  way->from_middle.assign(count, 0);
  way->step.assign(count, 0);
  double middle_x = 0;
  double middle_y = 0;
  double largest = 0;
  for (std::size_t t = 0; t < count; ++t) {
    middle_x += places[t].x_px / static_cast<double>(count);
    middle_y += places[t].y_px / static_cast<double>(count);
    if (t + 1 < count) {
      const double length =
          std::hypot(places[t + 1].x_px - places[t].x_px, places[t + 1].y_px - places[t].y_px);
      way->speed[t] = length / static_cast<double>(places[t + 1].frame - places[t].frame);
      largest = std::max(largest, way->speed[t]);
    } else if (t > 0) {
      way->speed[t] = way->speed[t - 1];
    }
  }
  if (!(largest > 0)) return;  // it never moves
  for (double& speed : way->speed) speed /= largest;
  fill_codes(places, middle_x, middle_y, way);
}

// Where the hand is in each frame that shows it.
void find_places(Span<const ImageView> masks, std::vector<Place>* places) {
  places->clear();
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const ImageView& mask = masks[i];
    if (mask.width_px != masks[0].width_px || mask.height_px != masks[0].height_px) {
      fail(ErrorKind::invalid_argument,
           "masks: " + std::to_string(i) + " has another size than the first");
    }
    if (mask.channels != 1) {
      fail(ErrorKind::invalid_argument, "masks: " + std::to_string(i) + " has " +
                                            std::to_string(mask.channels) +
                                            " channels, must have one");
    }
    if (mask.empty()) continue;
    const auto place = hand_place(mask);
    if (place) places->push_back({place->x * mask.width_px, place->y * mask.height_px, i});
  }
}

}  // namespace

int direction_code(double dx, double dy) {
  require(std::isfinite(dx) && std::isfinite(dy), "dx and dy must be finite");
  if (dx == 0 && dy == 0) return 0;
  const double angle = std::atan2(dy + 0.0, dx);  // -0 would give -pi, which nothing turns to 4
  const double theta = angle / (kPi / 4) + 0.5 + (dy < 0 ? kNumDirections : 0);
  return (2 * kNumDirections - static_cast<int>(theta)) % kNumDirections;
}

const char* HybridFeatureOptions::conflict() const {
  return use_moments || use_orientation || use_chain_codes || use_speed
             ? nullptr
             : "use_moments, use_orientation, use_chain_codes and use_speed are all false";
}

HybridFeatureComputer::HybridFeatureComputer(const HybridFeatureOptions& options)
    : options_(validated(options)) {
  if (options.use_moments) moments_.emplace(options.moments);
  if (options.use_orientation) wavelet_.emplace(wavelet(options.wavelet));
  const int columns = options.angles == HybridAngles::number ? 1 : 2;
  num_features_ = num_moments() + (options.use_orientation ? columns : 0) +
                  (options.use_chain_codes ? 2 * columns : 0) + (options.use_speed ? 1 : 0);
}

int HybridFeatureComputer::num_moments() const { return moments_ ? moments_->num_features() : 0; }

Eigen::Index HybridFeatureComputer::compute(Span<const ImageView> masks, MatrixRefF out) const {
  require(out.rows() == static_cast<Eigen::Index>(masks.size()) && out.cols() == num_features_,
          "out must have a row for every mask and num_features() columns");
  thread_local std::vector<Place> places;
  thread_local Way way;
  find_places(masks, &places);
  follow(places, &way);
  for (std::size_t t = 0; t < places.size(); ++t) {
    const ImageView& mask = masks[places[t].frame];
    float* to = out.data() + static_cast<Eigen::Index>(t) * out.outerStride();
    if (moments_) {
      const auto count = static_cast<std::size_t>(moments_->num_features());
      moments_->compute(mask, {to, count});
      to += count;
    }
    if (wavelet_) {
      const Orientation found = orientation_of(mask, options_.crop_px, *wavelet_);
      to = put_angle(found.angle_rad / kPi, found.share, options_.angles, to);
    }
    if (options_.use_chain_codes) {
      to = put_angle(static_cast<double>(way.from_middle[t]) / kNumDirections, 1, options_.angles,
                     to);
      to = put_angle(static_cast<double>(way.step[t]) / kNumDirections, 1, options_.angles, to);
    }
    if (options_.use_speed) *to = static_cast<float>(options_.speed_weight * way.speed[t]);
  }
  const auto used = static_cast<Eigen::Index>(places.size());
  if (moments_ && options_.moment_scale == HybridMomentScale::gesture) {
    divide_by_largest(out.topLeftCorner(used, num_moments()));
  } else if (moments_) {
    for (int k = 0; k < num_moments(); ++k) divide_by_largest(out.block(0, k, used, 1));
  }
  return used;
}

MatrixF HybridFeatureComputer::compute(Span<const ImageView> masks) const {
  MatrixF out(static_cast<Eigen::Index>(masks.size()), num_features_);
  const Eigen::Index used = compute(masks, out);
  return out.topRows(used);
}

}  // namespace hri
