// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/subword/bonus_choice.hpp"

#include <algorithm>
#include <array>

namespace hri::detail {
namespace {

constexpr double kStep = 0.05;  // of log scores a frame
constexpr double kLargest = 10;
constexpr int kNone = -1;

}  // namespace

void BonusChoice::add(const VectorF& scores, const std::vector<bool>& is_new, int truth) {
  std::array<int, 2> best{kNone, kNone};  // of the other words, and of the new
  for (int c = 0; c < static_cast<int>(scores.size()); ++c) {
    int& of_kind = best[is_new[static_cast<std::size_t>(c)] ? 1 : 0];
    if (of_kind == kNone || scores[c] > scores[of_kind]) of_kind = c;
  }
  if (best[0] == kNone || best[1] == kNone) return;
  Trial trial;
  trial.gap = static_cast<double>(scores[best[0]]) - static_cast<double>(scores[best[1]]);
  trial.is_new = is_new[static_cast<std::size_t>(truth)];
  trial.may_be_right = best[trial.is_new ? 1 : 0] == truth;
  trials_.push_back(trial);
}

int BonusChoice::num_right(double bonus) const {
  return static_cast<int>(
      std::count_if(trials_.begin(), trials_.end(), [bonus](const Trial& trial) {
        return trial.may_be_right && (bonus > trial.gap) == trial.is_new;
      }));
}

double BonusChoice::best() const {
  double found = 0;
  for (int step = 1; step * kStep <= kLargest; ++step) {
    if (num_right(step * kStep) > num_right(found)) found = step * kStep;
  }
  return found;
}

}  // namespace hri::detail
