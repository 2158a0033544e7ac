// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/training.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "hri/core/error.hpp"
#include "recognition/recording_folds.hpp"

namespace hri {

std::vector<std::string> sorted_labels(const std::vector<std::string>& labels) {
  const std::set<std::string> distinct(labels.begin(), labels.end());
  for (const std::string& label : distinct) {
    if (label.empty()) fail(ErrorKind::invalid_argument, "labels: a label is empty");
    if (label == "unknown" || label == "no_input") {
      fail(ErrorKind::invalid_argument,
           "labels: '" + label + "' is a result of its own and cannot be trained");
    }
  }
  if (distinct.size() < 2) {
    fail(ErrorKind::invalid_argument, "labels: training needs at least 2 different labels, got " +
                                          std::to_string(distinct.size()));
  }
  return {distinct.begin(), distinct.end()};
}

int label_index(const std::vector<std::string>& labels, const std::string& label) {
  return static_cast<int>(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
}

std::vector<int> held_out_folds(const std::vector<int>& classes,
                                const std::vector<std::string>& groups, int max_folds) {
  const std::set<std::string> distinct(groups.begin(), groups.end());
  if (distinct.size() < 2) return detail::dealt_folds(classes, max_folds);
  std::vector<int> folds;
  folds.reserve(groups.size());
  const int num_folds = std::min(max_folds, static_cast<int>(distinct.size()));
  for (const std::string& group : groups) {
    folds.push_back(static_cast<int>(std::distance(distinct.begin(), distinct.find(group))) %
                    num_folds);
  }
  return folds;
}

bool detail::any_fold_is_usable(const std::vector<int>& classes, const std::vector<int>& folds) {
  std::map<int, std::set<int>> folds_of;  // of each class
  for (std::size_t i = 0; i < classes.size(); ++i) folds_of[classes[i]].insert(folds[i]);
  std::set<int> needed;  // each by a class that no other fold has
  for (const auto& of_class : folds_of) {
    if (of_class.second.size() == 1) needed.insert(*of_class.second.begin());
  }
  return needed.size() < std::set<int>(folds.begin(), folds.end()).size();
}

std::vector<int> detail::usable_folds(const std::vector<int>& classes,
                                      const std::vector<std::string>& groups, int max_folds) {
  std::vector<int> folds = held_out_folds(classes, groups, max_folds);
  return any_fold_is_usable(classes, folds) ? folds : dealt_folds(classes, max_folds);
}

std::vector<int> detail::dealt_folds(const std::vector<int>& classes, int max_folds) {
  std::vector<int> folds;
  folds.reserve(classes.size());
  std::map<int, int> dealt;
  for (const int c : classes) folds.push_back(dealt[c]++ % max_folds);
  return folds;
}

}  // namespace hri
