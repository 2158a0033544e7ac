// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

Eigen::Index argmax(const VectorF& scores) {
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  return best;
}

// Mean negative log posterior of the true classes at a given scale.
double mean_nll(const std::vector<HeldOut>& held_out, double scale) {
  double sum = 0;
  for (const HeldOut& h : held_out) {
    const double top = h.scores.maxCoeff();
    double z = 0;
    for (Eigen::Index c = 0; c < h.scores.size(); ++c) z += std::exp(scale * (h.scores[c] - top));
    sum += std::log(z) - scale * (h.scores[h.truth] - top);
  }
  return sum / static_cast<double>(held_out.size());
}

// Golden-section search on log10(scale); the negative log-likelihood of a temperature is unimodal
// in it.
double best_scale(const std::vector<HeldOut>& held_out) {
  constexpr double kRatio = 0.6180339887498949;
  double low = -4;
  double high = 3;
  for (int i = 0; i < 60; ++i) {
    const double a = high - kRatio * (high - low);
    const double b = low + kRatio * (high - low);
    if (mean_nll(held_out, std::pow(10.0, a)) < mean_nll(held_out, std::pow(10.0, b))) {
      high = b;
    } else {
      low = a;
    }
  }
  return std::pow(10.0, 0.5 * (low + high));
}

bool all_right(const std::vector<HeldOut>& held_out) {
  return std::all_of(held_out.begin(), held_out.end(),
                     [](const HeldOut& h) { return argmax(h.scores) == h.truth; });
}

// Mean posterior of the true classes.
double mean_confidence(const std::vector<HeldOut>& held_out, double scale) {
  double sum = 0;
  for (const HeldOut& h : held_out) {
    const double top = h.scores[h.truth];
    double z = 0;
    for (Eigen::Index c = 0; c < h.scores.size(); ++c) z += std::exp(scale * (h.scores[c] - top));
    sum += 1 / z;
  }
  return sum / static_cast<double>(held_out.size());
}

// Where all n decisions are right, the likelihood grows with the scale for ever, and all others
// would be sure, too. By Laplace's rule of succession the next one is right with a probability of
// (n + 1) / (n + 2): as sure they are on average.
double scale_of_right(const std::vector<HeldOut>& held_out) {
  const auto n = static_cast<double>(held_out.size());
  double low = -4;
  double high = 3;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (mean_confidence(held_out, std::pow(10.0, middle)) < (n + 1) / (n + 2)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return std::pow(10.0, 0.5 * (low + high));
}

// Held-out scores give at most 1e3 (best_scale).
constexpr double kMaxScale = 1e6;

// The threshold of one class from the confidences of held-out decisions for it: `right` ones, and
// `wrong` ones among `num_others` samples of other classes.
float class_threshold(std::vector<float> right, std::vector<float> wrong, std::size_t num_others) {
  std::sort(right.begin(), right.end());
  std::sort(wrong.rbegin(), wrong.rend());
  const auto allowed = [](double rate, std::size_t count) {
    return static_cast<std::size_t>(rate * static_cast<double>(count));
  };
  float threshold = 0;
  const std::size_t false_alarms = allowed(Calibration::kMaxFalseAlarmRate, num_others);
  if (false_alarms < wrong.size())
    threshold = std::nextafter(wrong[false_alarms], std::numeric_limits<float>::max());
  if (!right.empty())
    threshold = std::min(threshold, right[allowed(Calibration::kMaxMissRate, right.size())]);
  return std::max(threshold, Calibration::kMinClassThreshold);
}

// The score at which so large a share of sorted ones lies below.
float quantile(const std::vector<float>& sorted, double share, bool interpolate) {
  const auto count = static_cast<double>(sorted.size());
  const double last = count - 1;
  if (!interpolate) return sorted[static_cast<std::size_t>(std::min(share * count, last))];
  const double rank = std::clamp((count + 1.0 / 3) * share - 2.0 / 3, 0.0, last);
  const auto below = static_cast<std::size_t>(rank);
  const auto part = static_cast<float>(rank - static_cast<double>(below));
  const float above = sorted[std::min(below + 1, sorted.size() - 1)];
  return (1 - part) * sorted[below] + part * above;
}

}  // namespace

Calibration Calibration::fit(const std::vector<HeldOut>& held_out, const RejectionRates& rates) {
  require(rates.false_reject >= 0 && rates.false_reject <= 0.5,
          "false_reject_rate must lie in 0..0.5");
  Calibration result;
  std::vector<float> right;
  for (const HeldOut& h : held_out) {
    if (argmax(h.scores) == h.truth) right.push_back(h.score);
  }
  if (right.empty()) return result;
  result.scale_ = all_right(held_out) ? scale_of_right(held_out) : best_scale(held_out);
  std::sort(right.begin(), right.end());
  result.threshold_ = static_cast<double>(quantile(right, rates.false_reject, rates.interpolate));

  const auto num_classes = static_cast<std::size_t>(held_out.front().scores.size());
  std::vector<std::vector<float>> right_of(num_classes);
  std::vector<std::vector<float>> wrong_of(num_classes);
  std::vector<std::size_t> samples_of(num_classes);
  for (const HeldOut& h : held_out) {
    ++samples_of[static_cast<std::size_t>(h.truth)];
    if (h.score < static_cast<float>(result.threshold_)) continue;  // rejected: no false alarm
    const Eigen::Index best = argmax(h.scores);
    auto& list = best == h.truth ? right_of : wrong_of;
    list[static_cast<std::size_t>(best)].push_back(result.posterior(h.scores)[best]);
  }
  result.class_thresholds_.resize(static_cast<Eigen::Index>(num_classes));
  for (std::size_t c = 0; c < num_classes; ++c) {
    result.class_thresholds_[static_cast<Eigen::Index>(c)] =
        class_threshold(right_of[c], wrong_of[c], held_out.size() - samples_of[c]);
  }
  return result;
}

Calibration Calibration::with_class(int index) const {
  Calibration result = *this;
  const Eigen::Index n = class_thresholds_.size();
  if (n == 0) return result;
  result.class_thresholds_.resize(n + 1);
  result.class_thresholds_ << class_thresholds_.head(index), class_thresholds_.maxCoeff(),
      class_thresholds_.tail(n - index);
  return result;
}

Calibration Calibration::without_class(int index) const {
  Calibration result = *this;
  const Eigen::Index n = class_thresholds_.size();
  if (n == 0) return result;
  result.class_thresholds_.resize(n - 1);
  result.class_thresholds_ << class_thresholds_.head(index), class_thresholds_.tail(n - 1 - index);
  return result;
}

VectorF Calibration::posterior(const VectorF& scores) const {
  const auto scale = static_cast<float>(scale_);
  VectorF p = ((scores.array() - scores.maxCoeff()) * scale).exp().matrix();
  return p / p.sum();
}

namespace {

Decision unknown_decision() {
  Decision d;
  d.status = DecisionStatus::unknown;
  d.label = enum_name(d.status);
  return d;
}

}  // namespace

bool Calibration::accepts(float score) const {
  return score >= static_cast<float>(threshold_) && score <= std::numeric_limits<float>::max();
}

Decision Calibration::decide(const VectorF& scores, float score,
                             const std::vector<std::string>& labels) const {
  require(!labels.empty() && labels.size() <= static_cast<std::size_t>(scores.size()),
          "every label needs a score");
  // A class may be impossible; a score that is no number, or is beyond all, decides nothing.
  if (scores.hasNaN() || !std::isfinite(scores.maxCoeff()) || std::isnan(score) ||
      score > std::numeric_limits<float>::max())
    return unknown_decision();
  const VectorF p = posterior(scores);
  std::vector<Eigen::Index> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return scores[a] > scores[b]; });
  Decision d;
  for (const Eigen::Index c : order)
    d.nbest.push_back({labels[static_cast<std::size_t>(c)], p[c], scores[c]});
  const bool accepted = accepts(score);
  d.status = accepted ? DecisionStatus::recognised : DecisionStatus::unknown;
  d.label = accepted ? d.nbest.front().label : enum_name(d.status);
  d.confidence = d.nbest.front().probability;
  d.score = score;
  if (class_thresholds_.size() > 0) d.class_threshold = class_thresholds_[order.front()];
  return d;
}

void Calibration::write(ModelFile& file) const {
  file.set_number("calibration.scale", scale_);
  file.set_number("calibration.threshold", threshold_);
  if (class_thresholds_.size() > 0)
    file.set_vector("calibration.class_thresholds", class_thresholds_);
}

Calibration Calibration::read(const ModelFile& file) {
  Calibration result;
  result.scale_ = file.number("calibration.scale");
  result.threshold_ = file.number("calibration.threshold");
  if (!(result.scale_ > 0 && result.scale_ <= kMaxScale)) {
    fail(ErrorKind::format, file.name() +
                                ": field 'calibration.scale' must lie in 0..1e6, 0 excluded, got " +
                                file.text("calibration.scale"));
  }
  if (file.has("calibration.class_thresholds")) {
    const VectorF thresholds = file.vector_f("calibration.class_thresholds");
    if (static_cast<std::size_t>(thresholds.size()) != file.text_list("labels").size() ||
        thresholds.minCoeff() < 0 || thresholds.maxCoeff() > 1) {
      fail(ErrorKind::format,
           file.name() +
               ": field 'calibration.class_thresholds' must be one number in 0..1 a label");
    }
    result.class_thresholds_ = thresholds;
  }
  return result;
}

}  // namespace hri
