// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hri/core/error.hpp"

namespace hri {
namespace {

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

Eigen::Index argmax(const VectorF& scores) {
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  return best;
}

}  // namespace

const char* status_name(DecisionStatus status) {
  switch (status) {
    case DecisionStatus::recognised:
      return "recognised";
    case DecisionStatus::unknown:
      return "unknown";
    case DecisionStatus::no_input:
      break;
  }
  return "no_input";
}

Calibration Calibration::fit(const std::vector<HeldOut>& held_out, double false_reject_rate) {
  require(false_reject_rate >= 0 && false_reject_rate <= 0.5,
          "false_reject_rate must lie in 0..0.5");
  Calibration result;
  std::vector<float> right;
  for (const HeldOut& h : held_out) {
    if (argmax(h.scores) == h.truth) right.push_back(h.score);
  }
  if (right.empty()) return result;
  result.scale_ = best_scale(held_out);
  std::sort(right.begin(), right.end());
  const auto rank = static_cast<std::size_t>(false_reject_rate * static_cast<double>(right.size()));
  result.threshold_ = static_cast<double>(right[std::min(rank, right.size() - 1)]);
  return result;
}

VectorF Calibration::posterior(const VectorF& scores) const {
  const auto scale = static_cast<float>(scale_);
  VectorF p = ((scores.array() - scores.maxCoeff()) * scale).exp().matrix();
  return p / p.sum();
}

Decision Calibration::decide(const VectorF& scores, float score,
                             const std::vector<std::string>& labels) const {
  const VectorF p = posterior(scores);
  std::vector<Eigen::Index> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return scores[a] > scores[b]; });
  Decision d;
  for (const Eigen::Index c : order)
    d.nbest.push_back({labels[static_cast<std::size_t>(c)], p[c], scores[c]});
  const bool accepted = score >= static_cast<float>(threshold_);
  d.status = accepted ? DecisionStatus::recognised : DecisionStatus::unknown;
  d.label = accepted ? d.nbest.front().label : status_name(d.status);
  d.confidence = d.nbest.front().probability;
  d.score = score;
  return d;
}

void Calibration::write(ModelFile& file) const {
  file.set_number("calibration.scale", scale_);
  file.set_number("calibration.threshold", threshold_);
}

Calibration Calibration::read(const ModelFile& file) {
  Calibration result;
  result.scale_ = file.number("calibration.scale");
  result.threshold_ = file.number("calibration.threshold");
  if (!(result.scale_ > 0)) fail(ErrorKind::format, "calibration.scale must be positive");
  return result;
}

}  // namespace hri
