// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/colour_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "hri/features/hand/regions.hpp"

namespace hri::detail {
namespace {

constexpr int kNumValues = 6;
constexpr int kNumBins = 256;
constexpr int kMajority_px = 1;        // 3 x 3 pixels
constexpr int kBand_px = 5;            // both sides of an outline, for its sharpness
constexpr double kRidge = 1e-4;        // keeps channels that hardly vary from large weights
constexpr double kMinMeanArea = 0.01;  // of the frames learned from

using Values = Eigen::Matrix<double, kNumValues, 1>;
using Square = Eigen::Matrix<double, kNumValues, kNumValues>;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, kNumValues, Eigen::RowMajor>;

// Redness and brightness before anything is known of the hand, as weights of the six values:
// logarithms of blue, green, red, then their levels.
constexpr std::array<std::array<float, kNumValues>, 5> kStarts{{
    {0, 0, 1, 0, 0, 0},
    {0, 0, 0, 0, -1, 1},
    {0, 0, 0, -1, -1, 2},
    {0, -1, 1, 0, 0, 0},
    {-1, -1, 2, 0, 0, 0},
}};

struct Split {
  float threshold = 0;
  double quality = 0;  // between-class share of the variance
};

// Where values that are not worth a bin of their own end, from below and from above: one value in
// kStray on each side.
struct Range {
  float low = 0;
  float high = 0;
};

// Otsu's threshold over scores, over a histogram of the range that holds all but stray ones.
class Otsu {
 public:
  // No score lies below `least` or above `most`.
  Split split(const std::vector<float>& scores, float least, float most) {
    const Range range = without_stray(scores, least, most);
    if (!(range.high > range.low)) return {range.high, 0};
    return threshold(scores, range);
  }

 private:
  static constexpr std::size_t kStray = 500;
  static constexpr int kNumPlaces = 4096;  // coarse places; within one, scores are sorted out

  Range without_stray(const std::vector<float>& scores, float least, float most) {
    if (!(most > least)) return {most, most};
    const float scale = static_cast<float>(kNumPlaces) / (most - least);
    const auto place = [&](float s) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>((s - least) * scale), 0, kNumPlaces - 1));
    };
    counts_.assign(kNumPlaces, 0);
    for (const float s : scores) ++counts_[place(s)];
    const std::size_t stray = scores.size() / kStray;
    const Rank low = rank(stray);
    const Rank high = rank(scores.size() - 1 - stray);
    at_low_.clear();
    at_high_.clear();
    for (const float s : scores) {
      const std::size_t p = place(s);
      if (p == low.place) at_low_.push_back(s);
      if (p == high.place) at_high_.push_back(s);
    }
    return {nth(&at_low_, low.within), nth(&at_high_, high.within)};
  }

  struct Rank {
    std::size_t place = 0;
    std::size_t within = 0;  // how many of the same place come before
  };
  [[nodiscard]] Rank rank(std::size_t n) const {
    std::size_t place = 0;
    while (n >= counts_[place]) n -= counts_[place++];
    return {place, n};
  }
  static float nth(std::vector<float>* values, std::size_t n) {
    const auto at = values->begin() + static_cast<std::ptrdiff_t>(n);
    std::nth_element(values->begin(), at, values->end());
    return *at;
  }

  static Split threshold(const std::vector<float>& scores, Range range);

  std::vector<std::size_t> counts_;
  std::vector<float> at_low_, at_high_;
};

Split Otsu::threshold(const std::vector<float>& scores, Range range) {
  std::array<int, kNumBins> count{};
  const float scale = kNumBins / (range.high - range.low);
  for (const float s : scores) {
    if (s < range.low || s > range.high) continue;
    ++count[static_cast<std::size_t>(
        std::min(kNumBins - 1, static_cast<int>((s - range.low) * scale)))];
  }
  double total = 0;
  double sum = 0;
  double squares = 0;
  for (int bin = 0; bin < kNumBins; ++bin) {
    const double n = count[static_cast<std::size_t>(bin)];
    total += n;
    sum += n * bin;
    squares += n * bin * bin;
  }
  double below = 0;
  double below_sum = 0;
  double best = 0;
  int best_bin = 0;
  for (int bin = 0; bin < kNumBins - 1; ++bin) {
    below += count[static_cast<std::size_t>(bin)];
    below_sum += static_cast<double>(bin) * count[static_cast<std::size_t>(bin)];
    if (below == 0 || below == total) continue;
    const double apart = sum * below / total - below_sum;
    const double between = apart * apart / (below * (total - below));
    if (between > best) {
      best = between;
      best_bin = bin;
    }
  }
  const double variance = squares / total - (sum / total) * (sum / total);
  return {range.low + static_cast<float>(best_bin + 1) / scale,
          variance > 0 ? best / total / variance : 0};
}

class Fitter {
 public:
  Fitter(const std::vector<ColourImage>& frames, const HandColourOptions& options)
      : frames_(frames), options_(options), masks_(frames.size()) {
    std::size_t count = 0;
    for (const ColourImage& f : frames_) count += f.num_pixels();
    for (int v = 0; v < kNumBins; ++v) {
      logs_[static_cast<std::size_t>(v)] = log_level(v);
      levels_[static_cast<std::size_t>(v)] = level(v);
    }
    Rows all(static_cast<Eigen::Index>(count), kNumValues);
    Eigen::Index row = 0;
    for (const ColourImage& f : frames_) {
      for (std::size_t i = 0; i < f.num_pixels(); ++i)
        set_values(f.pixels.data() + 3 * i, &all, row++);
    }
    sum_ = all.cast<double>().colwise().sum();
    products_ = moments(all);
    scores_.resize(count);
  }

  // What a start leads to, and how convincing a hand that is; the rank is -infinity for none.
  struct Outcome {
    ColourFit fit;
    double rank = -std::numeric_limits<double>::infinity();
  };

  Outcome improve(const std::array<float, kNumValues>& start, bool split_again) {
    Outcome outcome;
    outcome.fit.weights = start;
    Split split = score(start);
    if (split_again) {  // what lies above the threshold, as a picture of its own
      std::vector<float> above;
      std::copy_if(scores_.begin(), scores_.end(), std::back_inserter(above),
                   [&](float s) { return s > split.threshold; });
      if (above.empty()) return outcome;
      split.threshold = otsu_.split(above, least_, most_).threshold;
    }
    for (int round = 0; round < options_.num_rounds; ++round) {
      if (!segment(split.threshold)) return outcome;
      outcome.fit.weights = discriminant();
      split = score(outcome.fit.weights);
    }
    const double before = share_above(split.threshold);
    if (!segment(split.threshold)) return outcome;
    outcome.fit.threshold = split.threshold;
    outcome.fit.quality = sharpness();
    const double in_one_piece = mean_area_ / std::max(before, 1e-9);
    outcome.rank = outcome.fit.quality + 0.5 * split.quality - 2 * border_share() -
                   std::max(0.0, 1 - in_one_piece) - share_of_empty_;
    return outcome;
  }

 private:
  static Square moments(const Rows& rows) {
    const Eigen::Matrix<float, kNumValues, kNumValues> m = rows.transpose() * rows;
    return m.cast<double>();
  }

  void set_values(const std::uint8_t* bgr, Rows* rows, Eigen::Index row) const {
    for (int c = 0; c < 3; ++c) {
      (*rows)(row, c) = logs_[bgr[c]];
      (*rows)(row, c + 3) = levels_[bgr[c]];
    }
  }

  Split score(const std::array<float, kNumValues>& weights) {
    const ScoreTables tables = score_tables(weights);
    least_ = most_ = 0;
    for (const auto& table : tables) {
      least_ += *std::min_element(table.begin(), table.end());
      most_ += *std::max_element(table.begin(), table.end());
    }
    float* out = scores_.data();
    for (const ColourImage& f : frames_) {
      const std::uint8_t* bgr = f.pixels.data();
      for (std::size_t i = 0; i < f.num_pixels(); ++i, bgr += 3)
        *out++ = tables[0][bgr[0]] + tables[1][bgr[1]] + tables[2][bgr[2]];
    }
    return otsu_.split(scores_, least_, most_);
  }

  [[nodiscard]] double share_above(float threshold) const {
    const auto above =
        std::count_if(scores_.begin(), scores_.end(), [&](float s) { return s > threshold; });
    return static_cast<double>(above) / static_cast<double>(scores_.size());
  }

  // The largest regions of every frame; false where it cannot be a hand.
  bool segment(float threshold) {
    const float* score = scores_.data();
    num_inside_ = 0;
    int empty = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      resize(&raw_, frames_[i].width_px, frames_[i].height_px);
      for (std::uint8_t& p : raw_.pixels) p = *score++ > threshold ? 255 : 0;
      majority(raw_, kMajority_px, &counts_, &masks_[i]);
      if (!regions_.keep_largest(&masks_[i], options_.min_area, options_.max_hands)) ++empty;
      num_inside_ += count_set(masks_[i].pixels.data(), 1, masks_[i].pixels.size());
    }
    mean_area_ = static_cast<double>(num_inside_) / static_cast<double>(scores_.size());
    share_of_empty_ = empty / static_cast<double>(frames_.size());
    return mean_area_ >= kMinMeanArea && mean_area_ <= options_.max_area;
  }

  static std::ptrdiff_t count_set(const std::uint8_t* pixels, std::size_t step, std::size_t count) {
    std::ptrdiff_t result = 0;
    for (std::size_t i = 0; i < count; ++i) result += pixels[i * step] != 0 ? 1 : 0;
    return result;
  }

  // Fisher's discriminant between the masks and the rest, scaled to scores of unit spread.
  [[nodiscard]] std::array<float, kNumValues> discriminant() const {
    Rows inside(static_cast<Eigen::Index>(num_inside_), kNumValues);
    Eigen::Index used = 0;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const std::uint8_t* bgr = frames_[f].pixels.data();
      for (const std::uint8_t in : masks_[f].pixels) {
        if (in != 0) set_values(bgr, &inside, used++);
        bgr += 3;
      }
    }
    const auto n = static_cast<double>(num_inside_);
    const double rest = static_cast<double>(scores_.size()) - n;
    const Values hand_sum = inside.cast<double>().colwise().sum();
    const Square hand_products = moments(inside);
    const Values hand = hand_sum / n;
    const Values wall = (sum_ - hand_sum) / rest;
    const Square hand_spread = hand_products / n - hand * hand.transpose();
    const Square wall_spread = (products_ - hand_products) / rest - wall * wall.transpose();
    const Square spread = 0.5 * (hand_spread + wall_spread) + kRidge * Square::Identity();
    const Values w = spread.ldlt().solve(hand - wall);
    const double apart = std::max((hand - wall).dot(w), 1e-9);
    std::array<float, kNumValues> weights{};
    Eigen::Map<Eigen::Matrix<float, kNumValues, 1>>(weights.data()) =
        (w / std::sqrt(apart)).cast<float>();
    return weights;
  }

  // Share of the hand on the upper and side borders of the frames: there the hand rarely is, and a
  // wall always.
  [[nodiscard]] double border_share() const {
    double inside = 0;
    double all = 0;
    for (const GreyImage& m : masks_) {
      const auto width = static_cast<std::size_t>(m.width_px);
      const auto height = static_cast<std::size_t>(m.height_px);
      inside += static_cast<double>(count_set(m.pixels.data(), 1, width) +
                                    count_set(m.pixels.data(), width, height) +
                                    count_set(m.pixels.data() + width - 1, width, height));
      all += static_cast<double>(width + 2 * height);
    }
    return inside / all;
  }

  // Between-class share of the variance of the scores in a narrow band round the outlines.
  [[nodiscard]] double sharpness() {
    std::array<double, 2> count{};
    std::array<double, 2> sum{};
    double squares = 0;
    const float* score = scores_.data();
    for (const GreyImage& m : masks_) {
      find_band(m, kBand_px / 2, &bytes_, &raw_);
      for (std::size_t i = 0; i < m.pixels.size(); ++i, ++score) {
        if (raw_.pixels[i] == 0) continue;
        const std::size_t side = m.pixels[i] != 0 ? 1 : 0;
        ++count[side];
        sum[side] += *score;
        squares += static_cast<double>(*score) * *score;
      }
    }
    if (count[0] == 0 || count[1] == 0) return 0;
    const double n = count[0] + count[1];
    const double mean = (sum[0] + sum[1]) / n;
    const double variance = squares / n - mean * mean;
    const double apart = sum[1] / count[1] - sum[0] / count[0];
    return variance > 0 ? count[0] * count[1] / (n * n) * apart * apart / variance : 0;
  }

  const std::vector<ColourImage>& frames_;
  const HandColourOptions& options_;
  std::array<float, kNumBins> logs_{}, levels_{};
  Values sum_;
  Square products_;
  std::vector<float> scores_;
  float least_ = 0;  // what no score lies below
  float most_ = 0;   // or above
  std::vector<GreyImage> masks_;
  std::ptrdiff_t num_inside_ = 0;
  double mean_area_ = 0;
  double share_of_empty_ = 0;
  Otsu otsu_;
  RegionFinder regions_;
  GreyImage raw_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> counts_;
};

}  // namespace

ScoreTables score_tables(const std::array<float, 6>& weights) {
  ScoreTables tables{};
  for (std::size_t c = 0; c < tables.size(); ++c) {
    for (int v = 0; v < kNumBins; ++v)
      tables[c][static_cast<std::size_t>(v)] =
          weights[c] * log_level(v) + weights[c + 3] * level(v);
  }
  return tables;
}

std::optional<ColourFit> fit_colours(const std::vector<ColourImage>& frames,
                                     const HandColourOptions& options) {
  Fitter fitter(frames, options);
  Fitter::Outcome best;
  for (const auto& start : kStarts) {
    for (const bool split_again : {false, true}) {
      const Fitter::Outcome outcome = fitter.improve(start, split_again);
      if (outcome.rank > best.rank) best = outcome;
    }
  }
  if (best.rank == -std::numeric_limits<double>::infinity() ||
      best.fit.quality < options.min_quality)
    return std::nullopt;
  return best.fit;
}

}  // namespace hri::detail
