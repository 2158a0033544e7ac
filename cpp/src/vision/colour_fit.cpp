// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "colour_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace hri::detail {
namespace {

constexpr int kNumValues = 6;
constexpr int kNumBins = 256;
constexpr int kMedian_px = 3;
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

// Otsu's threshold over `values`, over a histogram of the range that holds all but stray values.
Split otsu(const std::vector<float>& values) {
  constexpr std::size_t kStray = 500;  // one value of so many on each side
  std::vector<float> sorted = values;
  const std::size_t stray = sorted.size() / kStray;
  const auto low_at = sorted.begin() + static_cast<std::ptrdiff_t>(stray);
  const auto high_at = sorted.end() - 1 - static_cast<std::ptrdiff_t>(stray);
  std::nth_element(sorted.begin(), low_at, sorted.end());
  const float low = *low_at;
  std::nth_element(low_at, high_at, sorted.end());
  const float high = *high_at;
  if (!(high > low)) return {high, 0};
  std::array<double, kNumBins> count{};
  double total = 0;
  double sum = 0;
  double squares = 0;
  const float scale = kNumBins / (high - low);
  for (const float v : values) {
    if (v < low || v > high) continue;
    const int bin = std::min(kNumBins - 1, static_cast<int>((v - low) * scale));
    ++count[static_cast<std::size_t>(bin)];
    ++total;
    sum += bin;
    squares += static_cast<double>(bin) * bin;
  }
  double below = 0;
  double below_sum = 0;
  double best = 0;
  int best_bin = 0;
  for (int bin = 0; bin < kNumBins - 1; ++bin) {
    below += count[static_cast<std::size_t>(bin)];
    below_sum += bin * count[static_cast<std::size_t>(bin)];
    if (below == 0 || below == total) continue;
    const double apart = sum * below / total - below_sum;
    const double between = apart * apart / (below * (total - below));
    if (between > best) {
      best = between;
      best_bin = bin;
    }
  }
  const double variance = squares / total - (sum / total) * (sum / total);
  return {low + static_cast<float>(best_bin + 1) / scale,
          variance > 0 ? best / total / variance : 0};
}

class Fitter {
 public:
  Fitter(const FitPixels& pixels, const HandColourOptions& options)
      : frames_(pixels.frames), options_(options) {
    Eigen::Index count = 0;
    for (const cv::Mat& f : frames_) count += static_cast<Eigen::Index>(f.total());
    values_.resize(count, kNumValues);
    Eigen::Index at = 0;
    for (const cv::Mat& f : frames_) {
      for (int y = 0; y < f.rows; ++y) {
        const auto* pixel = f.ptr<uchar>(y);
        for (int x = 0; x < f.cols; ++x, pixel += 3, ++at) {
          for (int c = 0; c < 3; ++c) {
            values_(at, c) = log_level(pixel[c]);
            values_(at, c + 3) = level(pixel[c]);
          }
        }
      }
    }
    sum_ = values_.cast<double>().colwise().sum();
    products_ = moments(Rows(values_));
    scores_.resize(static_cast<std::size_t>(count));
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
      split.threshold = otsu(above).threshold;
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

  Split score(const std::array<float, kNumValues>& weights) {
    const Eigen::Map<const Eigen::Matrix<float, kNumValues, 1>> w(weights.data());
    Eigen::Map<Eigen::VectorXf>(scores_.data(), static_cast<Eigen::Index>(scores_.size())) =
        values_ * w;
    return otsu(scores_);
  }

  [[nodiscard]] double share_above(float threshold) const {
    const auto above =
        std::count_if(scores_.begin(), scores_.end(), [&](float s) { return s > threshold; });
    return static_cast<double>(above) / static_cast<double>(scores_.size());
  }

  // The largest region of every frame; false where it cannot be a hand.
  bool segment(float threshold) {
    masks_.clear();
    std::size_t at = 0;
    double inside = 0;
    int empty = 0;
    for (const cv::Mat& f : frames_) {
      cv::Mat mask(f.size(), CV_8U);
      for (int i = 0; i < static_cast<int>(f.total()); ++i, ++at)
        mask.data[i] = scores_[at] > threshold ? 255 : 0;
      cv::medianBlur(mask, mask, kMedian_px);
      if (!keep_largest(mask, options_.min_area)) ++empty;
      inside += cv::countNonZero(mask);
      masks_.push_back(mask);
    }
    mean_area_ = inside / static_cast<double>(scores_.size());
    share_of_empty_ = empty / static_cast<double>(frames_.size());
    return mean_area_ >= kMinMeanArea && mean_area_ <= options_.max_area;
  }

  // Fisher's discriminant between the masks and the rest, scaled to scores of unit spread.
  [[nodiscard]] std::array<float, kNumValues> discriminant() const {
    const auto inside_count =
        static_cast<Eigen::Index>(std::lround(mean_area_ * static_cast<double>(values_.rows())));
    Rows inside(inside_count, kNumValues);
    Eigen::Index row = 0;
    Eigen::Index used = 0;
    for (const cv::Mat& m : masks_) {
      for (int i = 0; i < static_cast<int>(m.total()); ++i, ++row) {
        if (m.data[i] != 0) inside.row(used++) = values_.row(row);
      }
    }
    const auto n = static_cast<double>(inside_count);
    const double rest = static_cast<double>(values_.rows()) - n;
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
    for (const cv::Mat& m : masks_) {
      inside += cv::countNonZero(m.row(0)) + cv::countNonZero(m.col(0)) +
                cv::countNonZero(m.col(m.cols - 1));
      all += m.cols + 2 * m.rows;
    }
    return inside / all;
  }

  // Between-class share of the variance of the scores in a narrow band round the outlines.
  [[nodiscard]] double sharpness() const {
    const cv::Mat kernel = cv::Mat::ones(kBand_px, kBand_px, CV_8U);
    std::array<double, 2> count{};
    std::array<double, 2> sum{};
    double squares = 0;
    std::size_t at = 0;
    cv::Mat inner;
    cv::Mat outer;
    for (const cv::Mat& m : masks_) {
      cv::erode(m, inner, kernel);
      cv::dilate(m, outer, kernel);
      for (int i = 0; i < static_cast<int>(m.total()); ++i, ++at) {
        if (inner.data[i] != 0 || outer.data[i] == 0) continue;
        const std::size_t side = m.data[i] != 0 ? 1 : 0;
        ++count[side];
        sum[side] += scores_[at];
        squares += static_cast<double>(scores_[at]) * scores_[at];
      }
    }
    if (count[0] == 0 || count[1] == 0) return 0;
    const double n = count[0] + count[1];
    const double mean = (sum[0] + sum[1]) / n;
    const double variance = squares / n - mean * mean;
    const double apart = sum[1] / count[1] - sum[0] / count[0];
    return variance > 0 ? count[0] * count[1] / (n * n) * apart * apart / variance : 0;
  }

  const std::vector<cv::Mat>& frames_;
  const HandColourOptions& options_;
  Rows values_;
  Values sum_;
  Square products_;
  std::vector<float> scores_;
  std::vector<cv::Mat> masks_;
  double mean_area_ = 0;
  double share_of_empty_ = 0;
};

}  // namespace

std::optional<ColourFit> fit_colours(const FitPixels& pixels, const HandColourOptions& options) {
  Fitter fitter(pixels, options);
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

bool keep_largest(cv::Mat& mask, double min_area) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids);
  int largest = 0;
  int area = 0;
  for (int i = 1; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) <= area) continue;
    area = stats.at<int>(i, cv::CC_STAT_AREA);
    largest = i;
  }
  if (largest == 0 || area < min_area * static_cast<double>(mask.total())) {
    mask.setTo(0);
    return false;
  }
  mask = labels == largest;
  return true;
}

}  // namespace hri::detail
