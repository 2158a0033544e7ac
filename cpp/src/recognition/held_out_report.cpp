// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/held_out_report.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kLabels = "held_out.labels";
constexpr const char* kConfusion = "held_out.confusion";
constexpr const char* kFalseRejects = "held_out.false_reject_rate";
constexpr const char* kOthers = "held_out.num_others";
constexpr const char* kFalseAccepts = "held_out.false_accept_rate";
constexpr float kMaxCount = 1e7F;

double rate_in(const ModelFile& file, const char* field) {
  const double value = file.number(field);
  if (value >= 0 && value <= 1) return value;
  fail(ErrorKind::format,
       file.name() + ": field '" + field + "' must lie in 0..1, got " + file.text(field));
}

// Older files do not say: every sample was treated as unknown where there were three classes.
int others_in(const ModelFile& file, const HeldOutReport& report) {
  if (!file.has(kOthers)) return report.labels.size() > 2 ? report.num_samples() : 0;
  const std::int64_t value = file.integer(kOthers);
  if (value >= 0 && value <= static_cast<std::int64_t>(kMaxCount)) return static_cast<int>(value);
  fail(ErrorKind::format,
       file.name() + ": field '" + kOthers + "' must lie in 0..1e7, got " + std::to_string(value));
}

double share(std::ptrdiff_t count, std::size_t of) {
  return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0.0;
}

}  // namespace

HeldOutReport HeldOutReport::from_decisions(std::vector<std::string> labels,
                                            const std::vector<HeldOut>& decisions,
                                            const std::vector<float>& others,
                                            const Calibration& calibration) {
  HeldOutReport report;
  if (decisions.empty()) return report;
  const auto num_classes = static_cast<Eigen::Index>(labels.size());
  report.labels = std::move(labels);
  report.confusion = MatrixF::Zero(num_classes, num_classes);
  std::size_t num_right = 0;
  std::ptrdiff_t num_rejected = 0;
  for (const HeldOut& decision : decisions) {
    Eigen::Index best = 0;
    decision.scores.maxCoeff(&best);
    report.confusion(decision.truth, best) += 1;
    if (best != decision.truth) continue;
    ++num_right;
    if (!calibration.accepts(decision.score)) ++num_rejected;
  }
  const auto num_accepted = std::count_if(others.begin(), others.end(),
                                          [&](float score) { return calibration.accepts(score); });
  report.false_reject_rate = share(num_rejected, num_right);
  report.num_others = static_cast<int>(others.size());
  report.false_accept_rate = share(num_accepted, others.size());
  return report;
}

double HeldOutReport::accuracy() const {
  const double total = static_cast<double>(confusion.sum());
  return total > 0 ? static_cast<double>(confusion.trace()) / total : 0;
}

std::vector<ConfusedPair> HeldOutReport::confused_pairs() const {
  std::vector<ConfusedPair> pairs;
  for (Eigen::Index a = 0; a < confusion.rows(); ++a) {
    for (Eigen::Index b = a + 1; b < confusion.cols(); ++b) {
      const float wrong = confusion(a, b) + confusion(b, a);
      if (wrong < static_cast<float>(kMinConfusions)) continue;
      const float all = wrong + confusion(a, a) + confusion(b, b);
      const double rate = static_cast<double>(wrong) / static_cast<double>(all);
      if (rate >= kMinConfusionRate)
        pairs.push_back({static_cast<int>(a), static_cast<int>(b), rate});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.rate > b.rate; });
  return pairs;
}

HeldOutReport HeldOutReport::without(const std::string& label) const {
  const auto found = std::find(labels.begin(), labels.end(), label);
  if (found == labels.end()) return *this;
  HeldOutReport result = *this;
  const Eigen::Index at = found - labels.begin();
  const Eigen::Index behind = confusion.rows() - at - 1;
  result.labels.erase(result.labels.begin() + at);
  result.confusion.resize(at + behind, at + behind);
  result.confusion << confusion.topLeftCorner(at, at), confusion.topRightCorner(at, behind),
      confusion.bottomLeftCorner(behind, at), confusion.bottomRightCorner(behind, behind);
  if (result.confusion.sum() > 0) return result;
  return {};
}

void HeldOutReport::write(ModelFile& file) const {
  if (empty()) return;
  file.set_text_list(kLabels, labels);
  file.set_matrix(kConfusion, ConstMatrixRefF(confusion));
  file.set_number(kFalseRejects, false_reject_rate);
  file.set_integer(kOthers, num_others);
  if (num_others > 0) file.set_number(kFalseAccepts, false_accept_rate);
}

HeldOutReport HeldOutReport::read(const ModelFile& file) {
  HeldOutReport report;
  if (!file.has(kConfusion)) return report;
  report.labels = file.text_list(kLabels);
  report.confusion = file.matrix_f(kConfusion);
  const auto num_classes = static_cast<Eigen::Index>(report.labels.size());
  const bool fits = report.confusion.rows() == num_classes &&
                    report.confusion.cols() == num_classes &&
                    (report.confusion.array() >= 0).all() &&
                    (report.confusion.array() <= kMaxCount).all() && report.confusion.sum() > 0;
  if (!fits) {
    fail(ErrorKind::format, file.name() + ": field '" + kConfusion + "' must be counts, one row " +
                                "and one column for each of '" + kLabels + "'");
  }
  report.false_reject_rate = rate_in(file, kFalseRejects);
  report.num_others = others_in(file, report);
  // Older files give a rate of none, which says nothing.
  if (report.num_others > 0 || file.has(kFalseAccepts)) {
    const double rate = rate_in(file, kFalseAccepts);
    if (report.num_others > 0) report.false_accept_rate = rate;
  }
  return report;
}

}  // namespace hri
