// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/state_clustering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/numbers.hpp"

namespace hri::htk::detail {
namespace {

using hri::detail::kLog2Pi;
using Members = std::vector<std::size_t>;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kLeastOfPooled = 1e-10;

// Frames, and the sums of them and of their squares, that states have together.
struct Sums {
  double occupation = 0;
  VectorD first;
  VectorD second;

  void add(const StateStatistics& state) {
    if (first.size() == 0) first = second = VectorD::Zero(state.mean.size());
    occupation += state.occupation;
    first += state.occupation * state.mean;
    second += state.occupation * (state.variance + state.mean.cwiseAbs2());
  }
  void add(const Sums& other) {
    occupation += other.occupation;
    first += other.first;
    second += other.second;
  }

  // Log likelihood of the frames by one Gaussian of their mean and variance.
  [[nodiscard]] double log_likelihood() const {
    if (!(occupation > 0)) return 0;
    const VectorD variance =
        (second / occupation - (first / occupation).cwiseAbs2()).cwiseMax(kLeastOfPooled);
    return -0.5 * occupation *
           (static_cast<double>(first.size()) * (1 + kLog2Pi) + variance.array().log().sum());
  }
};

Sums sums_of(const std::vector<StateStatistics>& states, const Members& members) {
  Sums sums;
  for (const std::size_t member : members) sums.add(states[member]);
  return sums;
}

class TreeGrower {
 public:
  TreeGrower(const std::vector<StateStatistics>& states,
             const std::vector<ContextQuestion>& questions, double threshold,
             double least_occupation)
      : states_(states), threshold_(threshold), least_occupation_(least_occupation) {
    for (const ContextQuestion& question : questions) {
      std::vector<bool> answers;
      answers.reserve(states.size());
      for (const StateStatistics& state : states)
        answers.push_back(is_answered_yes(question, state.model));
      answers_.push_back(std::move(answers));
    }
  }

  TiedByTree grow() {
    Members all(states_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    add_node(std::move(all));
    for (int best = next_split(); best >= 0; best = next_split()) split(best);
    merge();
    return std::move(made_);
  }

 private:
  struct Open {
    Members members;
    int question = -1;  // the best one
    double gain = 0;
  };

  void add_node(Members members) {
    made_.tree.nodes.emplace_back();
    Open node;
    node.members = std::move(members);
    const Sums all = sums_of(states_, node.members);
    const double before = all.log_likelihood();
    for (std::size_t q = 0; q < answers_.size(); ++q) {
      Sums yes;
      Sums no;
      for (const std::size_t member : node.members)
        (answers_[q][member] ? yes : no).add(states_[member]);
      if (yes.first.size() == 0 || no.first.size() == 0) continue;
      if (yes.occupation < least_occupation_ || no.occupation < least_occupation_) continue;
      const double gain = yes.log_likelihood() + no.log_likelihood() - before;
      if (!(gain > node.gain)) continue;
      node.gain = gain;
      node.question = static_cast<int>(q);
    }
    open_.push_back(std::move(node));
  }

  // The leaf whose split gains most; -1 where none gains enough.
  [[nodiscard]] int next_split() const {
    int best = -1;
    double most = -1;
    for (std::size_t n = 0; n < open_.size(); ++n) {
      if (open_[n].question < 0 || open_[n].gain < threshold_ || open_[n].gain <= most) continue;
      most = open_[n].gain;
      best = static_cast<int>(n);
    }
    return best;
  }

  void split(int number) {
    const auto n = static_cast<std::size_t>(number);
    const int question = std::exchange(open_[n].question, -1);
    const Members members = std::exchange(open_[n].members, {});
    Members yes;
    Members no;
    for (const std::size_t member : members)
      (answers_[static_cast<std::size_t>(question)][member] ? yes : no).push_back(member);
    made_.tree.nodes[n].question = question;
    made_.tree.nodes[n].no = static_cast<int>(made_.tree.nodes.size());
    made_.tree.nodes[n].yes = made_.tree.nodes[n].no + 1;
    add_node(std::move(no));
    add_node(std::move(yes));
  }

  void merge() {
    std::vector<std::vector<std::size_t>> leaves;  // nodes of each group
    std::vector<Sums> sums;
    for (std::size_t n = 0; n < open_.size(); ++n) {
      if (made_.tree.nodes[n].question >= 0) continue;
      leaves.push_back({n});
      sums.push_back(sums_of(states_, open_[n].members));
    }
    while (merge_once(&leaves, &sums)) {
    }
    for (std::size_t g = 0; g < leaves.size(); ++g) {
      Members group;
      for (const std::size_t n : leaves[g]) {
        made_.tree.nodes[n].leaf = std::to_string(g + 1);
        group.insert(group.end(), open_[n].members.begin(), open_[n].members.end());
      }
      std::sort(group.begin(), group.end());
      made_.groups.push_back(std::move(group));
    }
  }

  bool merge_once(std::vector<std::vector<std::size_t>>* leaves, std::vector<Sums>* sums) const {
    double least = threshold_;
    std::size_t first = 0;
    std::size_t second = 0;
    for (std::size_t a = 0; a < sums->size(); ++a) {
      for (std::size_t b = a + 1; b < sums->size(); ++b) {
        Sums both = (*sums)[a];
        both.add((*sums)[b]);
        const double loss =
            (*sums)[a].log_likelihood() + (*sums)[b].log_likelihood() - both.log_likelihood();
        if (!(loss < least)) continue;
        least = loss;
        first = a;
        second = b;
      }
    }
    if (first == second) return false;
    (*sums)[first].add((*sums)[second]);
    (*leaves)[first].insert((*leaves)[first].end(), (*leaves)[second].begin(),
                            (*leaves)[second].end());
    sums->erase(sums->begin() + static_cast<std::ptrdiff_t>(second));
    leaves->erase(leaves->begin() + static_cast<std::ptrdiff_t>(second));
    return true;
  }

  const std::vector<StateStatistics>& states_;
  double threshold_;
  double least_occupation_;
  std::vector<std::vector<bool>> answers_;  // by question and state
  TiedByTree made_;
  std::vector<Open> open_;  // by node; forks have no members
};

double distance_of(const StateStatistics& a, const StateStatistics& b) {
  const auto deviations = (a.variance.array() * b.variance.array()).sqrt();
  return std::sqrt(((a.mean - b.mean).array().square() / deviations).mean());
}

// Groups by their distances, that of their furthest states; merged ones are empty.
class Clusters {
 public:
  explicit Clusters(const std::vector<StateStatistics>& states)
      : distances_(static_cast<Eigen::Index>(states.size()),
                   static_cast<Eigen::Index>(states.size())) {
    for (std::size_t a = 0; a < states.size(); ++a) {
      groups_.push_back({a});
      occupations_.push_back(states[a].occupation);
      for (std::size_t b = 0; b <= a; ++b)
        at(a, b) = at(b, a) = a == b ? kFar : distance_of(states[a], states[b]);
    }
    for (std::size_t a = 0; a < states.size(); ++a) nearest_.push_back(find_nearest(a));
  }

  void merge_up_to(double threshold) {
    for (;;) {
      std::size_t best = 0;
      for (std::size_t a = 1; a < groups_.size(); ++a) {
        if (at(a, nearest_[a]) < at(best, nearest_[best])) best = a;
      }
      if (groups_.empty() || !(at(best, nearest_[best]) <= threshold)) return;
      merge(best, nearest_[best]);
    }
  }

  void merge_small(double least_occupation) {
    for (;;) {
      const auto small = std::find_if(groups_.begin(), groups_.end(), [&](const Members& group) {
        const auto a = static_cast<std::size_t>(&group - groups_.data());
        return !group.empty() && occupations_[a] < least_occupation && at(a, nearest_[a]) < kFar;
      });
      if (small == groups_.end()) return;
      const auto a = static_cast<std::size_t>(small - groups_.begin());
      merge(a, nearest_[a]);
    }
  }

  std::vector<Members> take() {
    std::vector<Members> groups;
    for (Members& group : groups_) {
      std::sort(group.begin(), group.end());
      if (!group.empty()) groups.push_back(std::move(group));
    }
    return groups;
  }

 private:
  double& at(std::size_t a, std::size_t b) {
    return distances_(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }

  [[nodiscard]] std::size_t find_nearest(std::size_t a) const {
    Eigen::Index nearest = 0;
    distances_.row(static_cast<Eigen::Index>(a)).minCoeff(&nearest);
    return static_cast<std::size_t>(nearest);
  }

  void merge(std::size_t a, std::size_t b) {
    if (b < a) std::swap(a, b);
    groups_[a].insert(groups_[a].end(), groups_[b].begin(), groups_[b].end());
    groups_[b].clear();
    occupations_[a] += occupations_[b];
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      at(a, k) = at(k, a) = k == a ? kFar : std::max(at(a, k), at(b, k));
    }
    for (std::size_t k = 0; k < groups_.size(); ++k) at(b, k) = at(k, b) = kFar;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      if (k == a || k == b || nearest_[k] == a || nearest_[k] == b) nearest_[k] = find_nearest(k);
    }
  }

  MatrixD distances_;  // infinity for a group itself and those merged
  std::vector<Members> groups_;
  std::vector<double> occupations_;
  std::vector<std::size_t> nearest_;
};

}  // namespace

StateStatistics pooled(const std::vector<StateStatistics>& states, const Members& members) {
  Sums sums = sums_of(states, members);
  if (!(sums.occupation > 0)) {
    sums = Sums();
    for (const std::size_t member : members) {
      StateStatistics state = states[member];
      state.occupation = 1;
      sums.add(state);
    }
  }
  StateStatistics made;
  made.occupation = sums.occupation;
  made.mean = sums.first / sums.occupation;
  made.variance = (sums.second / sums.occupation - made.mean.cwiseAbs2()).cwiseMax(kLeastOfPooled);
  return made;
}

TiedByTree tie_by_tree(const std::vector<StateStatistics>& states,
                       const std::vector<ContextQuestion>& questions, double threshold,
                       double least_occupation) {
  return TreeGrower(states, questions, threshold, least_occupation).grow();
}

std::vector<Members> cluster(const std::vector<StateStatistics>& states, double threshold,
                             double least_occupation) {
  Clusters clusters(states);
  clusters.merge_up_to(threshold);
  clusters.merge_small(least_occupation);
  return clusters.take();
}

}  // namespace hri::htk::detail
