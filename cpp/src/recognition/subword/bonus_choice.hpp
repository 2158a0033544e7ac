// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What words need to be recognised on a par with others on which the units were trained.
#pragma once

#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

class BonusChoice {
 public:
  /// `scores` of a recording of label `truth`; which labels were not trained on says `is_new`.
  /// Nothing is added where the labels are all of one kind.
  void add(const VectorF& scores, const std::vector<bool>& is_new, int truth);

  /// The least bonus, 0 or more, with which most recordings are right; 0 where there is none.
  [[nodiscard]] double best() const;

 private:
  struct Trial {
    double gap = 0;  // the best of the other words, less that of the new
    bool is_new = false;
    bool may_be_right = false;  // it is the best of its kind
  };
  [[nodiscard]] int num_right(double bonus) const;

  std::vector<Trial> trials_;
};

}  // namespace hri::detail
